/* SPDX-License-Identifier: MIT */
/* Nothing grows with the square of a scene. The same edit in a scene 16 times as large may take 6
 * times as long, for memory is slower; where each operation looked at all nodes it would be 16.
 * Reading and the like may take 60 times as long; a square would be 256. Times of the processor,
 * the least of some runs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "protocol/edit.h"
#include "protocol/limits.h"
#include "tests/support/json_text.h"

enum { FEW = 500, MANY = 16 * FEW, RUNS = 5 };

static double now(void)
{
    struct timespec time;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void write_spheres(FILE *out, char letter, size_t count)
{
    fprintf(out, "'children':[");
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "%s{'id':'%c%zu','type':'sphere','params':{'radius':0.7}}", i ? "," : "",
                letter, i);
    }
    fprintf(out, "]}");
}

/* A group "g" of `count` spheres s0, s1, ... beside an empty group "h", two small models
 * and three as large. */
static char *document(size_t count)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out, "{'format':'fieldcast/1','models':{'little':{'type':'box'},'m':{'id':'m',"
                 "'type':'union'}");
    for (const char *letter = "abc"; *letter; letter++) {
        fprintf(out, ",'%c':{'type':'union',", *letter);
        write_spheres(out, *letter, count);
    }
    fprintf(out, "},'root':{'id':'root','type':'union','children':[{'id':'h','type':'group'},"
                 "{'id':'g','type':'group',");
    write_spheres(out, 's', count);
    fprintf(out, "]}}");
    fclose(out);
    json_text_quote(text);
    return text;
}

static cJSON *add(cJSON *ops, const char *name, const char *member, const char *form, size_t number)
{
    char place[64];
    cJSON *op = cJSON_CreateObject();

    snprintf(place, sizeof place, "%s%zu", form, number);
    cJSON_AddStringToObject(op, "op", name);
    cJSON_AddStringToObject(op, member, form[strlen(form) - 1] == '/' ? form : place);
    cJSON_AddItemToArray(ops, op);
    return op;
}

static cJSON *add_into(cJSON *ops, const char *into, const char *type)
{
    cJSON *op = cJSON_CreateObject(), *value;

    cJSON_AddStringToObject(op, "op", "insert");
    cJSON_AddStringToObject(op, "into", into);
    value = cJSON_AddObjectToObject(op, "value");
    cJSON_AddStringToObject(value, "type", type);
    cJSON_AddItemToArray(ops, op);
    return value;
}

/* --- edits of FEW operations, all over a group of `size` spheres --- */

static void set_numbers(cJSON *ops, size_t size)
{
    for (size_t i = 0; i < FEW; i++) {
        cJSON *op = add(ops, "set", "at", "/nodes/s", i * (size / FEW));
        char *at = cJSON_GetObjectItem(op, "at")->valuestring, place[64];
        snprintf(place, sizeof place, "%s/params/radius", at);
        cJSON_ReplaceItemInObject(op, "at", cJSON_CreateString(place));
        cJSON_AddNumberToObject(op, "value", 0.1);
    }
}

static void insert_last(cJSON *ops, size_t size)
{
    (void)size;
    for (size_t i = 0; i < FEW; i++) {
        add_into(ops, "/nodes/g", "sphere");
    }
}

/* With all that naming a model has to look at. */
static void insert_instances(cJSON *ops, size_t size)
{
    (void)size;
    cJSON_AddStringToObject(add_into(ops, "/nodes/m", "group"), "id", "in_m");
    for (size_t i = 0; i < FEW; i++) {
        cJSON *node = add_into(ops, "/nodes/in_m", "model");
        cJSON_AddStringToObject(cJSON_AddObjectToObject(node, "params"), "model", "little");
    }
}

static void remove_first(cJSON *ops, size_t size)
{
    for (size_t i = 0; i < FEW; i++) {
        add(ops, "remove", "at", "/nodes/s", i * (size / FEW));
    }
}

