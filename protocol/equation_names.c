/* SPDX-License-Identifier: MIT */
/* Names in equations, and what is said of those that are none. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "equation_internal.h"
#include "suggest.h"

/* Those that are known. */
struct names {
    const char *const *letters;
    bool plain; /* x, y and z are none */
};

int equation_name_in(const char *const *names, const char *name)
{
    for (int i = 0; names[i]; i++) {
        if (strcmp(names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

int equation_function_of(const char *name, int *out_arguments)
{
    for (int i = 0; i < EQUATION_FUNCTIONS + EQUATION_COMPOSITES; i++) {
        const struct equation_function *row = i < EQUATION_FUNCTIONS
                                                  ? &equation_functions[i]
                                                  : &equation_composites[i - EQUATION_FUNCTIONS];
        if (strcmp(row->name, name) == 0) {
            *out_arguments = row->arguments;
            return i;
        }
    }
    return -1;
}

/* "; write x*y" for xy. */
static bool product_of(const struct names *known, const char *name,
                       char out[2 * EQUATION_NAME_BYTES])
{
    size_t used = 0;

    for (const char *c = name; *c && used + 3 < 2 * EQUATION_NAME_BYTES; c++) {
        const char one[] = {*c, '\0'};
        if (equation_name_in(equation_axes, one) < 0 && equation_name_in(known->letters, one) < 0) {
            return false;
        }
        used += (size_t)snprintf(out + used, 2 * EQUATION_NAME_BYTES - used, "%s%c",
                                 used ? "*" : "", *c);
    }
    return name[0] && name[1];
}

/* Other names of functions. */
static const struct {
    const char *name, *ours;
} aliases[] = {
    {"ln", "log"}, {"arcsin", "asin"}, {"arccos", "acos"}, {"arctan", "atan"}, {"sgn", "sign"},
};

static bool is_known(const struct names *known, const char *name)
{
    int arguments;
    bool found = (!known->plain && equation_name_in(equation_axes, name) >= 0) ||
                 equation_name_in(known->letters, name) >= 0 ||
                 equation_function_of(name, &arguments) >= 0;

    for (int i = 0; equation_constants[i].name; i++) {
        found = found || strcmp(equation_constants[i].name, name) == 0;
    }
    return found;
}

/* What is surely meant: PI, X, ln. NULL: nothing. */
static const char *meant_by(const struct names *known, const char *name,
                            char lower[EQUATION_NAME_BYTES])
{
    for (size_t i = 0; i < sizeof aliases / sizeof aliases[0]; i++) {
        if (strcmp(aliases[i].name, name) == 0) {
            return aliases[i].ours;
        }
    }
    for (size_t i = 0; i < EQUATION_NAME_BYTES; i++) {
        lower[i] = (char)tolower((unsigned char)name[i]);
        if (!name[i]) {
            break;
        }
    }
    return is_known(known, lower) ? lower : NULL;
}

static void suggest(const char *name, bool called, struct suggestion *out)
{
    *out = (struct suggestion){.text = name};
    for (int i = 0; i < EQUATION_FUNCTIONS; i++) {
        suggest_consider(out, equation_functions[i].name);
    }
    for (int i = 0; i < EQUATION_COMPOSITES; i++) {
        suggest_consider(out, equation_composites[i].name);
    }
    for (int i = 0; !called && equation_constants[i].name; i++) {
        suggest_consider(out, equation_constants[i].name);
    }
}

/* Which letters there are, and how another is defined. */
static const char *hint_letters(const struct names *known, const char *name, char *out, size_t size)
{
    size_t used = (size_t)snprintf(out, size, "; the letters are ");

    for (int i = 0; known->letters[i] && used < size; i++) {
        used +=
            (size_t)snprintf(out + used, size - used, "%s%s", i > 0 ? ", " : "", known->letters[i]);
    }
    if (used < size) {
        snprintf(out + used, size - used, "; or define it before: %s := 1", name);
    }
    return out;
}

void equation_unknown(const char *const *letters, bool plain, const char *name, bool called,
                      char out[EQUATION_MESSAGE_BYTES])
{
    const struct names known = {letters, plain};
    char product[2 * EQUATION_NAME_BYTES], hint[128], lower[EQUATION_NAME_BYTES];
    const char *meant = meant_by(&known, name, lower);
    struct suggestion near = {.text = name, .best = meant};

    if (!called && product_of(&known, name, product)) {
        snprintf(out, EQUATION_MESSAGE_BYTES, "\"%s\" is no name; write %s", name, product);
        return;
    }
    if (!meant) {
        suggest(name, called, &near);
    }
    suggest_hint(&near, hint, sizeof hint);
    if (!near.best && !called && equation_name_in(equation_axes, name) < 0) {
        hint_letters(&known, name, hint, sizeof hint);
    }
    snprintf(out, EQUATION_MESSAGE_BYTES, "\"%s\" is no %s%s", name, called ? "function" : "name",
             hint);
}
