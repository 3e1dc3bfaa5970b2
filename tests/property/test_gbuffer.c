/* SPDX-License-Identifier: MIT */
/* Surfaces come out of the G-buffer as they went in, within what glsl/gbuffer.glsl says. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/gl/egl.h"
#include "renderer/gl/gl.h"
#include "renderer/gl/pass.h"
#include "tests/support/random_scene.h"

enum { SURFACES = 4096, GROUP = 64 };

/* In the order of the shader's text below. */
struct surface {
    float diffuse[3], gloss;
    float specular[3], model;
    float emission[3], ior;
    float ambient[3], transmission;
    float absorption[3], reflectivity;
    float id[3], unused; /* the bytes of it */
};

static const char body[] =
    "#include \"gbuffer.glsl\"\n"
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) buffer Surfaces { vec4 parts[]; };\n"
    "void main()\n{\n"
    "uint i = 6u * gl_GlobalInvocationID.x;\n"
    "vec4 a = parts[i], b = parts[i + 1u], c = parts[i + 2u], d = parts[i + 3u],\n"
    "     e = parts[i + 4u], f = parts[i + 5u];\n"
    "Surface s;\n"
    "s.diffuse = a.rgb; s.gloss = a.w; s.specular = b.rgb; s.model = int(b.w);\n"
    "s.emission = c.rgb; s.ior = c.w; s.ambient = d.rgb; s.transmission = d.w;\n"
    "s.absorption = e.rgb; s.reflectivity = e.w;\n"
    "s.id = uint(f.x) | uint(f.y) << 8 | uint(f.z) << 16;\n"
    "uvec4 material0, material1;\n"
    "surface_pack(s, material0, material1);\n"
    "s = surface_unpack(material0, material1);\n"
    "parts[i] = vec4(s.diffuse, s.gloss);\n"
    "parts[i + 1u] = vec4(s.specular, s.model);\n"
    "parts[i + 2u] = vec4(s.emission, s.ior);\n"
    "parts[i + 3u] = vec4(s.ambient, s.transmission);\n"
    "parts[i + 4u] = vec4(s.absorption, s.reflectivity);\n"
    "parts[i + 5u].rgb = vec3(uvec3(s.id, s.id >> 8, s.id >> 16) & 255u);\n}\n";

