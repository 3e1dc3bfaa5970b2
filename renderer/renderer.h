/* SPDX-License-Identifier: MIT */
/* Scenes seen by cameras become pixels. With worker.h the only header of this layer that others
 * include. Knows nothing of HTTP, clients, sessions or users.
 *
 * Threads: one thread owns a renderer and everything made from it. (Inside, a second thread
 * compiles; nobody sees it.) Nothing here logs but through renderer_params.log. */
#ifndef RENDERER_RENDERER_H
#define RENDERER_RENDERER_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "protocol/limits.h"
#include "protocol/picture.h"
#include "protocol/scene.h"

struct renderer; /* a GL context on a device */
struct resident; /* a scene held ready for drawing, at a revision */
struct job;      /* one picture being drawn, tile by tile */

enum device_kind { DEVICE_AUTO, DEVICE_GPU, DEVICE_SOFTWARE };

struct renderer_params {
    enum device_kind device; /* DEVICE_GPU: an error where there is only software */
    int device_index;        /* among renderer_devices(); -1: the best */
    int tile_side;           /* pixels, a multiple of 8; 0: what is good for the device */
    const char *cache_dir;   /* for Mesa's shader cache; NULL: the driver's default */
    void (*log)(void *data, const char *line);
    void *log_data;
    /* Called before a program with code of users is compiled, which waits until this returns, with
     * its shape, and with 0 when that is over. May be NULL. */
    void (*on_compile)(void *data, uint64_t shape);
    void *on_compile_data;
};

struct renderer_info {
    char name[128], version[128], device[192]; /* GL_RENDERER, GL_VERSION, path to the device */
    bool software;
    int max_texture;
};

/* What `doctor` shows: one line per EGL device, why it was or was not chosen. */
struct device_report {
    char name[192];
    char verdict[192];
    bool software, usable, chosen;
};

/* Loads GL, makes the context; NULL and `err` below GL 4.3 core or without a device. */
struct renderer *renderer_create(const struct renderer_params *params, struct error *err);
void renderer_destroy(struct renderer *renderer);
const struct renderer_info *renderer_info(const struct renderer *renderer);
/* Tries every device as renderer_create would; writes at most `max` rows, returns how many. */
size_t renderer_devices(const struct renderer_params *params, struct device_report *out,
                        size_t max);

struct renderer_counters {
    uint64_t compilations; /* programs compiled and linked since the start */
    uint64_t cache_hits;   /* scenes whose shape was there already */
    uint64_t tiles, pictures;
    uint64_t rays; /* mirrored and broken ones */
};
struct renderer_counters renderer_counters(const struct renderer *renderer);

/* Whether a compiler has been at work for so long (limits.h) that it may never end. */
bool renderer_stuck(const struct renderer *renderer);
/* Scenes of this shape are never compiled: ERROR_QUARANTINED. For those that ended a process. */
void renderer_refuse(struct renderer *renderer, uint64_t shape);

/* A file that scenes name by its SHA-256, copied; it stays while a scene names it, and for some
 * others after it. Before the first scene that does, or those are looked at anew. */
void renderer_asset(struct renderer *renderer, const char *id, const void *bytes, size_t length);

/* --- scenes --- */

/* Takes `scene`. Compiling starts in the background. */
struct resident *resident_create(struct renderer *renderer, struct scene *scene, uint64_t revision);
void resident_destroy(struct resident *resident);
/* Another document; what can be drawn stays until the new one can. Takes `scene`. */
void resident_replace(struct resident *resident, struct scene *scene, uint64_t revision);
/* Applies an edit that the front has already accepted. A numeric edit compiles nothing. */
bool resident_edit(struct resident *resident, const cJSON *ops, uint64_t revision,
                   struct error *err);
const struct scene *resident_scene(const struct resident *resident);
/* The newest shape where there is code of users in it; else 0. */
uint64_t resident_shape_with_code(const struct resident *resident);
uint64_t resident_revision(const struct resident *resident);       /* newest told */
uint64_t resident_shown_revision(const struct resident *resident); /* newest that can be drawn */
/* ERROR_NONE while all is well; else why the newest shape cannot be drawn. */
const struct error *resident_error(const struct resident *resident);
/* What is not right with the newest state, and yet drawn; kind ERROR_NONE: nothing. */
const struct error *resident_warning(const struct resident *resident);
/* Takes finished compilations over; true when some resident can show something newer. `wait_ms`
 * > 0 blocks at most that long for one. Call it between tiles. */
bool renderer_poll(struct renderer *renderer, int wait_ms);

/* --- pictures --- */

struct job_region {
    int x, y, width, height; /* pixels of the whole picture, y down */
};

