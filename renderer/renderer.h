/* SPDX-License-Identifier: MIT */
/* The renderer: draws scenes as seen by cameras. Other layers include only this header,
 * worker/worker.h and pick.h. The renderer does not depend on HTTP, clients, sessions or users.
 *
 * Threads: one thread owns a renderer and everything made from it. Internal threads compile.
 * Messages are logged through renderer_params.log alone. */
#ifndef RENDERER_RENDERER_H
#define RENDERER_RENDERER_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "protocol/asset.h"
#include "protocol/limits.h"
#include "protocol/picture.h"
#include "protocol/render_request.h"
#include "protocol/scene.h"
#include "renderer/field/field_quality.h"
#include "renderer/gl/device.h"
#include "renderer/image/image.h"

struct field;    /* field/field.h */
struct renderer; /* a GL context on a device */
struct resident; /* a scene held ready for drawing, at a revision */
struct job;      /* one picture being drawn, tile by tile */

/* What computes pictures. */
enum render_stage {
    RENDER_AUTO,     /* the engine where the device is software, else the faster shaders of it */
    RENDER_COMPUTE,  /* compute shaders of the device */
    RENDER_FRAGMENT, /* fragment shaders of the device */
    RENDER_ENGINE,   /* vectors of the processors (renderer/engine) */
    RENDER_STAGES,
};
extern const char *const render_stage_names[RENDER_STAGES];

/* By which programs shaders draw a field. */
enum render_programs {
    PROGRAMS_AUTO,        /* either on a GPU, else compiled */
    PROGRAMS_COMPILED,    /* of the field alone: straight-line code */
    PROGRAMS_INTERPRETED, /* of its vocabulary: code that reads the field's operations */
    PROGRAMS_EITHER,      /* an interpreter until a compiled one is there, then the faster one */
    RENDER_PROGRAMS,
};
extern const char *const render_program_names[RENDER_PROGRAMS];

struct renderer_params {
    struct device_params device;
    enum render_stage stage;
    enum render_programs programs;
    int lanes;            /* of the engine's vectors; 0: the most */
    int threads;          /* of the engine; 0: one for each processor */
    int tile_side;        /* pixels, a multiple of 8; 0: what is good for the device */
    int code_ms, tile_ms; /* limits of processor time, for compiling code and for drawing the
                              * smallest tile; 0: those of limits.h */
    void (*log)(void *data, const char *line);
    void *log_data;
    /* Called with the structure before a program with users' code is compiled, and with 0
     * afterwards. Compilation waits until it returns. May be NULL. */
    void (*on_compile)(void *data, uint64_t structure_hash);
    /* The same for reading the picture of an environment: with its id, and with "" afterwards. */
    void (*on_read)(void *data, const char *image);
    void *on_compile_data;
    /* Whether the thread that draws has something else to do: asked by any thread that draws,
     * between vectors of a tile, which goes on with the next step then. NULL: never. */
    bool (*is_wanted)(void *data);
    void *is_wanted_data;
};

struct renderer_info {
    char name[128], version[128], device[192]; /* GL_RENDERER, GL_VERSION, path to the device */
    bool none;                                 /* no device: the engine draws */
    bool software;                             /* also without a device */
    bool compute;                              /* it has compute shaders: OpenGL 4.3 */
    enum render_stage stage;                   /* never RENDER_AUTO */
    int max_texture;
};

/* Loads GL, makes the context; NULL and `err` below GL 3.3 core, below 4.3 with RENDER_COMPUTE, or
 * without a device that `params` asks for. With DEVICE_AUTO the engine draws where no device can be
 * opened; the log says why. */
struct renderer *renderer_create(const struct renderer_params *params, struct error *err);
void renderer_destroy(struct renderer *renderer);
/* Scenes that are opened or edited from now on are drawn so; RENDER_AUTO as at first. A renderer
 * of a GPU that was made for RENDER_COMPUTE has no other; one without a device has the engine.
 * RENDER_COMPUTE needs `compute`. */
void renderer_use_stage(struct renderer *renderer, enum render_stage stage);
/* The same of programs; PROGRAMS_AUTO is what is good for the device. */
void renderer_use_programs(struct renderer *renderer, enum render_programs programs);
const struct renderer_info *renderer_info(const struct renderer *renderer);
/* Tries every device as renderer_create would; writes at most `max` rows, returns how many. */
size_t renderer_devices(const struct device_params *params, struct device_report *out, size_t max);

struct renderer_counters {
    uint64_t compilations; /* programs compiled and linked since the start */
    uint64_t cache_hits;   /* scenes whose structure was there already */
    uint64_t tiles, pictures;
    uint64_t rays;   /* reflected and refracted ones */
    uint64_t pixels; /* drawn by the engine, and not copied from the last picture */
};
struct renderer_counters renderer_counters(const struct renderer *renderer);
/* Drops what pictures keep for the next ones of their field: benchmarks draw each as the first. */
void renderer_forget(struct renderer *renderer);

