/* SPDX-License-Identifier: MIT */
/* An equation as code, from its parts. */
#include "equation_code.h"

#include <math.h>

#include "equation_writer.h"

enum { TRIES = 4 }; /* of steps, for one bound */

/* --- which nodes, functions and powers are used --- */

static void mark_used(struct equation_writer *w)
{
    w->used[w->equation->left] = w->used[w->equation->right] = true;
    for (size_t i = w->equation->count; i-- > 0;) {
        const struct equation_node *node = &w->equation->nodes[i];
        for (int k = 0; w->used[i] && k < equation_arguments(node); k++) {
            w->used[node->args[k]] = true;
        }
    }
}

static bool is_called(const struct equation_writer *w, enum equation_op op, int which)
{
    for (size_t i = 0; i < w->equation->count; i++) {
        const struct equation_node *node = &w->equation->nodes[i];
        if (w->used[i] && node->op == op && (which < 0 || node->which == which)) {
            return true;
        }
    }
    return false;
}

/* --- functions --- */

static void write_functions(const struct equation_writer *w)
{
    fputs(equation_sizes, w->out);
    for (int i = 0; i < EQUATION_FUNCTIONS; i++) {
        const bool by_power =
            is_called(w, EQUATION_POWER, -1) && (i == EQUATION_EXP || i == EQUATION_LOG);
        if (by_power || is_called(w, EQUATION_CALL, i)) {
            fputs(equation_rules[i].range, w->out);
        }
    }
    fputs(equation_reciprocal.range, w->out);
}

/* --- the whole --- */

double equation_unsteady(double extent)
{
    return hypot(EQUATION_MARGIN, EQUATION_REACH) * extent;
}

static const char *extent_of(struct equation_form form)
{
    return form.ball ? "radius" : "(0.5 * length(size))";
}

static void write_nodes(const struct equation_writer *w, bool varying,
                        void (*write)(const struct equation_writer *, size_t))
{
    for (size_t i = 0; i < w->equation->count; i++) {
        if (w->used[i] && w->equation->nodes[i].varies == varying) {
            write(w, i);
        }
    }
}

/* The slopes of the axes, which are the same in each box. */
static void write_axis(const struct equation_writer *w, size_t index)
{
    if (w->equation->nodes[index].op == EQUATION_AXIS) {
        fprintf(w->out, "mat3 j%zu = mat3(g%zu.xyz, g%zu.xyz, vec3(0.0));\n", index, index, index);
    }
}

/* Up to what makes `most`, the greatest slope in the box of the half side `reach`. */
static void write_box(const struct equation_writer *w, uint16_t root, struct equation_form form,
                      const char *begin)
{
    fprintf(w->out,
            "float value = abs(g%d.w);\n"
            "float reach = min(value / max(length(g%d.xyz), 1e-18), %g * %s);\n%s",
            root, root, EQUATION_REACH, extent_of(form), begin);
    write_nodes(w, true, write_axis);
    fprintf(w->out, "for (int i = 0; i < %d; i++) {\nvec2 sides = vec2(-reach, reach);\n", TRIES);
    write_nodes(w, true, equation_write_jet);
    fprintf(w->out,
            "float most = max(length(max(abs(j%d[0]), abs(j%d[1]))), 1e-18);\n"
            "bool clear = j%d[2].x * j%d[2].y > 0.0, jumps = !clear && most > 1e17;\n",
            root, root, root, root);
}

/* Where the slope in a box tells less than that in a smaller one would, the box shrinks. Nothing
 * is in a box without a zero among its values. Close to a jump or a pole in every box, a ray goes
 * on by a little: it ends at the jump where the sign changes. */
static void write_solid(const struct equation_writer *w, uint16_t root, struct equation_form form)
{
    write_box(w, root, form, "float d = 0.0;\n");
    fprintf(w->out,
            "float free = clear ? reach : min(value / most, reach);\n"
            "d = max(d, jumps ? 0.0003 * reach : free);\n"
            "if (free > 0.4 * reach) {\nbreak;\n}\n"
            "reach = jumps ? 0.2 * reach : sqrt(max(free, 0.001 * reach) * reach);\n"
            "}\n"
            "return g%d.w < 0.0 ? -d : d;\n}\n",
            root);
}

/* A sheet is where |f| is at most half of the thickness times the slope in a small box (`grain`)
 * around the point. Let M be the slope in a box that is larger by the grain than a ball. Within
 * the ball |f| falls by at most M a unit of way, and the slope in small boxes is at most M: the
 * sheet is at least |f| / M less half of its thickness away, or the ball's radius. */