struct job_desc {
    int width, height;           /* of the whole picture */
    struct job_region region;    /* what of it is drawn; width 0: all */
    const struct record *camera; /* camera_type; NULL: the scene's. Copied. */
    bool aovs[AOV_COUNT];        /* what it shows; none: color */
    int level;                   /* enum quality_level; -1: the scene's render settings say it */
    int samples;      /* per axis, 1..4; 0: the level's, or the scene's. Only AOV_COLOR uses it */
    int transparent;  /* 1: the background is left out, 0: not; -1: the scene's render settings */
    bool exact;       /* wait for the newest revision's shader; else draw the newest drawable */
    bool in_rounds;   /* of ever more samples, each a whole picture: JOB_ROUND. Color alone */
    bool as_floats;   /* give raw values (NPY), not 8/16-bit pixels */
    bool from_camera; /* one program for one sample instead of passes: for comparison. Without
                         volumes, and light through clear things keeps its colour */
};

enum job_state {
    JOB_WAITING, /* for a compilation */
    JOB_RUNNING,
    JOB_ROWS,  /* some rows are finished: job_take_rows */
    JOB_ROUND, /* all rows were taken; they come again, made of more samples */
    JOB_DONE,
    JOB_FAILED
};

/* The job draws the scene as it is now: later edits do not touch it. In rounds, the last picture is
 * the same as without; rounds before it have 4, 16 samples of each pixel. */
struct job *job_create(struct resident *resident, const struct job_desc *desc, struct error *err);
/* Draws a sample of each pixel of one tile and returns soon. */
enum job_state job_step(struct job *job);
/* A tile has samples and wants more: until it has them only this job may be stepped, or it must be
 * destroyed, because all jobs' samples lie in the same textures. */
bool job_is_within_tile(const struct job *job);
/* False while a step would only wait for the compiler. */
bool job_step_possible(const struct job *job);
const struct error *job_error(const struct job *job);
uint64_t job_revision(const struct job *job);
/* The shape of what it draws where there is code of users in it; else 0. */
uint64_t job_shape_with_code(const struct job *job);
/* Microseconds by enum frame_stage; those that only others know are 0. */
struct job_times {
    uint32_t us[FRAME_STAGES];
};
struct job_times job_times(const struct job *job);
void job_destroy(struct job *job); /* at any time: cancels */

/* Rows from the top, no padding. PIXEL_RGBA8 has four bytes for each pixel also with 3 channels:
 * the fourth means nothing then. */
enum pixel_format { PIXEL_RGBA8, PIXEL_GRAY16, PIXEL_FLOAT, PIXEL_UINT32 };
struct image {
    int width, height;
    int channels;
    enum pixel_format format;
    void *pixels; /* owned */
    size_t bytes;
};
void image_finish(struct image *image);
/* In state JOB_ROWS: the next rows of an output, full width, as an image of so many rows. A job
 * holds one row of tiles at a time, so that the size of a picture is not bounded by memory. When
 * all outputs' rows were taken, job_step goes on. */
struct image job_take_rows(struct job *job, enum aov aov);
/* What the whole picture of an output will be, without pixels; width 0: it was not asked for. */
struct image job_image_shape(const struct job *job, enum aov aov);
/* create + poll + step until done; for the command line and tests. One output. */
bool renderer_render(struct resident *resident, const struct job_desc *desc,
                     struct image *out_image, struct error *err);

enum image_format { IMAGE_PNG, IMAGE_JPEG, IMAGE_NPY };
int image_format_find(const char *name); /* "png" "jpg" "jpeg" "npy"; -1: none */
const char *image_format_name(enum image_format format);
const char *image_format_mime(enum image_format format);
struct encode_params {
    enum image_format format;
    int quality;        /* JPEG 1..100; 0: 90 */
    bool chroma_halved; /* JPEG 4:2:0 */
    bool fast;          /* PNG level 1, filter SUB: for streaming; the pixels are the same */
    bool zipped;        /* a ZIP also of one output */
    size_t limit_bytes; /* of the file; 0: none */
};
/* `*out_bytes` is malloc'ed. */
bool image_encode(const struct image *image, const struct encode_params *params,
                  uint8_t **out_bytes, size_t *out_length, struct error *err);

/* The file of a picture, written as its rows come: one output in its format, several in a ZIP of
 * color.png, depth.png and so on; they wait in temporary files meanwhile. Any thread, one at a
 * time. */
struct picture_file;
/* `shapes`: those of job_image_shape. `out` stays the caller's. NULL and `err` where the format
 * cannot hold them. */
struct picture_file *picture_file_create(const struct image shapes[AOV_COUNT],
                                         const struct encode_params *params, FILE *out,
                                         struct error *err);
const char *picture_file_mime(const struct picture_file *file);
bool picture_file_add(struct picture_file *file, enum aov aov, const struct image *rows,
                      struct error *err);
/* When all rows of all outputs were added. */
bool picture_file_end(struct picture_file *file, struct error *err);
void picture_file_destroy(struct picture_file *file);

/* --- questions --- */

struct pick_result {
    bool hit;
    char node[LIMIT_ID_BYTES + 1]; /* the leaf that gave the surface; "": the floor */
    double position[3], normal[3], distance;
};
/* On the CPU, with the C evaluator; x and y in pixels of a width×height view. */
struct pick_result resident_pick(const struct resident *resident, const struct record *camera,
                                 int width, int height, double x, double y);

#endif
