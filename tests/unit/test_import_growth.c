/* SPDX-License-Identifier: MIT */
/* No import grows with the square of its files. 16 times as much may take 60 times as long; a
 * square would be 256. Times of the processor, the least of some runs. Each import is refused for
 * what comes last in it, before its document is read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "protocol/import/import.h"
#include "protocol/memory.h"
#include "tests/support/json_text.h"

enum { FEW = 250, MANY = 16 * FEW, RUNS = 5 };

struct folder {
    struct import_file *files;
    size_t count;
};

static char *format(const char *form, ...) __attribute__((format(printf, 1, 2)));

static char *format(const char *form, ...)
{
    char *text;
    va_list args;

    va_start(args, form);
    assert_true(vasprintf(&text, form, args) >= 0);
    va_end(args);
    return text;
}

/* Takes path and text; ' stands for ". */
static void add(struct folder *folder, char *path, char *text)
{
    json_text_quote(text);
    folder->files[folder->count++] = (struct import_file){path, text, strlen(text)};
}

/* `part` with each number below `count`, and commas between. */
static char *repeated(const char *head, const char *part, size_t count, const char *tail)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fputs(head, out);
    for (size_t i = 0; i < count; i++) {
        const char *number = strchr(part, '#');
        fprintf(out, "%s%.*s%05zu%s", i ? ",\n" : "", (int)(number - part), part, i, number + 1);
    }
    fputs(tail, out);
    fclose(out);
    return text;
}

/* --- folders --- */

#define LONG_NAME "a_name_that_is_as_long_as_suggestions"
#define MODEL "'model':{'type':'Primitives/Sphere'}"

static void add_models(struct folder *folder, const char *path, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        char *number = format("%03zx", i), *parts = format("%s", path);
        *strchr(parts, '#') = '\0';
        add(folder, format("%s%s%s", parts, number, path + strlen(parts) + 1),
            format("{" MODEL "}"));
        free(number);
        free(parts);
    }
}

static void many_names(struct folder *folder, size_t size)
{
    add_models(folder, LONG_NAME "#.json", size);
    for (size_t from = 0; from < size; from += size / 10) {
        char *text;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fputs("{'model':{'type':'Primitives/Sphere','children':[", out);
        for (size_t i = from; i < from + size / 10; i++) {
            fprintf(out, "%s{'type':'Models/" LONG_NAME "%03zx'}", i > from ? "," : "", i);
        }
        fputs("]}}", out);
        fclose(out);
        add(folder, format("more-%zu.json", from), text);
    }
}

static void one_name(struct folder *folder, size_t size)
{
    add_models(folder, "folder-#/m.json", size);
}

static void many_properties(struct folder *folder, size_t size)
{
    add(folder, format("m.json"),
        repeated("{'base_shader':'s','properties':[", "{'name':'_p#','value':1}", size, "]}"));
    add(folder, format("s.json"),
        repeated("{'code':'','properties':[", "'[float] _p#'", size, "]}"));
}

static void many_members(struct folder *folder, size_t size)
{
    add(folder, format("m.json"), repeated("{" MODEL ",", "'m#':1", size, "}"));
}

static void members_behind_objects(struct folder *folder, size_t size)
{
    add(folder, format("m.json"),
        repeated("{'model':{'children':[", "{},\n'a#':1}", 16 * size, "]}}"));
}

static const struct {
    const char *name, *refused;
    void (*make)(struct folder *folder, size_t size);
} folders[] = {
    {"many names", "no file has the model", many_names},
    {"one name", "no file has the model", one_name},
    {"many properties", "properties are above the maximum 16", many_properties},
    {"many members", "no member \"m00000\"", many_members},
    {"behind objects", "expected one member type", members_behind_objects},
};

enum { FOLDERS = sizeof folders / sizeof folders[0] };

/* --- times --- */

static double now(void)
{
    struct timespec time;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double time_import(int which, size_t size)
{
    struct folder folder = {memory_alloc(size + 12, sizeof *folder.files), 0};
    double least = 0;

    folders[which].make(&folder, size);
    add(&folder, format("scene.json"), format("{'scene':[{'type':'Models/none'}]}"));
    for (int run = 0; run < RUNS; run++) {
        struct error err = {0};
        const double start = now();
        assert_null(import_scene(&(struct import_source){folder.files, folder.count, NULL, NULL},
                                 NULL, &err));
        const double taken = now() - start;
        if (!strstr(err.message, folders[which].refused)) {
            fail_msg("%s: %s", err.place, err.message);
        }
        least = least == 0 || taken < least ? taken : least;
    }
    while (folder.count > 0) {
        folder.count--;
        free((char *)folder.files[folder.count].path);
        free((char *)folder.files[folder.count].text);
    }
    free(folder.files);
    return least;
}

static void sixteen_times_as_much(void **state)
{
    (void)state;
    for (int i = 0; i < FOLDERS; i++) {
        const double few = time_import(i, FEW);
        const double many = time_import(i, MANY);
        print_message("%-18s %8.2f ms %8.2f ms, %.1f times\n", folders[i].name, 1e3 * few,
                      1e3 * many, many / few);
        assert_true(many < 60 * few);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sixteen_times_as_much)};

    return cmocka_run_group_tests_name("growth of imports", tests, NULL, NULL);
}
