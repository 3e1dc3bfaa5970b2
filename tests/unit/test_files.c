/* SPDX-License-Identifier: MIT */
/* Files that a command writes: whole or not at all, and nothing beside them. */
#include <dirent.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "server/cli/files.h"

static char folder[] = "/tmp/fieldcast-files-XXXXXX";
static char path[64];

static int count_files(void)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    int count = 0;

    assert_non_null(directory);
    while ((entry = readdir(directory))) {
        count += entry->d_name[0] != '.';
    }
    closedir(directory);
    return count;
}

static void assert_content(const char *wanted)
{
    struct error err = {0};
    size_t length = 0;
    char *text = file_read(path, 100, &length, &err);

    assert_non_null(text);
    assert_string_equal(text, wanted);
    free(text);
}

static void open_writer(struct file_writer *writer, const char *text)
{
    struct error err = {0};

    assert_true(file_writer_open(writer, path, &err));
    assert_true(fputs(text, writer->file) >= 0 && fflush(writer->file) == 0);
}

static void a_whole_one_replaces_what_was_there(void **state)
{
    const mode_t mask = umask(027);
    struct error err = {0};
    struct stat about;

    (void)state;
    assert_true(file_replace(path, "first", 5, &err));
    assert_content("first");
    assert_true(file_replace(path, "second", 6, &err));
    assert_content("second");
    assert_int_equal(count_files(), 1);
    assert_int_equal(stat(path, &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    umask(mask);
}

static void of_a_failure_nothing_is_left(void **state)
{
    struct file_writer writer;
    struct error err = {0};

    (void)state;
    open_writer(&writer, "half");
    assert_false(file_writer_close(&writer, false, &err));
    assert_int_equal(err.kind, ERROR_NONE);
    assert_content("second");
    assert_int_equal(count_files(), 1);
}

static void nor_of_a_process_that_was_ended(void **state)
{
    const int nameless = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    int status = 0;

    (void)state;
    if (nameless < 0) {
        skip(); /* the file system has no such files */
    }
    close(nameless);
    const pid_t child = fork();
    if (child == 0) {
        struct file_writer writer;

        open_writer(&writer, "half");
        raise(SIGKILL);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    assert_content("second");
    assert_int_equal(count_files(), 1);
}

static int set_up(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) {
        return -1;
    }
    snprintf(path, sizeof path, "%s/file", folder);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    directory_remove(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_one_replaces_what_was_there),
        cmocka_unit_test(of_a_failure_nothing_is_left),
        cmocka_unit_test(nor_of_a_process_that_was_ended),
    };

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
