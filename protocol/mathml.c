/* SPDX-License-Identifier: MIT */
#include "mathml.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- elements --- */

void mathml_put(struct mathml *m, const char *text)
{
    equation_put(&m->out, text);
}

void mathml_open(struct mathml *m, const char *tag)
{
    mathml_put(m, "<");
    mathml_put(m, tag);
    mathml_put(m, ">");
    m->depth++;
}

void mathml_close(struct mathml *m, const char *tag)
{
    mathml_put(m, "</");
    mathml_put(m, tag);
    mathml_put(m, ">");
    m->depth--;
}

void mathml_element(struct mathml *m, const char *tag, const char *text)
{
    mathml_open(m, tag);
    mathml_put(m, text);
    mathml_close(m, tag);
}

void mathml_fence(struct mathml *m, const char *form, const char *sign, bool stretches)
{
    mathml_put(m, "<mo form=\"");
    mathml_put(m, form);
    mathml_put(m, stretches ? "\" stretchy=\"true\">" : "\" stretchy=\"false\">");
    mathml_put(m, sign);
    mathml_put(m, "</mo>");
}

void mathml_infix(struct mathml *m, const char *sign)
{
    mathml_put(m, "<mo form=\"infix\">");
    mathml_put(m, sign);
    mathml_put(m, "</mo>");
}

void mathml_minus(struct mathml *m)
{
    mathml_put(m, "<mo form=\"prefix\">" MATHML_MINUS "</mo>");
}

void mathml_thin_space(struct mathml *m)
{
    mathml_put(m, "<mspace width=\"0.17em\"/>");
}

void mathml_break(struct mathml *m)
{
    if (m->depth == 0) {
        mathml_put(m, "</mrow><mrow>");
    }
}

/* --- numbers and names --- */

void mathml_whole(struct mathml *m, double value)
{
    char text[32];

    equation_number_text(fabs(value), text);
    if (value < 0) {
        mathml_open(m, "mrow");
        mathml_minus(m);
    }
    mathml_element(m, "mn", text);
    if (value < 0) {
        mathml_close(m, "mrow");
    }
}

void mathml_number(struct mathml *m, double value)
{
    char text[32];

    equation_number_text(value, text);
    char *exponent = strchr(text, 'e');
    if (!exponent) {
        mathml_element(m, "mn", text);
        return;
    }
    *exponent = '\0';
    if (strcmp(text, "1") != 0) {
        mathml_element(m, "mn", text);
        mathml_infix(m, "\u00d7");
    }
    mathml_open(m, "msup");
    mathml_element(m, "mn", "10");
    mathml_whole(m, strtod(exponent + 1, NULL));
    mathml_close(m, "msup");
}

/* The small letters of the Greek alphabet, from U+03B1 on; the final sigma has no name. */
static const char *const greek[] = {
    "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta",    "eta",  "theta", "iota",
    "kappa", "lambda", "mu",      "nu",    "xi",      "omicron", "pi",   "rho",   "",
    "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",     "omega"};

/* Their number; -1: it is none of them. */
static int greek_of(const char *name)
{
    for (int i = 0; i < (int)(sizeof greek / sizeof greek[0]); i++) {
        if (*name && strcmp(greek[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

static void put_letters(struct mathml *m, const char *name)
{
    const unsigned code = 0x3b1 + (unsigned)greek_of(name);
    const char text[] = {(char)(0xc0 | code >> 6), (char)(0x80 | (code & 0x3f)), '\0'};

    if (greek_of(name) >= 0) {
        mathml_element(m, "mi", text);
    } else {
        mathml_element(m, isdigit((unsigned char)*name) ? "mn" : "mi", name);
    }
}

/* Where the index of a name begins; its length where it has none. */
static size_t index_in(const char *name)
{
    const size_t letters = strcspn(name, "_0123456789");
    const char *rest = name + letters + (name[letters] == '_');

    return letters > 0 && *rest && !strchr(rest, '_') ? letters : strlen(name);
}

void mathml_name(struct mathml *m, const char *name)
{
    char stem[EQUATION_NAME_BYTES];
    const size_t at = index_in(name);

    snprintf(stem, sizeof stem, "%.*s", (int)at, name);
    if (!name[at]) {
        put_letters(m, name);
        return;
    }
    mathml_open(m, "msub");
    put_letters(m, stem);
    put_letters(m, name + at + (name[at] == '_'));
    mathml_close(m, "msub");
}

bool mathml_is_word(const char *name)
{
    return index_in(name) > 1 && greek_of(name) < 0;
}
