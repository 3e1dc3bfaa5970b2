/* SPDX-License-Identifier: MIT */
/* What shadow.glsl, shade.glsl and secondary_rays.glsl keep between them, where one program does
 * all. */

#include "ray.glsl"

vec3 stored_visibility[LIMIT_LIGHTS];
float stored_ambient_visibility;

void store_ambient_visibility(float ambient_visibility)
{
    stored_ambient_visibility = ambient_visibility;
}

void store_visibility(int light, float visibility, float ambient_visibility)
{
    stored_visibility[light] = vec3(visibility);
}

void dim_visibility(int light, float part)
{
    stored_visibility[light] *= part;
}

vec3 visibility_of(ivec2 here, int light)
{
    return stored_visibility[light];
}

QueuedRay queued[STACK_DEPTH];
int queued_count = 0;
QueuedRay next_ray;
bool has_next;

int stack_count(ivec2 here)
{
    return queued_count;
}

void stack_set_count(ivec2 here, int count)
{
    queued_count = count;
}

void stack_put(ivec2 here, int i, QueuedRay ray)
{
    queued[i] = ray;
}

QueuedRay stack_get(ivec2 here, int i)
{
    return queued[i];
}

void set_ray(ivec2 here, QueuedRay ray)
{
    next_ray = ray;
    has_next = true;
}
