/* SPDX-License-Identifier: MIT */
/* Functions that users' code can call, as kernels: GLSL that calls each row of builtin_table with
 * numbers of a frame, which are the bits of what they stand for (renderer/engine/code.c). */
#include "calls.h"

#include <string.h>

#include "renderer/code/builtins.h"

/* One kernel: a row, the base of its first argument, and the size of what it takes as a whole. */
struct call {
    const struct builtin *row;
    enum base base;
    int n;
};

static bool is_whole(const struct builtin *row)
{
    return row->whole != NULL;
}

static bool takes_matrix(const struct call *call)
{
    return is_whole(call->row) &&
           (call->row->family == FAMILY_MATRIX || call->row->family == FAMILY_DETERMINANT);
}

/* Rows of the first argument, which name the kernel. */
static int jet_rows(const struct builtin *row)
{
    return builtin_jet_type(row->sizes[1]).rows;
}

/* Kernels of jets take matrices, of which these begin with their numbers. */
static void write_jet_argument(FILE *out, char name, uint8_t size)
{
    if (size == BUILTIN_JET) {
        fprintf(out, "%c", name);
    } else if (size == 4) {
        fprintf(out, "vec4(%c[0], %c[1].x)", name, name);
    } else {
        fprintf(out, "%c[0].%.*s", name, size, "xyz");
    }
}

static enum base argument_base(const struct call *call, int i)
{
    return call->row->family == FAMILY_SELECT && i == 2    ? BASE_BOOL
           : call->row->family == FAMILY_OCTAVES && i == 1 ? BASE_INT
                                                           : call->base;
}

static void write_number(FILE *out, enum base base, char argument, const char *part)
{
    static const char *const rows[][2] = {[BASE_FLOAT] = {"", ""},
                                          [BASE_INT] = {"int(floatBitsToUint(", "))"},
                                          [BASE_UINT] = {"floatBitsToUint(", ")"},
                                          [BASE_BOOL] = {"(floatBitsToUint(", ") != 0u)"}};

    fprintf(out, "%s%c%s%s", rows[base][0], argument, part, rows[base][1]);
}

/* An argument as the function takes it. */
static void write_argument(FILE *out, const struct call *call, int i)
{
    const enum base base = argument_base(call, i);
    const char name = (char)('a' + i);
    const bool one =
        call->n == 1 || base != call->base || (call->row->family == FAMILY_REFRACT && i == 2);

    if (call->row->family == FAMILY_JET) {
        write_jet_argument(out, name, call->row->sizes[1 + i]);
    } else if (!is_whole(call->row)) {
        write_number(out, base, name, "");
    } else if (one) {
        write_number(out, base, name, ".x");
    } else if (base == BASE_BOOL) {
        fprintf(out, "bvec%d(", call->n);
        for (int k = 0; k < call->n; k++) {
            static const char *const parts[] = {".x", ".y", ".z", ".w"};
            fputs(k > 0 ? ", " : "", out);
            write_number(out, base, name, parts[k]);
        }
        fprintf(out, ")");
    } else {
        fprintf(out, "%c", name);
    }
}

static void write_value(FILE *out, const struct call *call)
{
    const char *text = call->row->glsl ? call->row->glsl : call->row->name;

    if (!strchr(text, '$')) {
        fprintf(out, "%s(", text);
        for (int i = 0; i < call->row->arguments; i++) {
            fputs(i > 0 ? ", " : "", out);
            write_argument(out, call, i);
        }
        fprintf(out, ")");
        return;
    }
    for (; *text; text++) {
        if (*text == '$') {
            write_argument(out, call, *++text - '0');
        } else {
            fprintf(out, "%c", *text);
        }
    }
}

static bool gives_one(const struct call *call)
{
    switch (call->row->family) {
    case FAMILY_SCALAR:
    case FAMILY_PLACE:
    case FAMILY_OCTAVES:
    case FAMILY_DETERMINANT:
    case FAMILY_COUNT:
        return true;
    case FAMILY_JET:
        return call->row->sizes[0] == 1;
    default:
        return !is_whole(call->row) || call->n == 1;
    }
}

static enum base result_base(const struct call *call)
{
    switch (call->row->family) {
    case FAMILY_TEST:
    case FAMILY_COMPARE:
    case FAMILY_EQUAL:
    case FAMILY_LOGIC:
    case FAMILY_COUNT:
        return BASE_BOOL;
    default:
        return call->base;
    }
}

