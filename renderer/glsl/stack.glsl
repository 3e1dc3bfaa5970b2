/* SPDX-License-Identifier: MIT */
/* The rays of samples, where passes hand them on: the one that each is at lies in textures, those
 * that wait in a stack. */

#include "list.glsl"
#include "ray.glsl"

layout(rgba32f, binding = IMAGE_RAY_FROM) writeonly uniform image2D out_ray_from;
layout(rgba32f, binding = IMAGE_RAY_ALONG) writeonly uniform image2D out_ray_along;
layout(rgba32f, binding = IMAGE_WEIGHT) uniform image2D weights; /* as Waiting.weight */
layout(rgba16f, binding = IMAGE_MEDIUM) uniform image2D media;   /* absorption where the ray is */

layout(std430, binding = BINDING_STACK) buffer Stack {
    uint rays;  /* started since the counter was made */
    uint width; /* of the tile */
    uint unused[2];
    Waiting waiting[]; /* STACK_DEPTH for each sample; medium.w of the first: how many wait */
};

int stack_base(ivec2 here)
{
    return (here.y * int(width) + here.x) * STACK_DEPTH;
}

int stack_count(ivec2 here)
{
    return int(waiting[stack_base(here)].medium.w);
}

void stack_set_count(ivec2 here, int count)
{
    waiting[stack_base(here)].medium.w = float(count);
}

void stack_put(ivec2 here, int i, Waiting ray)
{
    int at = stack_base(here) + i;
    waiting[at].from = ray.from;
    waiting[at].along = ray.along;
    waiting[at].weight = ray.weight;
    waiting[at].medium.rgb = ray.medium.rgb; /* w may be the count */
}

Waiting stack_get(ivec2 here, int i)
{
    return waiting[stack_base(here) + i];
}

/* The sample goes on with this ray. */
void ray_go(ivec2 here, Waiting ray)
{
    imageStore(out_ray_from, here, ray.from);
    imageStore(out_ray_along, here, ray.along);
    imageStore(weights, here, ray.weight);
    imageStore(media, here, vec4(ray.medium.rgb, 0.0));
    list_add(here);
    atomicAdd(rays, 1u);
}
