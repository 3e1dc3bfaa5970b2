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
        const bool by_power = is_called(w, EQUATION_POWER, -1) && i == EQUATION_LOG;
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
    static const char *const slopes[] = {"1.0, 0.0, 0.0", "0.0, 1.0, 0.0", "0.0, 0.0, 1.0"};
    const struct equation_node *node = node_of(w, index);

    if (node->op == EQUATION_AXIS) {
        fprintf(w->out, "mat3 j%zu = mat3(%s, %s, 0.0, 0.0, 0.0);\n", index, slopes[node->which],
                slopes[node->which]);
    }
}

/* The distance d within the clip, by boxes around p: `at` is |f| and half of the side of the next.
 * A sheet's last box is as small as its grain. */
static void write_boxes(const struct equation_writer *w, uint16_t root, bool sheet)
{
    write_nodes(w, true, write_axis);
    fprintf(w->out, "for (int i = 0; i < %d; i++) {\nvec2 sides = vec2(-at.y, at.y);\n", TRIES);
    write_nodes(w, true, equation_write_jet);
    fprintf(w->out,
            "vec2 told = jet_%s(j%d, at%s);\n"
            "d = max(d, told.x);\n"
            "if (told.y == 0.0) {\nbreak;\n}\n",
            sheet ? "sheet" : "solid", root, sheet ? ", thickness" : "");
    if (sheet) {
        fprintf(w->out, "at.y = i == %d ? thickness / 16.0 : told.y;\n}\n", TRIES - 2);
    } else {
        fprintf(w->out, "at.y = told.y;\n}\nd = g%d.w < 0.0 ? -d : d;\n", root);
    }
}

static void write_sdf(const struct equation_writer *w, uint16_t root, struct equation_form form)
{
    const char *const extent = form.ball ? "radius" : "0.5 * length(size)";

    fprintf(w->out,
            "float sdf(vec3 point)\n{\n"
            "vec4 near = jet_near_%s;\n"
            "float extent = %s;\n"
            "if (near.w > %g * extent) {\nreturn near.w;\n}\n"
            "vec3 p = near.xyz;\n",
            form.ball ? "ball(point, radius)" : "box(point, size)", extent, EQUATION_MARGIN);
    write_nodes(w, false, equation_write_scalar);
    write_nodes(w, true, equation_write_gradient);
    fprintf(w->out, "vec2 at = jet_begin(g%d, %g * extent);\n", root, EQUATION_REACH);
    fputs(form.sheet ? "float d = -0.5 * thickness;\nat.y = max(at.y, thickness);\n"
                     : "float d = 0.0;\n",
          w->out);
    write_boxes(w, root, form.sheet);
    fputs("return jet_clipped(near, d);\n}\n", w->out);
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
        write_sdf(&w, root, *form);
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
