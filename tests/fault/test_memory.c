/* SPDX-License-Identifier: MIT */
/* Memory that runs out: each allocation of an operation fails once, in a process of its own. That
 * ends by abort, as protocol/memory.h says, or the operation comes to the same as with memory; a
 * store may end by itself. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/edit.h"
#include "protocol/json.h"
#include "protocol/scene.h"
#include "renderer/field/field.h"
#include "renderer/field/shader.h"
#include "server/cli/files.h"
#include "server/store/store.h"
#include "tests/support/json_text.h"
#include "tests/support/preload.h"
#include "tests/support/store_life.h"

enum { OTHERWISE = 20 };

static void (*memory_fail)(long nth);
static long (*memory_count)(void);

static const char scene_text[] =
    "{'format':'fieldcast/1','lights':[{'id':'sun','type':'directional'}],"
    "'materials':{'red':{'shader':'phong'}},"
    "'primitives':{'blob':{'params':[{'name':'blow','type':'float','default':1}],"
    "'code':'float sdf(vec3 p) { return length(p) - blow; }'}},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'ball','type':'sphere','material':'red'},"
    "{'id':'b','type':'field','params':{'primitive':'blob'}}]}}";
static const char edit_text[] = "[{'op':'set','at':'/nodes/ball/params/radius','value':2},"
                                "{'op':'remove','at':'/nodes/b'}]";

static char *document, *edit; /* the texts as JSON */
static char *reference;       /* the document as it is printed */

/* --- operations: 0, or OTHERWISE where the result is another one --- */

static int parse_and_print(void)
{
    struct error err = {0};
    struct scene *scene = scene_parse(document, strlen(document), &err);
    char *text = scene ? scene_print(scene, false) : NULL;
    const int result = text && (!reference || strcmp(text, reference) == 0) ? 0 : OTHERWISE;

    free(text);
    scene_destroy(scene);
    return result;
}

static int edit_and_undo(void)
{
    struct error err = {0};
    struct scene *scene = scene_parse(document, strlen(document), &err);
    cJSON *ops = json_parse(edit, strlen(edit), &err), *inverse = NULL;
    int result = OTHERWISE;

    if (scene && ops && edit_check(ops, &err) && edit_apply(scene, ops, NULL, &inverse, &err) &&
        edit_apply(scene, inverse, NULL, NULL, &err)) {
        char *text = scene_print(scene, false);
        result = strcmp(text, reference) == 0 ? 0 : OTHERWISE;
        free(text);
    }
    cJSON_Delete(ops);
    cJSON_Delete(inverse);
    scene_destroy(scene);
    return result;
}

static int compile_field(void)
{
    struct error err = {0};
    struct scene *scene = scene_parse(document, strlen(document), &err);
    struct field *field = scene ? field_compile(scene, &err) : NULL;
    const int result = field ? 0 : OTHERWISE;

    field_unref(field);
    scene_destroy(scene);
    return result;
}

/* --- each allocation once --- */

static int in_process(int (*act)(void), long nth, long *out_count)
{
    int ends[2], status;

    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        memory_fail(nth);
        const int result = act();
        const long count = memory_count();
        _exit(write(ends[1], &count, sizeof count) == sizeof count ? result : OTHERWISE);
    }
    close(ends[1]);
    if (read(ends[0], out_count, sizeof *out_count) != sizeof *out_count) {
        *out_count = 0;
    }
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

static void fail_each(const char *name, int (*act)(void))
{
    long count, unused;
    int aborted = 0;

    assert_int_equal(in_process(act, 0, &count), 0);
    assert_true(count > 0);
    for (long nth = 1; nth <= count; nth++) {
        const int status = in_process(act, nth, &unused);
        if (status != 0 && status != -SIGABRT) {
            fail_msg("%s: allocation %ld of %ld: status %d", name, nth, count, status);
        }
        aborted += status != 0;
    }
    printf("# %s: %ld allocations, %d ended the process\n", name, count, aborted);
    assert_true(aborted > 0);
}

static void documents_survive_each_failure(void **state)
{
    (void)state;
    fail_each("parse and print", parse_and_print);
    fail_each("edit and undo", edit_and_undo);
    fail_each("compile the field", compile_field);
}

/* --- the store --- */

static char base[64], directory[100];
static int told_fd;

static int live(void)
{
    return store_life(directory, told_fd);
}

static void clean_directory(void)
{
    char path[100];

    snprintf(path, sizeof path, "%s/a", base);
    directory_remove(path);
}

static void check_store(long nth, long count)
{
    int told[2];
    long unused;
    struct store_told durable;

    assert_int_equal(pipe(told), 0);
    told_fd = told[1];
    const int status = in_process(live, nth, &unused);
    close(told[1]);
    store_life_read_told(told[0], &durable);
    close(told[0]);
    const char *fault = store_life_fault(directory, &durable);
    if (fault || (status != 0 && status != -SIGABRT && status != STORE_LIFE_REFUSED &&
                  status != STORE_EXIT_STATUS)) {
        fail_msg("allocation %ld of %ld: status %d; revision %lld was told durable: %s", nth, count,
                 status, (long long)durable.revision, fault ? fault : "and is there");
    }
    clean_directory();
}

/* SQLite allocates thousands of times: of the later ones each of a few. */
static void store_survives_each_failure(void **state)
{
    long count;
    int lives = 0, null_fd[2];

    (void)state;
    assert_int_equal(pipe(null_fd), 0);
    told_fd = null_fd[1];
    assert_int_equal(in_process(live, 0, &count), 0);
    close(null_fd[0]);
    close(null_fd[1]);
    clean_directory();
    for (long nth = 1; nth <= count; nth += 1 + nth / 40) {
        check_store(nth, count);
        lives++;
    }
    printf("# the store: %ld allocations, %d of them failed\n", count, lives);
}

static int prepare(void **state)
{
    document = json_text(scene_text);
    edit = json_text(edit_text);
    struct scene *scene = json_text_valid_scene(document);

    (void)state;
    reference = scene_print(scene, false);
    scene_destroy(scene);
    store_life_make_base(base, sizeof base, "memory");
    snprintf(directory, sizeof directory, "%s/a/data", base);
    return 0;
}

static int clean(void **state)
{
    (void)state;
    free(reference);
    free(document);
    free(edit);
    directory_remove(base);
    return 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(documents_survive_each_failure),
                                       cmocka_unit_test(store_survives_each_failure)};

    (void)argc;
    preload(argv, "memory_driver");
    memory_fail = (void (*)(long))preload_symbol("memory_fail");
    memory_count = (long (*)(void))preload_symbol("memory_count");
    return cmocka_run_group_tests(tests, prepare, clean);
}
