/* SPDX-License-Identifier: MIT */
/* What a point of a surface is made of: filled in by surface() of the field's text. */

#include "interface.glsl"

struct Surface {
    vec3 ambient; /* part of the environment's light taken up */
    vec3 diffuse;
    vec3 specular; /* of the highlight; of standard: what is reflected at normal incidence */
    vec3 emission;
    vec3 absorption; /* of light inside, for each unit of length */
    float gloss;     /* shininess; of standard: roughness */
    float reflectivity;
    float transmission; /* part of the light that goes through */
    float ior;
    int model;
    bool opaque_cut; /* the cut of something transmissive, which light does not go through */
    uint id;         /* 1 + pre-order index of the leaf */
};

/* What is left of white light that goes through the outside, into it. The colour of a standard
 * surface dyes it, as glTF's does; a phong surface that hides little has little of its colour. */
vec3 transmission_tint(Surface s)
{
    return s.model == MODEL_STANDARD ? s.diffuse : vec3(1.0);
}

/* How a point of it is seen. */
struct Shading {
    vec3 world_position;
    vec3 object_position; /* in the space of the shape */
    vec3 world_normal;
    vec3 ray_direction;
    float ray_distance;
};