/* A compilation, or the reading of a picture, that has used up its time (gl/program.h). */
struct renderer_stuck {
    uint64_t structure_hash;
    const char *image; /* "": it is the structure */
    bool still;
    int measured_ms, limit_ms;
};
/* The picture of an environment is being read: renderer_poll wants to be called. */
bool renderer_is_reading(const struct renderer *renderer);
bool renderer_stuck(const struct renderer *renderer, struct renderer_stuck *out);
/* What earlier processes learned of compiling a structure, or of reading a picture. */
struct renderer_verdict {
    uint64_t structure_hash;             /* 0: of a picture */
    char image[ASSET_ID_CHARACTERS + 1]; /* "": of a structure */
    enum error_kind refused;   /* never done again, for this reason; ERROR_NONE: it may be tried */
    int measured_ms, limit_ms; /* of ERROR_TOO_SLOW */
    int times;                 /* factor on the usual time limit; 0: 1 */
};
/* Applies to existing scenes too. */
void renderer_judge(struct renderer *renderer, const struct renderer_verdict *verdict);
/* How slow this machine compiles: program_cache_pace. */
double renderer_pace(const struct renderer *renderer);
/* Whether pictures of several clients wait: then tiles take a few milliseconds only. */
void renderer_share(struct renderer *renderer, bool shared);
void renderer_set_pace(struct renderer *renderer, double pace);

/* Adds a file that scenes name by its SHA-256. It is copied, and kept while a scene names it and
 * for some time after. Call it before the first such scene, or scenes that name it are reopened. */
void renderer_asset(struct renderer *renderer, const char *id, const void *bytes, size_t length);
/* While they are held, a new file takes the place of none: scenes may come that name them. */
void renderer_hold_assets(struct renderer *renderer, bool hold);

/* Whether the scene can be drawn, as far as that is known without a device: its code is read,
 * checked, bounded and run in C, and every limit of drawing holds. False and `err` with the place
 * that drawing names. `*out_warning` is a WARNING_LIPSCHITZ. Any thread, no renderer. What its
 * equations are worth is told by field_qualities. */
bool renderer_check(const struct scene *scene, struct error *out_warning, struct error *err);

/* Names of the passes whose GLSL depends on the scene, "march" first; NULL: there are no more. */
const char *renderer_pass_name(size_t pass);
/* The GLSL of one of them for a scene, as a GPU gets it, compiled or interpreted. Any thread, no
 * renderer. Caller frees; NULL and `err` where the scene cannot be drawn. */
char *renderer_shader(const struct scene *scene, size_t pass, enum render_programs programs,
                      struct error *err);

/* A picture of a scene as one fragment shader of WebGL 2 (GLSL ES 3.00), which needs no more than
 * its text: uniforms `resolution` and `orbit` (glsl/webgl_pass.glsl). `level`: enum quality_level,
 * -1: the scene's. A picture of the environment is left out. Any thread, no renderer. Caller frees;
 * NULL and `err` where the scene cannot be drawn. */
char *renderer_webgl(const struct scene *scene, int level, struct error *err);

/* --- scenes --- */

/* Takes `scene`. Compiling starts in the background. */
struct resident *resident_create(struct renderer *renderer, struct scene *scene, uint64_t revision);
void resident_destroy(struct resident *resident);
/* Replaces the document. The old state is drawn until the new one can be. Takes `scene`. */
void resident_replace(struct resident *resident, struct scene *scene, uint64_t revision);
/* A scene with its compiled field. Making one takes long, and needs no renderer. */
struct opened_scene {
    struct scene *scene;
    struct field *field; /* NULL: it is none, and `error` says why */
    struct error error;
};
/* Takes `scene`. `drawn`: resident_drawn_field of the resident whose scene is replaced; NULL: there
 * is none. Any thread. */
struct opened_scene opened_scene_make(struct scene *scene, const struct field *drawn);
/* The field that is drawn, or will be. Its hidden nodes stay in the program of the next field
 * (struct field_options). The resident's; NULL: none. */
struct field *resident_drawn_field(const struct resident *resident);
/* As above, for an opened scene. Its `scene` may be the resident's own. Both take scene and
 * field. */
struct resident *resident_create_opened(struct renderer *renderer,
                                        const struct opened_scene *opened, uint64_t revision);
void resident_replace_opened(struct resident *resident, const struct opened_scene *opened,
                             uint64_t revision);
/* Applies an edit that the front has already accepted. A numeric edit compiles nothing. */
bool resident_edit(struct resident *resident, const cJSON *ops, uint64_t revision,
                   struct error *err);
/* The same, without compiling. After an edit of more than numbers the resident is stale, until
 * resident_renew, or resident_replace_opened with its own scene. */
bool resident_apply(struct resident *resident, const cJSON *ops, uint64_t revision,
                    struct error *err);
