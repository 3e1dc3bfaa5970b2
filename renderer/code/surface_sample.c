/* SPDX-License-Identifier: MIT */
#include "surface_sample.h"

#include <stdlib.h>
#include <string.h>

#include "equation_value.h"

bool surface_reading_init(struct surface_reading *out, const struct surface *surface, int *out_part,
                          struct equation_errors *out_errors)
{
    int count = 0;

    *out = (struct surface_reading){0};
    for (int i = 0; i < SURFACE_LETTERS; i++) {
        if (surface->ranges[i].set) {
            out->low[count] = surface->ranges[i].low;
            out->high[count] = surface->ranges[i].high;
            out->letters[count++] = surface_names[SURFACE_PARTS + i];
        }
    }
    for (int i = 0; equation_letters[i]; i++) {
        out->letters[count++] = equation_letters[i];
    }
    for (int i = 0; i < SURFACE_PARTS; i++) {
        out->parts[i] = equation_read_expression(surface->parts[i], out->letters, out_errors);
        if (!out->parts[i]) {
            *out_part = i;
            surface_reading_finish(out);
            return false;
        }
    }
    return true;
}

void surface_reading_finish(struct surface_reading *reading)
{
    for (int i = 0; i < SURFACE_PARTS; i++) {
        free(reading->parts[i]);
        reading->parts[i] = NULL;
    }
}

void surface_point(const struct surface_reading *reading, const double *letters, double s, double t,
                   double *room, double out[3])
{
    const double at[SURFACE_PARAMETERS] = {s, t};
    double values[SURFACE_SAMPLE_LETTERS];

    for (int i = 0; i < SURFACE_PARAMETERS; i++) {
        values[i] = reading->low[i] * (1 - at[i]) + reading->high[i] * at[i];
    }
    for (int i = SURFACE_PARAMETERS; reading->letters[i]; i++) {
        values[i] = letters[i - SURFACE_PARAMETERS];
    }
    for (int i = 0; i < SURFACE_PARTS; i++) {
        out[i] = equation_expression_value(reading->parts[i], values, room);
    }
}

void surface_points(const struct surface_reading *reading, const double *letters, int count,
                    double *out)
{
    double room[LIMIT_EQUATION_NODES + 1];

    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++, out += 3) {
            surface_point(reading, letters, (double)i / (count - 1), (double)j / (count - 1), room,
                          out);
        }
    }
}
