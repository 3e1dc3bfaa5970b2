/* SPDX-License-Identifier: MIT */
#include "equation_rows.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/json_text.h"

const char *const equation_rows_letters[] = {"a", "b", "c", "d", NULL};
const double equation_rows_values[] = {0.75, 1, 1, 1}; /* floats hold them */

const struct equation_row equation_rows[] = {
    {EQUATION_SIN, "sin(4x) + sin(5y) * sin(3z) = 0.2"},
    {EQUATION_COS, "cos(3x)*z + cos(4y + z) = a"},
    /* These share ranges, whichever comes first. */
    {EQUATION_FUNCTIONS, "sin(3x)*y + cos(3x)*z = 0.3*sin(4y)"},
    {EQUATION_FUNCTIONS, "cos(2x - y)*z + sin(2x - y)*cos(5z) = 0.2 + 0.1*sin(5z)"},
    {EQUATION_TAN, "tan(x)*y = z + tan(0.3z)"},
    {EQUATION_ASIN, "asin(x/2) + asin(y/3) = z"},
    {EQUATION_ACOS, "acos(x*y/3) = z + 1"},
    {EQUATION_ATAN, "atan(3x) + atan(2y*z) = 0.3"},
    {EQUATION_SINH, "sinh(x)*z = sinh(y) - 0.2"},
    {EQUATION_COSH, "cosh(x) + cosh(2y - z) = 3"},
    {EQUATION_TANH, "tanh(3x)*y + tanh(z) = 0.1"},
    {EQUATION_EXP, "exp(-4*(x^2 + y^2)) + exp(-4*((x - 1)^2 + z^2)) > 0.4"},
    {EQUATION_LOG, "log(x^2 + y^2 + 0.1) = z"},
    {EQUATION_SQRT, "(sqrt(x^2 + z^2) - 1)^2 + y^2 = 0.16"},
    {EQUATION_CBRT, "cbrt(x + 2) + cbrt(y*z) = 1.5"},
    {EQUATION_ABS, "|x|^3 + |y - z| = 0.8"},
    {EQUATION_SIGN, "sign(x - 0.3)*y + 2z = 0.1 + sign(y)"},
    {EQUATION_FLOOR, "floor(2x)*0.4 + y = z + fract(1.5y)"},
    {EQUATION_CEIL, "ceil(x + y)*z = mod(y, 0.7)"},
    {EQUATION_ATAN2, "atan2(y, x) + z = 0.4*atan2(z + 1, y - 2)"},
    {EQUATION_FUNCTIONS, "cheb(8, x) + cheb(6, y) + cheb(5, z) = 0"},
    {EQUATION_FUNCTIONS, "smoothstep(-1, 1, x) + step(0.2, y) = z"},
    {EQUATION_MIN, "min(x^2 + y^2, y^2 + z^2) = 0.2"},
    {EQUATION_MAX, "max(x^2 + y, z^2 - x*y) < 0.5"},
    {EQUATION_FUNCTIONS, "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4 = 0"},
    {EQUATION_FUNCTIONS, "(x^2 + 9/4*z^2 + y^2 - 1)^3 - x^2*y^3 - 9/80*z^2*y^3 = 0"},
    {EQUATION_FUNCTIONS, "x^2 = y^2*z"},
    {EQUATION_FUNCTIONS, "y/(x^2 + 1) = z^3 - a*x"},
    {EQUATION_FUNCTIONS, "(x^2 + 1)^-2 + y*z = (2 + x)^a"},
    {EQUATION_FUNCTIONS, "2^x - y^5*z + (y^2 + 1)^x = 1.5"},
    {EQUATION_FUNCTIONS, "1/(x^2 + 0.2) + 1/(y^2 + 0.3) > 3 - z/(2 + y)"},
    {EQUATION_FUNCTIONS, "x^18 + y^17*z - z^16 + x = 0.3"},
    /* Most of these points are outside of a domain. */
    {EQUATION_FUNCTIONS, "asin(2z) - log(x) = y"},
    {EQUATION_FUNCTIONS, "acos(3x) - sqrt(y) < z^a + 0.5"},
};
const size_t equation_rows_count = sizeof equation_rows / sizeof equation_rows[0];

struct field *equation_rows_field_in(const char *const around[2], const char *text,
                                     const char *more)
{
    struct error err = {0};
    char json[1024];

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','root':%s{'type':'implicit','params':{"
             "'equation':'%s','a':0.75%s}}%s}",
             around[0], text, more, around[1]);
    struct scene *scene = json_text_valid_scene(json);
    struct field *field = field_compile(scene, &err);
    if (!field) {
        fail_msg("%s: %d: %s", text, err.column, err.message);
    }
    scene_destroy(scene);
    return field;
}

struct field *equation_rows_field(const char *text, const char *more)
{
    return equation_rows_field_in((const char *const[]){"", ""}, text, more);
}

struct equation *equation_rows_read(const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_rows_letters, &errors);

    assert_non_null(equation);
    return equation;
}

void equation_rows_point(struct random *random, double half, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)random_between(random, -half, half);
    }
}

int equation_rows_cases(int usual)
{
    const char *asked = getenv("EQUATION_CASES");

    return asked ? atoi(asked) : usual;
}
