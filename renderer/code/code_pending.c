/* SPDX-License-Identifier: MIT */
/* Stands in until users' code can be compiled: refuses all. */
#include "code.h"

struct code *code_compile(const struct code_source *source, struct error *err)
{
    (void)source;
    error_set(err, ERROR_COMPILE, "", "code is not supported yet");
    return NULL;
}

void code_destroy(struct code *code)
{
    (void)code;
}

void code_write(const struct code *code, const char *name, int source_number, FILE *out)
{
    (void)code, (void)name, (void)source_number, (void)out;
}

int code_trips(const struct code *code)
{
    (void)code;
    return 0;
}

double code_distance(const struct code *code, const double p[3], const double *n,
                     struct code_fault *fault)
{
    (void)code, (void)p, (void)n, (void)fault;
    return 1e9;
}

void code_shade(const struct code *code, const struct code_shading *at, const double *n,
                double out_rgba[4], struct code_fault *fault)
{
    (void)code, (void)at, (void)n, (void)fault;
    out_rgba[0] = out_rgba[1] = out_rgba[2] = out_rgba[3] = 0;
}
