/* SPDX-License-Identifier: MIT */
/* A ray, and how wide the pixel is that it is for. */

struct Ray {
    vec3 origin;
    vec3 direction; /* of length 1 */
    float way;      /* from the eye to the origin */
    bool inside;    /* of something that light goes through */
};

/* A ray that is to be followed later. */
struct Waiting {
    vec4 from;   /* origin, way */
    vec4 along;  /* direction, 1 where it is inside */
    vec4 weight; /* what its light counts; w: how often it was mirrored or broken */
    vec4 medium; /* rgb: absorption where it is */
};

Ray ray_of(Waiting w)
{
    return Ray(w.from.xyz, w.along.xyz, w.from.w, w.along.w > 0.5);
}

/* Radius of a pixel's footprint at distance t along the ray. */
float footprint(Ray ray, float t)
{
    return forward.w * (eye.w > 0.5 ? 1.0 : ray.way + t);
}
