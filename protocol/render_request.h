/* SPDX-License-Identifier: MIT */
/* A request for one picture. REST reads it from a query or from JSON, the command line from
 * options. A live view builds it. A packet carries it to the worker. Each member of a picture is a
 * row of picture_type, from which requests are read and printed. */
#ifndef PROTOCOL_RENDER_REQUEST_H
#define PROTOCOL_RENDER_REQUEST_H

#include <stdint.h>

#include "codec.h"
#include "id_set.h"
#include "picture.h"

struct render_request {
    struct record picture;  /* picture_type; what is not set the level or the scene decides */
    struct record camera;   /* camera_type; what is set changes the scene's */
    struct record section;  /* section_type; empty: nothing is cut */
    struct record delivery; /* delivery_type */
    struct id_set isolate;  /* only these nodes and what is below them; none: all */
    enum codec codec;
};

/* Switches of the delivery from renderer to client. They are internal:
 * `exact`: wait for the newest revision's shader, else draw the newest drawable state;
 * `in_rounds`: of ever more samples, each a whole picture;
 * `sparse`: of fewer rays than pixels, for a picture that moves;
 * `chroma_halved`: JPEG 4:2:0; `fast`: PNG that is quick to write; `zipped`: a ZIP also of one;
 * `guide`: a CODEC_GUIDE, of the output id as NPY; `depths`: those of blocks of pixels behind the
 * picture, of the outputs color and depth; `stream`: the name of a stream that goes on from the
 * picture of the order `base` to this one, 0: from none; `whole`: where it is a difference from
 * that, the whole picture too. */
extern const struct record_type delivery_type;

/* A colour picture of the usual size, PNG. */
void render_request_init(struct render_request *request);
void render_request_finish(struct render_request *request); /* also of a zeroed one */
void render_request_copy(struct render_request *to, const struct render_request *from);
bool render_request_equal(const struct render_request *a, const struct render_request *b);

/* How members are written where they come from, and so how errors name their places:
 * /camera/fov, ?camera.fov, --camera-fov. */
enum request_form { REQUEST_JSON, REQUEST_QUERY, REQUEST_OPTION };

/* One member by its name in that form, from its text. */
bool render_request_set_text(struct render_request *request, enum request_form form,
                             const char *name, const char *text, struct error *err);
/* The members of `picture`, "camera", "section" and "format" from an object. Unknown ones are
 * refused. */
bool render_request_read(struct render_request *request, const cJSON *object, struct error *err);
/* After the members: what the rows cannot say of them. Equal requests then print equal texts. */
bool render_request_check(struct render_request *request, enum request_form form,
                          struct error *err);

/* All of it, for the worker, and back. Caller frees. */
cJSON *render_request_print(const struct render_request *request);
bool render_request_unpack(struct render_request *request, const cJSON *object, struct error *err);

/* What it changes is put on top of this camera, the scene's; nothing, where it changes nothing. */
void render_request_see_from(struct render_request *request, const struct record *camera);
void render_request_outputs(const struct render_request *request, bool out[AOV_COUNT]);
/* Pixels of the answer: of the region where there is one. */
void render_request_size(const struct render_request *request, int *out_width, int *out_height);
/* Of the whole picture. */
int64_t render_request_pixels(const struct render_request *request);
/* A number of `picture`, a switch of `delivery`. */
int render_request_int(const struct render_request *request, const char *name);
bool render_request_is(const struct render_request *request, const char *name);

#endif
