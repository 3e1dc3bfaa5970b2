/* SPDX-License-Identifier: MIT */
/* The inside of a job, for the files job*.c. */
#ifndef RENDERER_JOB_INTERNAL_H
#define RENDERER_JOB_INTERNAL_H

#include "renderer_internal.h"

/* A row of tiles. */
struct row {
    int y;      /* from the top of the region */
    int x;      /* of the tile that is started next */
    int side;   /* of its tiles, at most */
    int height; /* of its tiles, */
    int width;  /* and of the one that is started next */
    struct pace_row pace;
};

/* Of a sample of a tile: by the clock or by the processors, whichever is less, because who has to
 * wait for a processor is not slow for that. */
struct watch {
    int64_t wall_us, cpu_us;
};

struct job {
    struct renderer *renderer;
    struct snapshot *snapshot;
    struct camera camera;
    const struct output_format *formats[AOV_COUNT]; /* NULL: not asked for */
    struct settings_request request;
    bool in_rounds;
    enum job_state state;
    int width, height; /* of the whole picture */
    struct job_region region;
    enum quality_level level;
    struct pace *pace;
    bool careful;
    bool exact;              /* the device's pixels are wanted, where it draws the scene */
    struct program *program; /* that draws it, since it was there when it began; NULL: the engine */
    int64_t limit_us;        /* that a sample of the smallest tile may take of the processors */
    struct row row;          /* that is being started */
    int started, collected;  /* tiles */
    struct watch sample;     /* what the one that is being drawn has taken so far */
    int steps[TILES_IN_FLIGHT]; /* samples drawn of the tile in each slot */
    int rows_height;            /* of the row of tiles collected last */
    bool begun;                 /* `picture` is valid */
    struct draw_picture picture;
    uint8_t *rows[AOV_COUNT]; /* of the row of tiles that is collected; NULL: taken, or none yet */
    double depth_far;
    struct job_times times;
    struct error error;
};

#endif