/* Packs and unpacks all of them in place. */
static void round_trip(struct surface surfaces[SURFACES])
{
    const struct device_params params = {.index = -1};
    const struct glsl_file own[] = {{"trip.glsl", body}, {NULL, NULL}};
    struct pass pass;
    const GLsizeiptr bytes = SURFACES * sizeof *surfaces;
    struct error err = {0};
    struct egl egl;
    struct gl gl;
    GLuint buffer;

    assert_true(egl_init(&egl, &params, &err));
    assert_true(gl_load(&gl, &err));
    if (!pass_init(&pass, &gl, &(struct pass_source){true, NULL, "trip.glsl", own}, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    gl.GenBuffers(1, &buffer);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, bytes, surfaces, GL_STREAM_READ);
    gl.UseProgram(pass.program);
    gl.DispatchCompute(SURFACES / GROUP, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    memcpy(surfaces, gl.MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes, GL_MAP_READ_BIT),
           (size_t)bytes);
    gl.UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    gl.DeleteBuffers(1, &buffer);
    pass_finish(&pass, &gl);
    egl_finish(&egl);
}

/* A quarter of them 0 and a quarter `most`. */
static float random_part(struct random *random, double most)
{
    const size_t kind = random_below(random, 4);

    return kind == 0 ? 0 : kind == 1 ? (float)most : (float)random_between(random, 0, most);
}

/* As many small as great ones: below 1e-3 to 65000. */
static float random_light(struct random *random)
{
    return random_part(random, pow(10, random_between(random, -3, log10(65000))));
}

static struct surface random_surface(struct random *random)
{
    struct surface s = {.model = (float)random_below(random, 3),
                        .gloss = (float)random_between(random, 0, 2048),
                        .ior = (float)random_between(random, 1, 4),
                        .transmission = random_part(random, 1),
                        .reflectivity = random_part(random, 1)};

    for (int i = 0; i < 3; i++) {
        s.diffuse[i] = random_light(random);
        s.specular[i] = random_part(random, 1);
        s.ambient[i] = random_part(random, 1);
        s.emission[i] = random_light(random);
        s.absorption[i] = random_light(random);
        s.id[i] = (float)random_below(random, 256);
    }
    return s;
}

static void assert_within(const char *what, float got, float want, double room)
{
    if (!(fabs((double)got - (double)want) <= room)) {
        fail_msg("%s: %.9g is not %.9g within %g", what, (double)got, (double)want, room);
    }
}

/* Halves have eleven bits; below 6e-5 their steps no longer shrink. */
static double half_room(float want)
{
    return fmax(ldexp(fabs((double)want), -11), ldexp(1, -25));
}

static void compare(const struct surface *got, const struct surface *want)
{
    const double glow = fmax(want->emission[0], fmax(want->emission[1], want->emission[2]));
    const double loss = fmax(want->absorption[0], fmax(want->absorption[1], want->absorption[2]));

    for (int i = 0; i < 3; i++) {
        assert_within("diffuse", got->diffuse[i], want->diffuse[i], half_room(want->diffuse[i]));
        assert_within("specular", got->specular[i], want->specular[i], 0.5001 / 1023);
        assert_within("ambient", got->ambient[i], want->ambient[i], 0.5001 / 1023);
        assert_within("emission", got->emission[i], want->emission[i], glow / 500);
        assert_within("absorption", got->absorption[i], want->absorption[i], loss / 500);
        assert_within("id", got->id[i], want->id[i], 0);
    }
    assert_within("gloss", got->gloss, want->gloss, half_room(want->gloss));
    assert_within("model", got->model, want->model, 0);
    assert_within("ior", got->ior, want->ior, half_room(want->ior));
    assert_within("transmission", got->transmission, want->transmission, 0.5001 / 255);
    assert_within("reflectivity", got->reflectivity, want->reflectivity, 0.5001 / 255);
}

static void surfaces_come_out_as_they_went_in(void **state)
{
    (void)state;
    static struct surface before[SURFACES], after[SURFACES];
    struct random random = {11};

    for (int i = 0; i < SURFACES; i++) {
        after[i] = before[i] = random_surface(&random);
    }
    round_trip(after);
    for (int i = 0; i < SURFACES; i++) {
        compare(&after[i], &before[i]);
    }
}

/* What is too bright is as bright as can be told; each of the ends of parts is told exactly. */
static void the_ends_of_ranges_hold(void **state)
{
    (void)state;
    static struct surface surfaces[SURFACES];

    surfaces[0] = (struct surface){.diffuse = {1e9f, 1, 0},
                                   .emission = {1e30f, 0, 511.5f * 128},
                                   .specular = {1, 0, 2},
                                   .absorption = {1023.9f, 511.9f, 0}};
    surfaces[1] = (struct surface){.emission = {1e-9f, 0, 0}, .ior = 1, .transmission = 1};
    round_trip(surfaces);
    const struct surface *s = &surfaces[0];
    assert_true(s->diffuse[0] > 65000 && isfinite(s->diffuse[0]) && s->diffuse[1] == 1);
    assert_true(s->emission[0] == 65408 && s->emission[1] == 0 && s->emission[2] == 65408);
    assert_true(s->specular[0] == 1 && s->specular[1] == 0 && s->specular[2] == 1);
    assert_within("absorption", s->absorption[0], 1023.9f, 2);
    assert_within("absorption", s->absorption[1], 511.9f, 2);
    assert_true(surfaces[1].emission[0] < 1e-7f && surfaces[1].transmission == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_come_out_as_they_went_in),
        cmocka_unit_test(the_ends_of_ranges_hold),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
