/* SPDX-License-Identifier: MIT */
/* Light thrown back: surfaces give no light that they do not get, white ones lose none, and a ray
 * may go either way. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "renderer/glsl/interface.h"
#include "tests/support/formula.h"
#include "tests/support/random_scene.h"

/* A surface around +Z. c: diffuse, specular, gloss, model. */
#define SURFACE                                                                                    \
    "#include \"brdf.glsl\"\n"                                                                     \
    "Surface made(vec4 c)\n{\n"                                                                    \
    "    Surface s;\n"                                                                             \
    "    s.ambient = vec3(1.0);\n"                                                                 \
    "    s.diffuse = vec3(c.x);\n"                                                                 \
    "    s.specular = vec3(c.y);\n"                                                                \
    "    s.emission = vec3(0.0);\n"                                                                \
    "    s.absorption = vec3(0.0);\n"                                                              \
    "    s.gloss = c.z;\n"                                                                         \
    "    s.reflectivity = 0.0;\n"                                                                  \
    "    s.transmission = 0.0;\n"                                                                  \
    "    s.ior = 1.5;\n"                                                                           \
    "    s.model = int(c.w);\n"                                                                    \
    "    s.id = 1u;\n"                                                                             \
    "    return s;\n}\n"

/* A direction at least 6 degrees above the surface. */
static void set_above(struct random *random, float out[4])
{
    const double z = random_between(random, 0.1, 1), turn = random_between(random, 0, 6.2831853);

    out[0] = (float)(sqrt(1 - z * z) * cos(turn));
    out[1] = (float)(sqrt(1 - z * z) * sin(turn));
    out[2] = (float)z;
    out[3] = 0;
}

static void light_may_go_either_way(void **state)
{
    enum { ROWS = 3000 };
    static struct formula_row rows[ROWS];
    struct random random = {71};

    (void)state;
    for (int i = 0; i < ROWS; i++) {
        const int model = i % 3;
        const double gloss = model == MODEL_STANDARD ? random_between(&random, 0, 1)
                                                     : random_between(&random, 1, 200);
        rows[i] = (struct formula_row){.c = {(float)random_between(&random, 0, 1),
                                             (float)random_between(&random, 0, 1), (float)gloss,
                                             (float)model}};
        set_above(&random, rows[i].a);
        set_above(&random, rows[i].b);
    }
    formula_run(SURFACE
                "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
                "    vec3 n = vec3(0.0, 0.0, 1.0);\n"
                "    Surface s = made(c);\n"
                "    return vec4(brdf_times_cosine(s, n, a.xyz, b.xyz).x / b.z,\n"
                "                brdf_times_cosine(s, n, b.xyz, a.xyz).x / a.z, 0.0, 0.0);\n}\n",
                rows, ROWS);
    for (int i = 0; i < ROWS; i++) {
        const double there = rows[i].out[0], back = rows[i].out[1];
        if (!(there >= 0 && fabs(there - back) <= 1e-3 * there + 1e-6)) {
            fail_msg("model %g, gloss %g: %g one way, %g the other", (double)rows[i].c[3],
                     (double)rows[i].c[2], there, back);
        }
    }
}

/* All that goes to `view` of light 1 from everywhere: half of the directions are chosen by the
 * cosine, half by the facets that would mirror them, together as Veach says (balance heuristic). */
static const char ask_all[] =
    SURFACE "#define SIDE 96\n"
            "vec3 n = vec3(0.0, 0.0, 1.0);\n"
            "float chance_facet(vec3 view, vec3 towards, float a2)\n{\n"
            "    vec3 h = normalize(view + towards);\n"
            "    float d = 1.0 - h.z * h.z * (1.0 - a2);\n"
            "    return a2 * h.z / (PI * d * d * 4.0 * dot(view, h));\n}\n"
            "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
            "    Surface s = made(c);\n"
            "    vec3 view = vec3(sqrt(1.0 - a.x * a.x), 0.0, a.x);\n"
            "    float gloss = roughness(s), a2 = max(pow(gloss, 4.0), 1e-5), sum = 0.0;\n"
            "    for (int i = 0; i < SIDE * SIDE; i++) {\n"
            "        vec2 u = (vec2(i % SIDE, i / SIDE) + 0.5) / float(SIDE);\n"
            "        vec2 turn = vec2(cos(2.0 * PI * u.y), sin(2.0 * PI * u.y));\n"
            "        vec3 matt = vec3(sqrt(u.x) * turn, sqrt(1.0 - u.x));\n"
            "        float z2 = (1.0 - u.x) / (1.0 + (a2 - 1.0) * u.x);\n"
            "        vec3 shiny = reflect(-view, vec3(sqrt(1.0 - z2) * turn, sqrt(z2)));\n"
            "        for (int j = 0; j < 2; j++) {\n"
            "            vec3 l = j == 0 ? matt : shiny;\n"
            "            float chance = l.z / PI + chance_facet(view, l, a2);\n"
            "            sum += l.z > 0.0 ? brdf_times_cosine(s, n, view, l).x / chance : 0.0;\n"
            "        }\n"
            "    }\n"
            "    vec3 around = environment_light(s, n, view, 1.0, vec3(1.0), vec3(1.0), 0.0);\n"
            "    vec3 rest = environment_light(s, n, view, 1.0, vec3(1.0), vec3(1.0), 1.0);\n"
            "    return vec4(sum / float(SIDE * SIDE), around.x, rest.x,\n"
            "                specular_reflectance(s, n, view).x);\n}\n";

