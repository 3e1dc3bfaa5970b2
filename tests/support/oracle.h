/* SPDX-License-Identifier: MIT */
/* What the C evaluator says of a picture: depth, normal and id along rays that this file makes from
 * the camera by itself and marches in double precision; and how much of a picture differs. Places
 * are every so many pixels of it. */
#ifndef TESTS_SUPPORT_ORACLE_H
#define TESTS_SUPPORT_ORACLE_H

#include "renderer/field/field.h"
#include "renderer/renderer.h"

struct oracle_found {
    double t; /* -1: nothing */
    double normal[3];
    double slant; /* cosine between the normal and the ray */
    uint32_t id;  /* 0: nothing */
};

struct oracle_params {
    int width, height; /* in places */
    int every;         /* pixels, each way */
    double tolerance;  /* so near is on the surface */
    double
        gradient; /* half edge of the tetrahedron that normals are taken of; 0: half a footprint */
    double end_of_sight; /* beyond so much of the greatest distance a hit is no silhouette */
    double degrees;      /* between normals that agree */
    bool inner_only;     /* depths and normals of other places are not judged */
    /* Whether a depth is that of the place: `footprint` is half a pixel there. */
    bool (*is_near)(const struct oracle_found *found, double depth, double footprint);
};

struct oracle;

/* The caller destroys it. */
struct oracle *oracle_create(const struct scene *scene, const struct oracle_params *params);
void oracle_destroy(struct oracle *oracle);

/* Inner places are those all of whose neighbours hit the same leaf. */
struct oracle_tally {
    int either, both; /* places hit */
    int judged, inner;
    int depths, normals; /* off, of the judged */
    int ids;             /* off, of the inner */
};

/* Draws the newest revision and compares. */
struct oracle_tally oracle_judge(const struct oracle *oracle, struct renderer *renderer,
                                 struct resident *resident);

/* The least of silhouettes, and the most of what is off: parts of 1. */
struct oracle_bounds {
    double overlap; /* hit in both, of those hit in either */
    double depths, normals, ids;
};
/* False where more is off than may be; then, or where `wordy`, with all figures after `name`. */
bool oracle_agrees(const char *name, const struct oracle_tally *tally,
                   const struct oracle_bounds *bounds, bool wordy);

#endif
