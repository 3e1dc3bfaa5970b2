/* SPDX-License-Identifier: MIT */
/* What shadow.glsl, shade.glsl and paths.glsl keep between them, where one program does all. */

#include "ray.glsl"

vec3 seen_lights[LIMIT_LIGHTS];
float seen_open;

void store_openness(float open)
{
    seen_open = open;
}

void store_visibility(int light, float seen, float open)
{
    seen_lights[light] = vec3(seen);
}

void dim_visibility(int light, float part)
{
    seen_lights[light] *= part;
}

vec3 visibility_of(ivec2 here, int light)
{
    return seen_lights[light];
}

Waiting stacked[STACK_DEPTH];
int stacked_count = 0;
Waiting next_ray;
bool has_next;

int stack_count(ivec2 here)
{
    return stacked_count;
}

void stack_set_count(ivec2 here, int count)
{
    stacked_count = count;
}

void stack_put(ivec2 here, int i, Waiting ray)
{
    stacked[i] = ray;
}

Waiting stack_get(ivec2 here, int i)
{
    return stacked[i];
}

void ray_go(ivec2 here, Waiting ray)
{
    next_ray = ray;
    has_next = true;
}