enum { ROUGH = 9, COSINES = 10 };

/* For standard surfaces of roughness 0.2 .. 1, seen from head-on to 6 degrees above them. */
static void ask_standard(struct formula_row rows[ROUGH * COSINES], double diffuse, double specular)
{
    for (int i = 0; i < ROUGH * COSINES; i++) {
        const double rough = 0.2 + 0.1 * (i / COSINES), cosine = 0.1 + 0.1 * (i % COSINES);
        rows[i] = (struct formula_row){
            .a = {(float)fmin(cosine, 0.9999)},
            .c = {(float)diffuse, (float)specular, (float)rough, MODEL_STANDARD}};
    }
    formula_run(ask_all, rows, (size_t)ROUGH * COSINES);
}

static void white_standard_loses_nothing(void **state)
{
    static const double speculars[] = {0, 0.005, 0.04, 1};
    struct formula_row rows[ROUGH * COSINES];
    double least = 1, most = 1;

    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        ask_standard(rows, speculars[kind] < 1 ? 1 : 0, speculars[kind]);
        for (int i = 0; i < ROUGH * COSINES; i++) {
            const struct formula_row *r = &rows[i];
            /* In surroundings of 1, and of lights everywhere. */
            if (!(fabs(r->out[1] - 1) <= 0.002 && fabs(r->out[0] - 1) <= 0.02)) {
                fail_msg("specular %g, roughness %g, cosine %g: %g around, %g of lights",
                         (double)r->c[1], (double)r->c[2], (double)r->a[0], (double)r->out[1],
                         (double)r->out[0]);
            }
            least = fmin(least, r->out[0]);
            most = fmax(most, r->out[0]);
        }
    }
    print_message("white, of lights everywhere: %.4f .. %.4f\n", least, most);
}

static void nothing_gains_light(void **state)
{
    struct formula_row rows[ROUGH * COSINES];

    (void)state;
    for (int i = 0; i < 9; i++) {
        ask_standard(rows, 0.5 * (i % 3), 0.02 + 0.49 * (i / 3));
        for (int j = 0; j < ROUGH * COSINES; j++) {
            const struct formula_row *r = &rows[j];
            if (!(r->out[0] <= 1.02 && r->out[1] <= 1.002 && fabs(r->out[0] - r->out[1]) <= 0.03)) {
                fail_msg(
                    "diffuse %g, specular %g, roughness %g, cosine %g: %g of lights, %g around",
                    (double)r->c[0], (double)r->c[1], (double)r->c[2], (double)r->a[0],
                    (double)r->out[0], (double)r->out[1]);
            }
        }
    }
}

/* Not even at a grazing angle. */
static void what_mirrors_nothing_head_on_mirrors_nothing(void **state)
{
    struct formula_row rows[ROUGH * COSINES];

    (void)state;
    ask_standard(rows, 1, 0);
    for (int i = 0; i < ROUGH * COSINES; i++) {
        assert_true(rows[i].out[3] == 0);
    }
}

/* What rays bring instead of the environment's image is just what is left out for them. */
static void rays_bring_the_mirror_image(void **state)
{
    struct formula_row rows[ROUGH * COSINES];

    (void)state;
    ask_standard(rows, 0.7, 0.3);
    for (int i = 0; i < ROUGH * COSINES; i++) {
        assert_true(fabs(rows[i].out[1] - rows[i].out[2] - rows[i].out[3]) < 1e-5);
        assert_true(rows[i].out[3] > 0.05);
    }
}

/* Phong's and Blinn's have no energy to conserve, but their diffuse part does. */
static void matt_phong_is_lambert(void **state)
{
    struct formula_row rows[2 * COSINES];

    (void)state;
    for (int i = 0; i < 2 * COSINES; i++) {
        rows[i] = (struct formula_row){.a = {(float)(0.1 + 0.0899 * (i % COSINES))},
                                       .c = {0.8f, 0, 32, i < COSINES ? MODEL_PHONG : MODEL_BLINN}};
    }
    formula_run(ask_all, rows, 2 * COSINES);
    for (int i = 0; i < 2 * COSINES; i++) {
        assert_true(fabs(rows[i].out[0] - 0.8) < 0.005);
        assert_true(fabs(rows[i].out[1] - 0.8) < 0.002);
        assert_true(rows[i].out[3] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_may_go_either_way),
        cmocka_unit_test(white_standard_loses_nothing),
        cmocka_unit_test(nothing_gains_light),
        cmocka_unit_test(rays_bring_the_mirror_image),
        cmocka_unit_test(what_mirrors_nothing_head_on_mirrors_nothing),
        cmocka_unit_test(matt_phong_is_lambert),
    };

    return cmocka_run_group_tests(tests, formula_start, formula_end);
}
