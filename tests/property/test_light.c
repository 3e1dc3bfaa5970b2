/* SPDX-License-Identifier: MIT */
/* Light on its way: how much of a lamp's arrives, where it goes between two media. Against the
 * formulas of physics, in double precision. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/kinds.h"
#include "tests/support/formula.h"

enum { ANGLES = 100 };

static void assert_near(double got, double want, double room, const char *what, double where)
{
    if (!(fabs(got - want) <= room)) {
        fail_msg("%s at %g: %.7g instead of %.7g", what, where, got, want);
    }
}

/* --- two media --- */

/* Of incidence, in the middles of equal parts of a quarter turn. */
static double angle_at(int i)
{
    return (i + 0.5) / ANGLES * 1.57079632679;
}

static void bends_as_snell_says(void **state)
{
    static const double ratios[] = {1 / 1.5, 1.5, 1 / 1.33, 2.42};
    struct formula_row rows[ANGLES];

    (void)state;
    for (size_t r = 0; r < sizeof ratios / sizeof ratios[0]; r++) {
        for (int i = 0; i < ANGLES; i++) {
            const double angle = angle_at(i);
            rows[i] = (struct formula_row){.a = {(float)sin(angle), -(float)cos(angle), 0, 0},
                                           .b = {(float)ratios[r]}};
        }
        formula_run("#include \"optics.glsl\"\n"
                    "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n    vec3 bent;\n"
                    "    bool goes = refract_ray(a.xyz, vec3(0.0, 1.0, 0.0), b.x, bent);\n"
                    "    return vec4(bent, goes ? 1.0 : 0.0);\n}\n",
                    rows, ANGLES);
        for (int i = 0; i < ANGLES; i++) {
            const double sine = ratios[r] * sin(angle_at(i));
            assert_near(rows[i].out[3], sine < 1, 0, "whether light goes through", angle_at(i));
            if (sine < 1) {
                assert_near(rows[i].out[0], sine, 2e-6, "sine", angle_at(i));
                assert_near(rows[i].out[1], -sqrt(1 - sine * sine), 2e-4, "cosine", angle_at(i));
                assert_near(rows[i].out[2], 0, 1e-6, "aside", angle_at(i));
            }
        }
    }
}

/* Fresnel's equations, for light without polarization. */
static double fresnel(double ratio, double angle)
{
    const double sine = ratio * sin(angle), ci = cos(angle);

    if (sine >= 1) {
        return 1;
    }
    const double ct = sqrt(1 - sine * sine);
    const double across = (ratio * ci - ct) / (ratio * ci + ct);
    const double along = (ci - ratio * ct) / (ci + ratio * ct);
    return 0.5 * (across * across + along * along);
}

/* Schlick's formula is exact to the eye, not to the digit: within 0.04 for glass. */
static void mirrors_as_fresnel_says(void **state)
{
    const double ior = 1.5, f0 = pow((ior - 1) / (ior + 1), 2);
    struct formula_row rows[ANGLES];

    (void)state;
    for (int i = 0; i < ANGLES; i++) {
        rows[i] = (struct formula_row){
            .a = {(float)cos(angle_at(i)), (float)ior, (float)f0, (float)(1 - f0)}};
    }
    formula_run("#include \"optics.glsl\"\n"
                "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
                "    vec3 f = fresnel(vec3(a.z, a.w, 1.0), a.x);\n"
                "    return vec4(f.xy, fresnel_dielectric(a.y, a.x, false),\n"
                "                fresnel_dielectric(a.y, a.x, true));\n}\n",
                rows, ANGLES);
    for (int i = 0; i < ANGLES; i++) {
        const double angle = angle_at(i), x5 = pow(1 - cos(angle), 5);
        assert_near(rows[i].out[0], f0 + (1 - f0) * x5, 2e-6, "Schlick", angle);
        assert_near(rows[i].out[1], 1 - f0 + f0 * x5, 2e-6, "Schlick of metal", angle);
        assert_near(rows[i].out[2], fresnel(1 / ior, angle), 0.04, "into glass", angle);
        if (ior * sin(angle) >= 1) {
            assert_near(rows[i].out[3], 1, 1e-6, "out of glass", angle);
        } else {
            assert_near(rows[i].out[3], fresnel(ior, angle), 0.04, "out of glass", angle);
        }
    }
}

