/* SPDX-License-Identifier: MIT */
/* What shadow.glsl, shade.glsl and paths.glsl keep between them, where one program does all. */

vec3 seen_lights[LIGHTS_MAX];
float seen_open;
#define OPEN(value) seen_open = value
#define SEEN(i, value) seen_lights[i] = (value).rgb
#define SEEN_AT(here, i) seen_lights[i]

Waiting stacked[STACK_DEPTH];
int stacked_count;
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