static void write_name(FILE *out, const struct call *call)
{
    fprintf(out, "kernel_call_%d_%d_%d", (int)(call->row - builtin_table), (int)call->base,
            call->n);
}

/* float kernel_call_R_B_1(float a, float b, float c), component by component;
 * float or vecN kernel_call_R_B_N(vecN a, vecN b, vecN c) of what is taken as a whole. */
static void write_function(FILE *out, const struct call *call)
{
    static const char *const backs[] = {[BASE_FLOAT] = "(",
                                        [BASE_INT] = "uintBitsToFloat(uint(",
                                        [BASE_UINT] = "uintBitsToFloat((",
                                        [BASE_BOOL] = "uintBitsToFloat(bits_of_bool("};
    const enum base back = result_base(call);
    char type[8] = "float", result[TYPE_NAME_BYTES];

    if (call->row->family == FAMILY_JET) {
        snprintf(type, sizeof type, "mat3");
    } else if (is_whole(call->row)) {
        snprintf(type, sizeof type, takes_matrix(call) ? "mat%d" : "vec%d",
                 call->n > 1 ? call->n : 2);
    }
    if (gives_one(call)) {
        fprintf(out, "float ");
    } else if (call->row->family == FAMILY_JET) {
        fprintf(out, "%s ", type_name(builtin_jet_type(call->row->sizes[0]), result));
    } else if (call->row->family == FAMILY_OUTER) {
        fprintf(out, "mat%d ", call->n);
    } else {
        fprintf(out, "%s ", type);
    }
    write_name(out, call);
    fprintf(out, "(%s a, %s b, %s c)\n{\nreturn ", type, type, type);
    fputs(backs[back], out);
    write_value(out, call);
    fprintf(out, back == BASE_FLOAT ? ");\n}\n" : "));\n}\n");
}

static void write_call(FILE *out, const struct call *call, bool table)
{
    if (!table) {
        write_function(out, call);
        return;
    }
    fprintf(out, "CALL_ROW(%d, %d, %d, %d, spmd_", (int)(call->row - builtin_table),
            (int)call->base, call->n, gives_one(call));
    write_name(out, call);
    fprintf(out, ")\n");
}

/* The bases that the first argument may have, as bits. */
static unsigned bases_of(enum family family)
{
    enum { F = 1 << BASE_FLOAT, I = 1 << BASE_INT, U = 1 << BASE_UINT, B = 1 << BASE_BOOL };
    switch (family) {
    case FAMILY_SIGNED:
        return F | I;
    case FAMILY_NUMBER:
    case FAMILY_COMPARE:
        return F | I | U;
    case FAMILY_EQUAL:
        return F | I | U | B;
    case FAMILY_LOGIC:
    case FAMILY_COUNT:
        return B;
    default:
        return F;
    }
}

/* The sizes of what is taken as a whole. */
static void sizes_of(const struct builtin *row, int *out_first, int *out_last)
{
    const bool of_three =
        row->family == FAMILY_CROSS || row->family == FAMILY_PLACE || row->family == FAMILY_OCTAVES;
    const bool of_one = row->family == FAMILY_SCALAR || row->family == FAMILY_SHAPE ||
                        row->family == FAMILY_REFRACT;

    *out_first = !is_whole(row) || of_one ? 1 : of_three ? 3 : 2;
    *out_last = !is_whole(row) ? 1 : of_three ? 3 : 4;
    if (row->family == FAMILY_JET) {
        *out_first = *out_last = jet_rows(row);
    }
}

void spmd_write_calls(FILE *out, bool table)
{
    if (!table) {
        fprintf(out, "uint bits_of_bool(bool b)\n{\nreturn b ? 0xffffffffu : 0u;\n}\n");
    }
    for (const struct builtin *row = builtin_table; row->name; row++) {
        int first, last;
        sizes_of(row, &first, &last);
        for (int n = first; n <= last && row->family != FAMILY_PRODUCT; n++) {
            for (int base = BASE_FLOAT; base <= BASE_BOOL; base++) {
                if (bases_of(row->family) >> base & 1) {
                    write_call(out, &(struct call){row, (enum base)base, n}, table);
                }
            }
        }
    }
}
