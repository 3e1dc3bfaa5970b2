/* SPDX-License-Identifier: MIT */
/* What is left of a shader's text: that which main() needs, and no more. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/glsl/reach.h"

static void check(const char *text, const char *expected)
{
    char *copy = memory_text(text), *left = NULL;
    size_t length;
    FILE *out = open_memstream(&left, &length);

    glsl_write_reached(out, copy);
    fclose(out);
    assert_string_equal(left, expected);
    free(left);
    free(copy);
}

static void used_functions_are_kept(void **state)
{
    (void)state;
    check("float unused(float x) { return x; }\n"
          "float inner(float x) { return x; }\n"
          "float used(float x) { return inner(x); }\n"
          "void main() { used(1.0); }\n",
          "float inner(float x) { return x; }\n"
          "float used(float x) { return inner(x); }\n"
          "void main() { used(1.0); }\n");
}

/* All functions of a name are one item to its callers. */
static void overloads_are_kept_together(void **state)
{
    (void)state;
    check(
        "float f(float x) { return x; }\nvec2 f(vec2 x) { return x; }\nvoid main() { f(1.0); }\n",
        "float f(float x) { return x; }\nvec2 f(vec2 x) { return x; }\nvoid main() { f(1.0); }\n");
}

static void used_declarations_are_kept(void **state)
{
    (void)state;
    check("struct Unused { float a; };\n"
          "struct Used { float a; };\n"
          "const float k[] = float[](1.0, 2.0), other = 1.0;\n"
          "uniform vec2 unused;\n"
          "Used u = Used(1.0);\n"
          "void main() { u.a = 2.0; }\n",
          "struct Used { float a; };\n"
          "const float k[] = float[](1.0, 2.0), other = 1.0;\n"
          "Used u = Used(1.0);\n"
          "void main() { u.a = 2.0; }\n");
}

static void used_macros_are_kept(void **state)
{
    (void)state;
    check("#define UNUSED 1\n"
          "#define TWICE(x) \\\n"
          "    (2.0 * (x))\n"
          "#define MAKE(T) T made(T x) { return x; }\n"
          "MAKE(float)\n"
          "void main() { made(TWICE(1.0)); }\n",
          "#define TWICE(x) \\\n"
          "    (2.0 * (x))\n"
          "#define MAKE(T) T made(T x) { return x; }\n"
          "MAKE(float)\n"
          "void main() { made(TWICE(1.0)); }\n");
}

static void conditions_are_kept(void **state)
{
    (void)state;
    check("#define WANTED\n"
          "#ifdef WANTED\n"
          "#ifndef WANTED\n"
          "float f() { return 1.0; }\n"
          "#else\n"
          "float f() { return 2.0; }\n"
          "#endif\n"
          "#else\n"
          "float f() { return 3.0; }\n"
          "#ifdef WANTED\n"
          "float f() { return 4.0; }\n"
          "#endif\n"
          "#endif\n"
          "void main() { f(); }\n",
          "float f() { return 2.0; }\n"
          "void main() { f(); }\n");
}

/* A comment is its item's. Words in comments reach nothing. */
static void comments_follow_their_item(void **state)
{
    (void)state;
    check("/* SPDX-License-Identifier: MIT */\n"
          "/* Of what is not there. */\n"
          "float unused() { return 1.0; }\n"
          "#line 7 3\n\n\n"
          "/* Of main(), not of unused(). */\n"
          "void main() { /* unused() */ } /* end */\n",
          "\n/* Of main(), not of unused(). */\n"
          "void main() { /* unused() */ } /* end */\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(used_functions_are_kept),    cmocka_unit_test(overloads_are_kept_together),
        cmocka_unit_test(used_declarations_are_kept), cmocka_unit_test(used_macros_are_kept),
        cmocka_unit_test(conditions_are_kept),        cmocka_unit_test(comments_follow_their_item),
    };

    return cmocka_run_group_tests_name("reach", tests, NULL, NULL);
}
