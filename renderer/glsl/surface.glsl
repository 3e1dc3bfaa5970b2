/* SPDX-License-Identifier: MIT */
/* What a point of a surface is made of: filled in by surface() of the field's text. */

struct Surface {
    vec3 ambient; /* part of the environment's light taken up */
    vec3 diffuse;
    vec3 specular;
    vec3 emission;
    float shininess;
    uint id; /* 1 + pre-order index of the leaf */
};

/* How a point of it is seen. */
struct Shading {
    vec3 world_position;
    vec3 object_position; /* in the space of the shape */
    vec3 world_normal;
    vec3 ray_direction;
    float ray_distance;
};
