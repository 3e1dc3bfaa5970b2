/* SPDX-License-Identifier: MIT */
/* A scene as it was at one revision, ready for drawing. Immutable and counted, so that pictures
 * under way are not torn by later edits. Belongs to the drawing thread. */
#ifndef RENDERER_SNAPSHOT_H
#define RENDERER_SNAPSHOT_H

#include "renderer.h"
#include "renderer/draw/draw.h"
#include "renderer/draw/trial.h"
#include "renderer/draw/upload.h"
#include "renderer/geometry.h"

struct snapshot {
    int references;
    uint64_t revision;
    struct upload *upload;
    struct geometry geometry;    /* with the field of `upload` */
    uint64_t structure_hash;     /* of the program that the device has, or would have; of the
                                  * interpreter where it has no other */
    struct program *program;     /* compiled for this field alone; NULL: none is wanted */
    struct program *interpreter; /* of its vocabulary; the same */
    struct record camera;        /* the document's */
    struct record render;        /* the document's */
    struct frame_uniforms frame; /* without camera and level */
    struct scene_bounds extent;
    struct environment *environment; /* NULL while `picture` is read */
    struct picture *picture;         /* that the environment is made of; NULL once it is */
    uint32_t environment_us;         /* time that it took */
    bool fewer_steps;                /* than the scene asks for: the driver's bound on loops */
    struct engine_program *engine;   /* NULL: the device draws it */
    struct engine_program *tapes;    /* of which the interpreter's are made; NULL: there is none */
    struct engine_program *bridge;   /* what draws while programs are compiled, and for good where
                                      * the driver refuses them; NULL: nothing */
    struct trial *trial;             /* of users' code that the engine draws; NULL: has none */
    struct warning warning; /* of users' code, when the program was new, or of the environment's
                             picture; ERROR_NONE: nothing */
    struct error error;    /* why it cannot be drawn although its program can; ERROR_NONE: it can */
    struct snapshot *next; /* among those of the renderer that wait for a picture */
};

struct renderer;

/* Compiles the field of a scene. Hidden nodes stay in the program (options->drawn), unless the
 * field is refused with them. NULL and `err` when the scene is no field. Any thread. */
struct field *snapshot_field(const struct scene *scene, const struct field_options *options,
                             struct error *err);
/* Finds or starts the program; takes the reference of `upload`. `before`: the snapshot before a
 * numeric edit, by which `upload` was patched; NULL: there is none. NULL and `err` when code of it
 * fails, or its structure is refused: then that is in `*out_refused`. */
struct snapshot *snapshot_create(struct renderer *renderer, const struct scene *scene,
                                 uint64_t revision, const struct snapshot *before,
                                 struct upload *upload, uint64_t *out_refused, struct error *err);
/* The extent of a geometry, and how it is made. `limit_loops`: as of struct scene_bounds. */
struct scene_bounds snapshot_bounds(const struct geometry *geometry, const struct record *camera,
                                    bool limit_loops);
struct snapshot *snapshot_ref(struct snapshot *snapshot);
/* Of its program, of users' code, and of the picture that its environment is made of. A program
 * that the driver refuses is no failure: the engine draws. */
enum program_state snapshot_state(const struct snapshot *snapshot);
const struct error *snapshot_error(const struct snapshot *snapshot); /* PROGRAM_FAILED: why */
/* What the device draws it by, once it is compiled: the faster one, as far as that is known; NULL:
 * the engine draws it. */
struct program *snapshot_program(const struct snapshot *snapshot);
/* Learns how long a picture took that `program` has drawn. */
void snapshot_learn(struct snapshot *snapshot, const struct program *program, uint64_t us,
                    int pixels);
/* Whether its program is all that it waits for, and the engine can draw it until then. */
bool snapshot_is_bridged(const struct snapshot *snapshot);
/* Of its code or its picture; ERROR_NONE: nothing, as far as is known. */
struct warning snapshot_warning(const struct snapshot *snapshot);
/* Makes the environments of those whose pictures were read. */
void snapshots_settle(struct renderer *renderer);
/* The structure of its program where there is code of users in it; else 0. */
uint64_t snapshot_structure_with_code(const struct snapshot *snapshot);
void snapshot_unref(struct renderer *renderer, struct snapshot *snapshot); /* NULL: nothing */
/* Uploads what a program reads and the device does not have yet. */
const struct param_buffer *snapshot_params(struct renderer *renderer, struct snapshot *snapshot,
                                           const struct program *program);
/* The same of tapes; 0: the program reads none. */
GLuint snapshot_tapes(struct renderer *renderer, struct snapshot *snapshot,
                      const struct program *program);

#endif
