/* SPDX-License-Identifier: MIT */
/* The tables of a picture: outputs, quality levels, and the stages whose time is reported.
 * Messages, options, REST, the schema and the docs are derived from them. */
#ifndef PROTOCOL_PICTURE_H
#define PROTOCOL_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "record.h"

/* --- outputs --- */

enum aov {
    AOV_COLOR,
    AOV_DEPTH,
    AOV_NORMAL,
    AOV_POSITION,
    AOV_ID,
    AOV_STEPS,
    AOV_ALBEDO,
    AOV_SPECULAR,
    AOV_OPTICAL,
    AOV_SHADOW,
    AOV_OCCLUSION,
    AOV_COUNT
};

struct aov_row {
    const char *name;
    int channels; /* of the array form */
    bool whole;   /* the array holds uint32, else float32 */
    bool picture; /* has a picture form too */
    const char *doc;
};

const struct aov_row *aov_row(enum aov aov);
const char *aov_name(enum aov aov);
int aov_find(const char *name);               /* -1: none */
extern const char *const aov_picture_names[]; /* those with a picture form; NULL-terminated */
/* Names with commas between them; each once. */
bool aovs_read(const char *text, bool out[AOV_COUNT], const char *place, struct error *err);
enum { AOVS_TEXT_BYTES = 128 };
/* The same in the table's order. */
void aovs_print(const bool which[AOV_COUNT], char out[AOVS_TEXT_BYTES]);

/* The picture form of `steps`: evenly from the first of these colours, no step, to the last, which
 * STEPS_WHITE and more have. sRGB, in equal steps of lightness. */
enum { STEPS_WHITE = 64, STEPS_COLORS = 5 };
extern const unsigned char steps_colors[STEPS_COLORS][3];

/* --- switches --- */

/* The words of a switch where it is a text: in a query and on the command line; NULL-terminated. */
extern const char *const switch_words[];
int switch_find(const char *word); /* 0 or 1; -1: none */

/* --- quality levels --- */

enum quality_level {
    QUALITY_DRAFT,
    QUALITY_INTERACTIVE,
    QUALITY_STILL,
    QUALITY_FINAL,
    QUALITY_COUNT
};

/* Choices of the render setting `antialiasing`. */
enum antialiasing {
    ANTIALIASING_AUTO, /* the level's */
    ANTIALIASING_NONE,
    ANTIALIASING_EDGES,    /* one sample; edges are blended */
    ANTIALIASING_ADAPTIVE, /* samples at edges, one elsewhere */
    ANTIALIASING_FULL,     /* samples everywhere */
};

struct quality {
    const char *doc;
    int samples; /* for each pixel along an axis; 0: as the scene says */
    enum antialiasing antialiasing;
    int lens_samples;      /* for each pixel where the camera has an aperture; 0: no blur */
    int shadow_steps;      /* of a ray to a light */
    int occlusion_samples; /* along the normal; 0: none */
    int ray_depth;         /* times that a ray is reflected or refracted */
    int rays;              /* reflected and refracted rays of one sample, at most */
    double min_throughput; /* of what a ray adds to its pixel; less is taken from the environment */
    int transmission_depth; /* surfaces that light goes through on its way to another */
    int volume_steps;       /* through a volume */
    int volume_shadow_steps;
};

const struct quality *quality_row(enum quality_level level);
extern const char *const quality_names[]; /* by level, NULL-terminated */
int quality_find(const char *name);       /* -1: none */

/* --- a request --- */

/* The members of a request for one picture, without scene, camera and format. As in a message, an
 * absent member has no default here. */
extern const struct record_type picture_type;
enum { PICTURE_WIDTH = 1280, PICTURE_HEIGHT = 720 }; /* where they are absent */

/* What a request may cut. Where nothing of it is set, nothing is cut. */
extern const struct record_type section_type;

/* --- rounds --- */

/* Of samples: one picture is drawn several times, each time of more of them. */
struct picture_rounds {
    int done, count;
};

/* --- time --- */

/* Where the time of a frame goes, in this order. */
enum frame_stage {
    FRAME_QUEUE,       /* waiting for other pictures */
    FRAME_ENVIRONMENT, /* light of the environment, when it is new */
    FRAME_MARCH,       /* rays from the camera to their surfaces */
    FRAME_MATERIAL,    /* what the surfaces are made of */
    FRAME_SHADOW,      /* shadows and occlusion */
    FRAME_SHADE,       /* light on surfaces, fog, background, tone mapping */
    FRAME_RAYS,        /* everything along reflected and refracted rays, and light through glass */
    FRAME_VOLUME,
    FRAME_RESOLVE, /* samples to pixels, edges */
    FRAME_READ,    /* to the processor */
    FRAME_ENCODE,
    FRAME_STAGES
};

struct stage_row {
    const char *name;
    const char *doc;
};
const struct stage_row *stage_row(enum frame_stage stage);
enum { STAGE_MEMBER_BYTES = 24 };
/* "march_us", the member of JSON that holds its microseconds. */
void stage_member(enum frame_stage stage, char out[STAGE_MEMBER_BYTES]);

#endif