bool resident_is_stale(const struct resident *resident);
void resident_renew(struct resident *resident); /* reopens it at once */
const struct scene *resident_scene(const struct resident *resident);
/* The newest structure if it has users' code; else 0. */
uint64_t resident_structure_with_code(const struct resident *resident);
uint64_t resident_revision(const struct resident *resident);       /* newest received */
uint64_t resident_shown_revision(const struct resident *resident); /* newest that can be drawn */
/* ERROR_NONE while all is well; else why the newest structure cannot be drawn. */
const struct error *resident_error(const struct resident *resident);
/* The newest structure; 0: it has none. */
uint64_t resident_structure_hash(const struct resident *resident);
/* The same where it is refused; else 0. */
uint64_t resident_refused_structure(const struct resident *resident);
enum warning_kind {
    WARNING_LIPSCHITZ, /* a function of a user is steeper than it says */
    WARNING_ASSET,     /* the picture around the scene is not there, or is none */
};
/* A fault of the newest state that does not prevent drawing; ERROR_NONE: none. */
struct warning {
    enum warning_kind kind;
    struct error error;
};
struct warning resident_warning(const struct resident *resident);
/* Whether users' code is tried out: then renderer_poll has more to do. */
bool renderer_is_trying(const struct renderer *renderer);
/* Takes finished compilations over, and tries users' code for a millisecond; true when some
 * resident can show something newer. `wait_ms` > 0 blocks at most that long for one. Call it
 * between tiles. */
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
    int samples;     /* per axis, 1..4; 0: the level's, or the scene's. Only AOV_COLOR uses it */
    int transparent; /* 1: the background is left out, 0: not; -1: the scene's render settings */
    bool careful;    /* drawing it has ended a process: begin with the smallest tiles */
    int patience;    /* factor on the time limit of a tile; 0: 1 */
    bool exact;      /* wait for the newest revision's shader; else draw what can be drawn now */
    bool in_rounds;  /* whole pictures of ever more samples (JOB_ROUND); color alone */
    bool sparse;     /* fewer rays than pixels, with one sample; the engine does so for color */
    bool as_floats;  /* give raw values (codec_is_raw), not 8/16-bit pixels */
    bool raw_depth;  /* of AOV_DEPTH at least */
    /* Ids of nodes. Only these and the nodes below them are seen, inside of the nodes around them.
     * Where the scene has none of them, all nodes are seen. Compiles nothing. Borrowed for the
     * call. */
    const char *const *isolated;
    size_t isolated_count;
    /* section_type: what it cuts is left out, and throws no shadow. NULL: nothing is cut. Copied.
     * Compiles nothing. */
    const struct record *section;
};

/* The picture that is asked for; the result points into the request. `careful` and `patience` are
 * not the request's. */
struct job_desc job_desc_of(const struct render_request *request);
struct encode_params encode_params_of(const struct render_request *request);

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
/* Draws a sample of each pixel of one tile and returns soon; earlier where the thread is wanted
 * (renderer_params.is_wanted). */
enum job_state job_step(struct job *job);
/* A tile has some of its samples. Until it has all, no other sampled job may be stepped, unless
 * this one is destroyed first: the samples of both lie in the same textures. */
bool job_is_within_tile(const struct job *job);
/* It has begun, and its pixels have several samples each. */
bool job_is_sampled(const struct job *job);
/* Nothing of this round is left to draw: the next step takes no time. */
bool job_is_drawn(const struct job *job);
/* False while a step would only wait for the compiler. */
bool job_step_possible(const struct job *job);
const struct error *job_error(const struct job *job);
uint64_t job_revision(const struct job *job);
/* The field that it draws: field_leaf_id gives the nodes of its raw `id` output. The job's. */
struct field *job_field(const struct job *job);
/* The structure that it draws if that has users' code; else 0. */
uint64_t job_structure_with_code(const struct job *job);
/* Microseconds by enum frame_stage. Stages that are measured elsewhere are 0. */
struct job_times {
    uint32_t us[FRAME_STAGES];
};
struct job_times job_times(const struct job *job);
/* Of its pixels, 0 to 1: the others are those of the picture before it. */
double job_drawn_part(const struct job *job);
struct picture_rounds job_rounds(const struct job *job);
void job_destroy(struct job *job); /* at any time: cancels */

/* In state JOB_ROWS: the next rows of an output, full width, as an image of so many rows. A job
 * holds one row of tiles at a time, so that the size of a picture is not bounded by memory. When
 * all outputs' rows were taken, job_step goes on. */
struct image job_take_rows(struct job *job, enum aov aov);
/* What the whole picture of an output will be, without pixels; width 0: it was not asked for. */
struct image job_image_info(const struct job *job, enum aov aov);
/* create + poll + step until done; for the command line and tests. One output. */
bool renderer_render(struct resident *resident, const struct job_desc *desc,
                     struct image *out_image, struct error *err);

#endif
