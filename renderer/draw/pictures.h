/* SPDX-License-Identifier: MIT */
/* Pictures of environments. A separate thread decodes their files and prepares them for the passes,
 * one at a time. Drawing never waits for it. Every function is called by the drawing thread. */
#ifndef RENDERER_PICTURES_H
#define RENDERER_PICTURES_H

#include "asset.h"
#include "renderer/engine/engine.h"

struct pictures;
struct picture; /* a file that is read, or was; counted */

struct pictures *pictures_create(void); /* starts the thread; dies without one (aborts) */
/* Waits for the picture being read. No reference to a picture is left. */
void pictures_destroy(struct pictures *pictures);

/* Queues the file for reading; it is dropped if its last reference goes before. Returns a new
 * reference. */
struct picture *pictures_want(struct pictures *pictures, struct asset *asset);
void picture_unref(struct pictures *pictures, struct picture *picture); /* NULL: nothing */
const char *picture_id(const struct picture *picture);
/* It was read, or cannot be. */
bool picture_is_done(const struct picture *picture);
/* Of one that is done: what engine_maps_make made of it, the picture's own; who needs them may
 * take them. NULL: it has none, or they were taken. */
struct engine_map *picture_maps(struct picture *picture);
/* Why it has none, as a warning at /environment/image; the asset has it too. */
const struct error *picture_problem(const struct picture *picture);
uint32_t picture_us(const struct picture *picture); /* time that reading took */

/* The next picture to read, which waits for pictures_allow. NULL: there is none, or one is being
 * read, which `*out_reading` is then. */
struct picture *pictures_next(struct pictures *pictures, struct picture **out_reading);
/* `limit_ms`: of the processor, for pictures_stuck. */
void pictures_allow(struct pictures *pictures, struct picture *picture, int limit_ms);
/* Takes over a picture that was read, after at most `wait_ms`. False: there is none. */
bool pictures_collect(struct pictures *pictures, int wait_ms);
/* Time of the processor that the thread has used. */
int64_t pictures_cpu_us(const struct pictures *pictures);

/* A picture whose reading has used more processor time than it may. */
struct pictures_stuck {
    const char *id;
    int measured_ms, limit_ms;
};
bool pictures_stuck(const struct pictures *pictures, struct pictures_stuck *out);

#endif
