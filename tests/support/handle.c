/* SPDX-License-Identifier: MIT */
#include "handle.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    const char *at;
    const struct record *record;
    bool failed;
};

static double read_sum(struct reader *reader);

static bool take(struct reader *reader, char wanted)
{
    reader->at += strspn(reader->at, " ");
    const bool found = *reader->at == wanted;
    reader->at += found;
    return found;
}

static void expect(struct reader *reader, char wanted)
{
    reader->failed = !take(reader, wanted) || reader->failed;
}

static double read_argument(struct reader *reader)
{
    expect(reader, '(');
    const double value = read_sum(reader);
    expect(reader, ')');
    return value;
}

static double fail(struct reader *reader)
{
    reader->failed = true;
    return NAN;
}

/* Of `skin` and `out`; NAN: it is neither. */
static double around(struct reader *reader, const char *name)
{
    const bool skin = strcmp(name, "skin") == 0;

    if ((!skin && strcmp(name, "out") != 0) || !take(reader, '.')) {
        return NAN;
    }
    const char axis = *reader->at++;
    return axis == 'x' ? (skin ? HANDLE_SKIN : 1) : axis == 'y' || axis == 'z' ? 0 : fail(reader);
}

/* A number of the record: a vector's with its component, any other without. */
static double named(struct reader *reader, const char *name)
{
    const int index = record_type_find(reader->record->type, name);
    const double known = index < 0 ? around(reader, name) : NAN;

    if (index < 0) {
        return isnan(known) ? fail(reader) : known;
    }
    const struct param *param = &reader->record->type->params[index];
    const int count = param_components(param->type);
    const bool counted = param->type != PARAM_BOOL && param->type != PARAM_ENUM;
    int part = 0;
    if (count > 1 && *reader->at == '.') {
        const char *found = reader->at[1] ? strchr("xyzw", reader->at[1]) : NULL;
        part = found ? (int)(found - "xyzw") : count;
        reader->at += found ? 2 : 1;
    } else if (count != 1) {
        return fail(reader);
    }
    return part < count && counted ? reader->record->values[index].number[part] : fail(reader);
}

static double read_name(struct reader *reader)
{
    char name[32];
    size_t length = 0;

    while (isalnum((unsigned char)reader->at[length]) || reader->at[length] == '_') {
        length++;
    }
    snprintf(name, sizeof name, "%.*s", (int)length, reader->at);
    reader->at += length;
    return strcmp(name, "pi") == 0     ? acos(-1)
           : strcmp(name, "sqrt") == 0 ? sqrt(read_argument(reader))
           : strcmp(name, "sin") == 0  ? sin(read_argument(reader))
           : strcmp(name, "cos") == 0  ? cos(read_argument(reader))
                                       : named(reader, name);
}

static double read_atom(struct reader *reader)
{
    reader->at += strspn(reader->at, " ");
    if (*reader->at == '(') {
        return read_argument(reader);
    }
    if (isdigit((unsigned char)*reader->at)) {
        char *end;
        const double value = strtod(reader->at, &end);
        reader->at = end;
        return value;
    }
    return read_name(reader);
}

/* -x^2 is -(x^2). */
static double read_factor(struct reader *reader)
{
    if (take(reader, '-')) {
        return -read_factor(reader);
    }
    const double base = read_atom(reader);
    return take(reader, '^') ? pow(base, read_factor(reader)) : base;
}

static double read_product(struct reader *reader)
{
    double value = read_factor(reader);

    while (!reader->failed) {
        if (take(reader, '*')) {
            value *= read_factor(reader);
        } else if (take(reader, '/')) {
            value /= read_factor(reader);
        } else {
            break;
        }
    }
    return value;
}

static double read_sum(struct reader *reader)
{
    double value = read_product(reader);

    while (!reader->failed) {
        if (take(reader, '+')) {
            value += read_product(reader);
        } else if (take(reader, '-')) {
            value -= read_product(reader);
        } else {
            break;
        }
    }
    return value;
}

int handle_points(const char *text, const struct record *record, double out[HANDLE_POINTS][3])
{
    struct reader reader = {.at = text, .record = record};
    int count = 0;

    do {
        for (int i = 0; i < 3; i++) {
            out[count][i] = read_sum(&reader);
            if (i < 2) {
                expect(&reader, ',');
            }
        }
        count++;
    } while (count < HANDLE_POINTS && take(&reader, ';'));
    return reader.failed || *reader.at ? 0 : count;
}
