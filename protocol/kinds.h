/* SPDX-License-Identifier: MIT */
/* Kinds that a document names by a word, and their numbers: each list makes an enum here, the words
 * in document_tables.c, and the names that GLSL has for them. Types of lights and volumes are the
 * rows of their tables; the words stand there. */
#ifndef PROTOCOL_KINDS_H
#define PROTOCOL_KINDS_H

#define SKY_KINDS(X) X(SKY_GRADIENT, "sky") X(SKY_SOLID, "solid") X(SKY_IMAGE, "image")
#define SHADOW_KINDS(X) X(SHADOW_NONE, "none") X(SHADOW_HARD, "hard") X(SHADOW_SOFT, "soft")
#define DENSITY_KINDS(X)                                                                           \
    X(DENSITY_CONSTANT, "constant") X(DENSITY_NOISE, "noise") X(DENSITY_FIELD, "field")
#define TONE_MAPS(X) X(TONE_NONE, "none") X(TONE_REINHARD, "reinhard") X(TONE_ACES, "aces")

#define LIGHT_KINDS(X) X(LIGHT_DIRECTIONAL) X(LIGHT_POINT) X(LIGHT_SPOT)
#define VOLUME_KINDS(X) X(VOLUME_BOX) X(VOLUME_SPHERE) X(VOLUME_ELLIPSOID)

#define KINDS_NAME(name, ...) name,
#define KINDS_WORD(name, word) word,

enum sky_kind { SKY_KINDS(KINDS_NAME) };
enum shadow_kind { SHADOW_KINDS(KINDS_NAME) };
enum density_kind { DENSITY_KINDS(KINDS_NAME) };
enum tone_map { TONE_MAPS(KINDS_NAME) };
enum light_kind { LIGHT_KINDS(KINDS_NAME) LIGHT_KIND_COUNT };
enum volume_kind { VOLUME_KINDS(KINDS_NAME) VOLUME_KIND_COUNT };

#endif
