/* SPDX-License-Identifier: MIT */
/* The rays of samples, where passes hand them on: the one that each is at lies in textures, those
 * that wait in a stack. */

#include "list.glsl"
#include "ray.glsl"

layout(rgba32f, binding = IMAGE_RAY_ORIGIN) writeonly uniform image2D out_ray_origin;
layout(rgba32f, binding = IMAGE_RAY_DIRECTION) writeonly uniform image2D out_ray_direction;
layout(rgba32f, binding = IMAGE_THROUGHPUT) uniform image2D throughputs; /* as in QueuedRay */
layout(rgba16f, binding = IMAGE_ABSORPTION) uniform image2D absorptions; /* where the ray is */

layout(std430, binding = BINDING_STACK) buffer Stack {
    uint rays;  /* started since the counter was made */
    uint width; /* of the tile */
    uint unused[2];
    QueuedRay queued[]; /* STACK_DEPTH for each sample; absorption.w of the first: how many wait */
};

int stack_base(ivec2 here)
{
    return (here.y * int(width) + here.x) * STACK_DEPTH;
}

int stack_count(ivec2 here)
{
    return int(queued[stack_base(here)].absorption.w);
}

void stack_set_count(ivec2 here, int count)
{
    queued[stack_base(here)].absorption.w = float(count);
}

void stack_put(ivec2 here, int i, QueuedRay ray)
{
    int at = stack_base(here) + i;
    queued[at].origin = ray.origin;
    queued[at].direction = ray.direction;
    queued[at].throughput = ray.throughput;
    queued[at].absorption.rgb = ray.absorption.rgb; /* w may be the count */
}

QueuedRay stack_get(ivec2 here, int i)
{
    return queued[stack_base(here) + i];
}

/* The sample goes on with this ray. */
void set_ray(ivec2 here, QueuedRay ray)
{
    imageStore(out_ray_origin, here, ray.origin);
    imageStore(out_ray_direction, here, ray.direction);
    imageStore(throughputs, here, ray.throughput);
    imageStore(absorptions, here, vec4(ray.absorption.rgb, 0.0));
    list_add(here);
    atomicAdd(rays, 1u);
}
