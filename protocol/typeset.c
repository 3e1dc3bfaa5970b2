/* SPDX-License-Identifier: MIT */
#include "typeset.h"

#include <stdlib.h>

#include "equation_mathml.h"
#include "memory.h"
#include "surface.h"

const char *const typeset_forms[] = {[TYPESET_EQUATION] = "equation",
                                     [TYPESET_FUNCTION] = "function",
                                     [TYPESET_EXPRESSION] = "expression",
                                     [TYPESET_FORMS] = NULL};

/* clang-format off */
const struct record_type typeset_type = {
    "typeset", "An equation as MathML.",
    (const struct param[]){
        {"text", PARAM_EQUATION, .doc = "As it is typed."},
        {"form", PARAM_ENUM, .def = {TYPESET_EQUATION}, .choices = typeset_forms,
         .doc = "In x, y and z, with a relation; the same without one; an expression in s, t, u "
                "and v. The letters of nodes may be in each."},
        {.name = NULL}}};
/* clang-format on */

/* Those of a surface, then those of nodes. The caller frees the list. */
static const char **letters_of(bool plain)
{
    size_t count = 0, own = 0;

    while (equation_letters[own]) {
        own++;
    }
    const char **letters = memory_alloc(SURFACE_LETTERS + own + 1, sizeof *letters);
    for (int i = 0; plain && i < SURFACE_LETTERS; i++) {
        letters[count++] = surface_names[SURFACE_PARTS + i];
    }
    for (size_t i = 0; i < own; i++) {
        letters[count++] = equation_letters[i];
    }
    return letters;
}

static cJSON *tell_errors(const struct equation_errors *errors)
{
    cJSON *json = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(json, "errors");

    for (int i = 0; i < errors->count; i++) {
        cJSON *one = cJSON_CreateObject();
        cJSON_AddNumberToObject(one, "line", errors->list[i].line);
        cJSON_AddNumberToObject(one, "column", errors->list[i].column);
        cJSON_AddStringToObject(one, "message", errors->list[i].message);
        cJSON_AddItemToArray(list, one);
    }
    return json;
}

/* Takes the text. */
static void add_line(cJSON *lines, char *mathml)
{
    cJSON_AddItemToArray(lines, cJSON_CreateString(mathml));
    free(mathml);
}

/* A function has a relation where one was written: without it, or with 0, it is the left side. */
static bool is_value(const struct equation *equation, enum typeset_form form)
{
    const struct equation_node *right = &equation->nodes[equation->right];

    return form == TYPESET_EXPRESSION ||
           (form == TYPESET_FUNCTION && equation->relation == EQUATION_EQUALS &&
            right->op == EQUATION_NUMBER && right->value == 0);
}

static cJSON *tell_lines(const struct equation_mathml *m, enum typeset_form form)
{
    cJSON *json = cJSON_CreateObject(), *lines = cJSON_AddArrayToObject(json, "lines");

    for (int i = 0; i < m->definitions->count; i++) {
        add_line(lines, equation_mathml_definition(m, i));
    }
    add_line(lines,
             is_value(m->equation, form) ? equation_mathml_expression(m) : equation_mathml(m));
    return json;
}

cJSON *typeset(const struct record *asked)
{
    const char *text = record_text(asked, "text");
    const enum typeset_form form = (enum typeset_form)record_number(asked, "form");
    const bool plain = form == TYPESET_EXPRESSION;
    const char **letters = letters_of(plain);
    struct equation_errors errors;
    struct equation_definitions definitions;
    struct equation *equation = plain ? equation_read_expression(text, letters, &errors)
                                      : equation_read(text, letters, &errors);
    struct equation *written =
        equation ? equation_read_written(text, letters, plain, &definitions) : NULL;

    if (!written) {
        definitions.count = 0;
    }
    const struct equation_mathml m = {written ? written : equation, letters, &definitions};
    cJSON *json = equation ? tell_lines(&m, form) : tell_errors(&errors);
    free(equation);
    free(written);
    free(letters);
    return json;
}
