/* SPDX-License-Identifier: MIT */
/* A field after an edit, made from the field before. The changed numbers are written into a copy of
 * all numbers; everything else is shared. The result equals that of a full compilation, bit for
 * bit.
 *
 * A patch applies to operations that set
 * - a number, vector, switch or list of as many points as before among a node's parameters, those
 *   of an instance that its model declares too,
 * - a node's transform, or a part of it,
 * - a number, colour or switch among a material's properties, unless light goes through it now and
 *   did not before, or the other way,
 * - something of the environment, its floor too, unless that comes or goes,
 * - what is not of the field: names of nodes, the camera, rendering, and all about lights and
 *   volumes.
 * All else is recompiled: choices, code, materials of nodes, what is hidden and shown, types,
 * nodes that come, go or move, models, primitives and shaders. So is a number that changes more
 * than numbers: whether there is a guard around a subtree, or whether the scene is a field at all.
 *
 * Time: the nodes that have changed, all below one whose transform has, and those on the way to the
 * root; of their siblings no more than boxes are looked at, and only until they make up for the
 * change. */
#ifndef RENDERER_FIELD_PATCH_H
#define RENDERER_FIELD_PATCH_H

#include <cjson/cJSON.h>

#include "field.h"

/* From one vec4 of field.params to before another. */
struct field_span {
    size_t first, end;
};

/* `from` was compiled `patchable`, or patched, and is the newest of its kind; `ops` alone were
 * applied to the scene since. Returns the field with a reference of the caller's: `from` itself,
 * where nothing of the field has changed. NULL: it has to be compiled, and so have those after it
 * until one is `patchable` again.
 *
 * `spare` (may be NULL) is an older field of which the caller holds the only reference. If usable,
 * it is overwritten and returned. `*out_changed` is the range of numbers that differ from those in
 * `spare`; all numbers if it was not usable. */
struct field *field_patch(struct field *from, struct field *spare, const struct scene *scene,
                          const cJSON *ops, struct field_span *out_changed);
/* Ends patching from this field. A refused edit may have replaced nodes. */
void field_end_patches(struct field *from);

#endif