static void move_anywhere(cJSON *ops, size_t size)
{
    for (size_t i = 0; i < FEW; i++) {
        char before[32];
        cJSON *op = add(ops, "move", "at", "/nodes/s", i * (size / FEW));
        snprintf(before, sizeof before, "s%zu", (i * (size / FEW) + 1 + 7 * i % (size - 1)) % size);
        cJSON_AddStringToObject(op, "into", "/nodes/g");
        cJSON_AddStringToObject(op, "before", before);
    }
}

/* The group with all its children, deeper and back. */
static void move_group(cJSON *ops, size_t size)
{
    (void)size;
    for (size_t i = 0; i < FEW; i++) {
        cJSON *op = cJSON_CreateObject();
        cJSON_AddStringToObject(op, "op", "move");
        cJSON_AddStringToObject(op, "at", "/nodes/g");
        cJSON_AddStringToObject(op, "into", i % 2 ? "/nodes/root" : "/nodes/h");
        cJSON_AddItemToArray(ops, op);
    }
}

/* Seconds for an edit and for taking it back. */
static double time_edit(const struct scene *scene, size_t size,
                        void (*make)(cJSON *ops, size_t size))
{
    struct error err = {0};
    struct scene *copy = scene_copy(scene);
    cJSON *ops = cJSON_CreateArray(), *inverse;

    make(ops, size);
    const double start = now();
    if (!edit_apply(copy, ops, NULL, &inverse, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    assert_true(edit_apply(copy, inverse, NULL, NULL, &err));
    const double taken = now() - start;
    cJSON_Delete(ops);
    cJSON_Delete(inverse);
    scene_destroy(copy);
    return taken;
}

static double time_parse(const char *text, size_t length)
{
    const double start = now();
    struct scene *scene = scene_parse(text, length, NULL);
    const double taken = now() - start;

    assert_non_null(scene);
    scene_destroy(scene);
    return taken;
}

static double time_print(const struct scene *scene)
{
    const double start = now();

    free(scene_print(scene, false));
    return now() - start;
}

static double time_copy(const struct scene *scene)
{
    const double start = now();

    scene_destroy(scene_copy(scene));
    return now() - start;
}

static const struct {
    const char *name;
    void (*make)(cJSON *ops, size_t size);
} edits[] = {
    {"set numbers", set_numbers},       {"insert last", insert_last},
    {"remove the first", remove_first}, {"move anywhere", move_anywhere},
    {"move a group", move_group},       {"insert instances", insert_instances},
};

enum { EDITS = sizeof edits / sizeof edits[0], PARSE = EDITS, PRINT, COPY, KINDS };

static void keep_least(double *least, double taken)
{
    *least = *least == 0 || taken < *least ? taken : *least;
}

static void measure(size_t count, double least[KINDS])
{
    char *text = document(count);
    struct scene *scene = scene_parse(text, strlen(text), NULL);

    assert_non_null(scene);
    for (int run = 0; run < RUNS; run++) {
        for (int i = 0; i < EDITS; i++) {
            keep_least(&least[i], time_edit(scene, count, edits[i].make));
        }
        keep_least(&least[PARSE], time_parse(text, strlen(text)));
        keep_least(&least[PRINT], time_print(scene));
        keep_least(&least[COPY], time_copy(scene));
    }
    scene_destroy(scene);
    free(text);
}

static void sixteen_times_as_much(void **state)
{
    (void)state;
    double few[KINDS] = {0}, many[KINDS] = {0};

    measure(FEW, few);
    measure(MANY, many);
    for (int i = 0; i < KINDS; i++) {
        const char *name = i < EDITS    ? edits[i].name
                           : i == PARSE ? "parse"
                           : i == PRINT ? "print"
                                        : "copy";
        print_message("%-18s %8.2f ms %8.2f ms, %.1f times\n", name, 1e3 * few[i], 1e3 * many[i],
                      many[i] / few[i]);
        assert_true(many[i] < (i < EDITS ? 6 : 60) * few[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sixteen_times_as_much)};

    return cmocka_run_group_tests_name("growth", tests, NULL, NULL);
}