/* --- lamps --- */

/* A lamp at the origin that shines down. b: type, radius, range; c: cosines of rim and fade. */
static const char ask_lamp[] =
    "#include \"lights.glsl\"\n"
    "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
    "    Light light;\n"
    "    light.position = vec3(0.0);\n    light.kind = int(b.x);\n"
    "    light.color = vec3(1.0, 2.0, 3.0);\n"
    "    light.radius = b.y;\n    light.range = b.z;\n"
    "    light.axis = vec3(0.0, -1.0, 0.0);\n"
    "    light.rim_cosine = c.x;\n    light.fade_cosine = c.y;\n"
    "    Incoming i = incoming(light, a.xyz);\n"
    "    return vec4(i.color.r, i.color.b, dot(i.direction, a.xyz), i.reach);\n}\n";

static void points_fade_by_the_square(void **state)
{
    const double radius = 0.4, range = 6;
    struct formula_row rows[2 * ANGLES];

    (void)state;
    for (int i = 0; i < 2 * ANGLES; i++) {
        const float r = 0.1f + 0.08f * (float)(i / 2);
        rows[i] = (struct formula_row){.a = {0.6f * r, 0, -0.8f * r, 0},
                                       .b = {LIGHT_POINT, (float)radius, i % 2 ? (float)range : 0}};
    }
    formula_run(ask_lamp, rows, 2 * ANGLES);
    for (int i = 0; i < 2 * ANGLES; i++) {
        const double r = 0.1 + 0.08 * (i / 2);
        const double square = r < radius ? 1 / (radius * radius) : 1 / (r * r);
        const double rest = fmax(1 - pow(r / range, 4), 0);
        const double want = square * (i % 2 ? rest * rest : 1);
        assert_near(rows[i].out[0], want, 1e-4 * want + 1e-7, "light", r);
        assert_near(rows[i].out[1], 3 * want, 3e-4 * want + 1e-7, "blue light", r);
        assert_near(rows[i].out[2], -r, 1e-5, "towards the lamp", r);
        assert_near(rows[i].out[3], r, 1e-5, "distance", r);
    }
}

static void spots_end_at_their_rim(void **state)
{
    static const double softnesses[] = {0, 0.3, 1};
    const double angle = 0.6;
    struct formula_row rows[ANGLES];

    (void)state;
    for (size_t s = 0; s < 3; s++) {
        const double rim = cos(angle), fade = cos(angle * (1 - softnesses[s]));
        for (int i = 0; i < ANGLES; i++) {
            const double off = angle_at(i);
            rows[i] = (struct formula_row){.a = {(float)(2 * sin(off)), -(float)(2 * cos(off)), 0},
                                           .b = {LIGHT_SPOT, 0.1f, 0},
                                           .c = {(float)rim, (float)fade}};
        }
        formula_run(ask_lamp, rows, ANGLES);
        for (int i = 0; i < ANGLES; i++) {
            const double off = angle_at(i);
            double x = softnesses[s] > 0 ? (cos(off) - rim) / (fade - rim) : off < angle;
            x = fmin(fmax(x, 0), 1);
            assert_near(rows[i].out[0], 0.25 * x * x * (3 - 2 * x), 1e-4, "light of a spot", off);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bends_as_snell_says),
        cmocka_unit_test(mirrors_as_fresnel_says),
        cmocka_unit_test(points_fade_by_the_square),
        cmocka_unit_test(spots_end_at_their_rim),
    };

    return cmocka_run_group_tests(tests, formula_start, formula_end);
}