static void write_sheet(const struct equation_writer *w, uint16_t root, struct equation_form form)
{
    write_box(w, root, form,
              "float grain = thickness / 16.0, d = -0.5 * thickness;\n"
              "reach = max(reach, thickness);\n");
    fprintf(w->out,
            "bool last = reach <= grain;\n"
            "float free = min(value / most - 0.5 * thickness, last ? grain : reach - grain);\n"
            "d = max(d, last && clear && most > 1e17 ? grain : free);\n"
            "if (last || free > 0.4 * reach) {\nbreak;\n}\n"
            "float less = jumps ? 0.2 * reach : sqrt(max(free, 0.001 * reach) * reach);\n"
            "reach = i == %d || free < 2.0 * grain && reach < 2.0 * thickness ? grain\n"
            "                                                               : max(less, grain);\n"
            "}\n"
            "return d;\n}\n",
            TRIES - 2);
}

static void write_within(const struct equation_writer *w, uint16_t root, struct equation_form form)
{
    fputs("float within_clip(vec3 p)\n{\n", w->out);
    write_nodes(w, false, equation_write_scalar);
    write_nodes(w, true, equation_write_gradient);
    if (form.sheet) {
        write_sheet(w, root, form);
    } else {
        write_solid(w, root, form);
    }
}

static void write_sdf(const struct equation_writer *w, struct equation_form form)
{
    fprintf(w->out,
            "float sdf(vec3 p)\n{\n"
            "vec3 near = %s;\n"
            "float outside = distance(p, near);\n"
            "if (outside > %g * %s) {\nreturn outside;\n}\n"
            "float d = within_clip(near);\n",
            form.ball ? "p * min(1.0, radius / max(length(p), 1e-18))"
                      : "clamp(p, -0.5 * size, 0.5 * size)",
            EQUATION_MARGIN, extent_of(form));
    fprintf(w->out,
            "%s\n"
            "return outside > 0.0 ? length(vec2(outside, max(d, 0.0))) : max(d, %s);\n}\n",
            form.ball ? "" : "vec3 faces = abs(p) - 0.5 * size;",
            form.ball ? "length(p) - radius" : "max(faces.x, max(faces.y, faces.z))");
}

/* What is negative inside. */
static uint16_t add_root(struct equation *equation)
{
    const struct equation_node *right = &equation->nodes[equation->right];
    const bool turned =
        equation->relation == EQUATION_GREATER || equation->relation == EQUATION_GREATER_EQUAL;
    const uint16_t first = turned ? equation->right : equation->left;
    const uint16_t second = turned ? equation->left : equation->right;

    if (!turned && right->op == EQUATION_NUMBER && right->value == 0) {
        return equation->left;
    }
    equation->nodes[equation->count] =
        (struct equation_node){.op = EQUATION_SUBTRACT, .args = {first, second}, .varies = true};
    return (uint16_t)equation->count++;
}

static void write_distance(const struct equation_writer *w, uint16_t root,
                           struct equation_form form)
{
    if (is_called(w, EQUATION_POWER, -1)) {
        fputs("mat3 jet_exp(mat3 a) { return jet_of(a, range_exp(a[2].xy)); }\n", w->out);
    }
    write_within(w, root, form);
    write_sdf(w, form);
}

static void write_function(const struct equation_writer *w, uint16_t root, const char *rest)
{
    fputs("vec4 function_at(vec3 p)\n{\n", w->out);
    write_nodes(w, false, equation_write_scalar);
    write_nodes(w, true, equation_write_gradient);
    fprintf(w->out, varies(w, root) ? "return g%d;\n}\n" : "return vec4(0.0, 0.0, 0.0, s%d);\n}\n",
            root);
    fputs(rest, w->out);
}

/* `form` NULL: the function alone, and the rest. */
static char *write(const struct equation *equation, const char *const *letters,
                   const struct equation_form *form, const char *rest)
{
    struct equation whole = *equation;
    char *text = NULL;
    size_t length = 0;
    const uint16_t root = add_root(&whole);
    struct equation_writer w = {
        .equation = &whole, .letters = letters, .out = open_memstream(&text, &length)};

    mark_used(&w);
    w.used[root] = true;
    write_functions(&w);
    if (form) {
        write_distance(&w, root, *form);
    } else {
        write_function(&w, root, rest);
    }
    fclose(w.out);
    return text;
}

char *equation_code(const struct equation *equation, const char *const *letters,
                    struct equation_form form)
{
    return write(equation, letters, &form, "");
}

char *equation_function_code(const struct equation *equation, const char *const *letters,
                             const char *rest)
{
    return write(equation, letters, NULL, rest);
}
