/* SPDX-License-Identifier: MIT */
/* An equation as code, from its parts. */
#include "equation_code.h"

#include <math.h>
#include <string.h>

#include "equation_writer.h"

enum { TRIES = 4, SEARCHES = 24 }; /* boxes for one bound, and for an even one, at most */

/* --- the function, and which functions and powers are used --- */

/* Appends left - right, what is negative inside, and returns its index. */
static uint16_t add_root(struct equation *equation)
{
    const bool turned =
        equation->relation == EQUATION_GREATER || equation->relation == EQUATION_GREATER_EQUAL;
    const uint16_t first = turned ? equation->right : equation->left;
    const uint16_t second = turned ? equation->left : equation->right;
    const struct equation_node *right = &equation->nodes[equation->right];

    if (!turned && right->op == EQUATION_NUMBER && right->value == 0) {
        return equation->left;
    }
    equation->nodes[equation->count] =
        (struct equation_node){.op = EQUATION_SUBTRACT, .args = {first, second}, .varies = true};
    return (uint16_t)equation->count++;
}

/* Leaves out what the root does not need, so that a text does not depend on it. */
static uint16_t keep_needed(struct equation *equation, uint16_t root)
{
    bool needed[LIMIT_EQUATION_NODES + 1] = {false};
    uint16_t places[LIMIT_EQUATION_NODES + 1], count = 0;

    needed[root] = true;
    for (size_t i = root + 1U; i-- > 0;) {
        const struct equation_node *node = &equation->nodes[i];
        for (int k = 0; needed[i] && k < equation_arguments(node); k++) {
            needed[node->args[k]] = true;
        }
    }
    for (size_t i = 0; i <= root; i++) {
        struct equation_node node = equation->nodes[i];
        for (int k = 0; needed[i] && k < equation_arguments(&node); k++) {
            node.args[k] = places[node.args[k]];
        }
        places[i] = count;
        equation->nodes[count] = node;
        count += needed[i];
    }
    equation->count = count;
    return (uint16_t)(count - 1);
}

/* Of the nodes of `out` all are needed, the last one last. */
static uint16_t function_of(const struct equation *equation, struct equation *out)
{
    *out = *equation;
    return keep_needed(out, add_root(out));
}

/* The places of letters and numbers, by node; 0: none. Each letter has one: room is kept for them,
 * whatever numbers come before. Returns how many numbers the code reads. */
static int give_places(const struct equation *function, int out[LIMIT_EQUATION_NODES + 1])
{
    int next = EQUATION_FORM_NUMBERS, room = 4 * EQUATION_VECTORS - EQUATION_FORM_NUMBERS;

    _Static_assert(EQUATION_FORM_NUMBERS + EQUATION_LETTERS <= 4 * EQUATION_VECTORS,
                   "all letters have places");
    for (size_t i = 0; i < function->count; i++) {
        room -= function->nodes[i].op == EQUATION_LETTER;
    }
    for (size_t i = 0; i < function->count; i++) {
        const bool letter = function->nodes[i].op == EQUATION_LETTER;
        const bool number = function->nodes[i].op == EQUATION_NUMBER && room > 0;
        room -= number;
        out[i] = letter || number ? next++ : 0;
    }
    return next;
}

int equation_code_numbers(const struct equation *equation, const double form[EQUATION_FORM_NUMBERS],
                          const double *letters, double out[4 * EQUATION_VECTORS])
{
    struct equation function;
    int places[LIMIT_EQUATION_NODES + 1];

    memset(out, 0, 4 * EQUATION_VECTORS * sizeof *out);
    memcpy(out, form, EQUATION_FORM_NUMBERS * sizeof *out);
    function_of(equation, &function);
    const int count = give_places(&function, places);
    for (size_t i = 0; i < function.count; i++) {
        const struct equation_node *node = &function.nodes[i];
        if (places[i] > 0) {
            out[places[i]] = node->op == EQUATION_LETTER ? letters[node->which] : node->value;
        }
    }
    return (count + 3) / 4;
}

void equation_code_params(int vectors, struct param out[EQUATION_VECTORS + 1])
{
    static const char *const names[EQUATION_VECTORS] = {"v0",  "v1",  "v2",  "v3", "v4",  "v5",
                                                        "v6",  "v7",  "v8",  "v9", "v10", "v11",
                                                        "v12", "v13", "v14", "v15"};

    for (int i = 0; i <= vectors; i++) {
        out[i] = i < vectors ? (struct param){.name = names[i], .type = PARAM_VEC4}
                             : (struct param){.name = NULL};
    }
}

static bool is_called(const struct equation_writer *w, enum equation_op op, int which)
{
    for (size_t i = 0; i < w->equation->count; i++) {
        const struct equation_node *node = &w->equation->nodes[i];
        if (node->op == op && (which < 0 || node->which == which)) {
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
    return hypot(EQUATION_MARGIN, EQUATION_ESTIMATE) * extent;
}

static void write_nodes(const struct equation_writer *w, bool varying,
                        void (*write)(const struct equation_writer *, size_t))
{
    for (size_t i = 0; i < w->equation->count; i++) {
        if (w->equation->nodes[i].varies == varying) {
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

/* The distance d within the clip, by boxes around p, see jet_solid in glsl/jets.glsl. A sheet's
 * last box is as small as its grain where nothing is free yet. */
static void write_boxes(const struct equation_writer *w, uint16_t root, bool sheet)
{
    fputs(sheet ? "at.y = max(at.y, thickness);\nat.w = -0.5 * thickness;\n" : "", w->out);
    fprintf(w->out, "for (int i = 0; i < %d; i++) {\nvec2 sides = vec2(-at.y, at.y);\n", TRIES);
    write_nodes(w, true, equation_write_jet);
    fprintf(w->out, "at = jet_%s(j%d, at%s);\n", sheet ? "sheet" : "solid", root,
            sheet ? ", thickness" : "");
    if (sheet) {
        fprintf(w->out, "at.y = i == %d && at.w < 0.0 ? min(at.y, thickness / 16.0) : at.y;\n",
                TRIES - 2);
    }
    fprintf(w->out, "if (at.y == 0.0) {\nbreak;\n}\n}\nfloat d = %s;\n",
            sheet ? "at.w" : "g.w < 0.0 ? -at.w : at.w");
}

/* The same, even. */
static void write_search(const struct equation_writer *w, uint16_t root, bool sheet)
{
    fprintf(w->out,
            "mat3 search = jet_search(g, room);\n"
            "for (int i = 0; i < %d; i++) {\n"
            "if (search[0].z == 2.0) {\nbreak;\n}\n"
            "vec2 sides = vec2(-search[0].x, search[0].x);\n",
            SEARCHES);
    write_nodes(w, true, equation_write_jet);
    fprintf(w->out, "search = jet_searched(j%d, search);\n}\nfloat d = %s;\n", root,
            sheet ? "search[0].x - 0.5 * thickness" : "g.w < 0.0 ? -search[0].x : search[0].x");
}

/* The function at a point: (gradient, value). */
static void write_function(const struct equation_writer *w, uint16_t root)
{
    fputs("vec4 function_at(vec3 point)\n{\n", w->out);
    write_nodes(w, false, equation_write_scalar);
    write_nodes(w, true, equation_write_gradient);
    fprintf(w->out, varies(w, root) ? "return g%d;\n}\n" : "return vec4(0.0, 0.0, 0.0, s%d);\n}\n",
            root);
}

/* Where an estimate is asked for, no boxes are looked at. */
static void write_estimate(const struct equation_writer *w, bool sheet)
{
    fprintf(w->out,
            "if (most > 0.0) {\n"
            "float way = jet_estimated(g, at, function_at(jet_ahead(p, g, at)));\n"
            "return jet_clipped(near, %s);\n}\n",
            sheet ? "min(way - 0.5 * thickness, most)"
                  : "g.w < 0.0 ? -min(way, most) : min(way, most)");
}

static void write_sdf(const struct equation_writer *w, uint16_t root, struct equation_form form)
{
    fprintf(w->out,
            "float sdf(vec3 point)\n{\n"
            "vec3 size = v0.xyz;\n"
            "float radius = v0.w, thickness = v1.x;\n"
            "vec4 near = jet_near_%s;\n"
            "float extent = %s;\n"
            "float room = max(%g * extent - max(near.w, 0.0), 0.0), most = jet_room(room);\n",
            form.ball ? "ball(point, radius)" : "box(point, size)",
            form.ball ? "radius" : "0.5 * length(size)", EQUATION_ESTIMATE);
    if (form.even) {
        fputs("if (room == 0.0) {\nreturn near.w;\n}\n", w->out);
    } else {
        fprintf(w->out, "if (near.w > %g * extent && most == 0.0) {\nreturn near.w;\n}\n",
                EQUATION_MARGIN);
    }
    fprintf(w->out,
            "vec3 p = near.xyz;\n"
            "vec4 g = function_at(p);\n"
            "vec4 at = jet_begin(g, %g * extent);\n",
            EQUATION_REACH);
    write_estimate(w, form.sheet);
    write_nodes(w, false, equation_write_scalar);
    write_nodes(w, true, write_axis);
    (form.even ? write_search : write_boxes)(w, root, form.sheet);
    fputs("return jet_clipped(near, d);\n}\n", w->out);
}

/* `form` NULL: the function alone, and the rest, by names of the letters. */
static char *write(const struct equation *equation, const struct equation_form *form,
                   const char *const *letters, const char *rest)
{
    struct equation function;
    char *text = NULL;
    size_t length = 0;
    const uint16_t root = function_of(equation, &function);
    struct equation_writer w = {
        .equation = &function, .letters = letters, .out = open_memstream(&text, &length)};

    if (form) {
        give_places(&function, w.places);
    }
    write_functions(&w);
    write_function(&w, root);
    if (form) {
        write_sdf(&w, root, *form);
    }
    fputs(rest, w.out);
    fclose(w.out);
    return text;
}

char *equation_code(const struct equation *equation, struct equation_form form)
{
    return write(equation, &form, NULL, "");
}

char *equation_function_code(const struct equation *equation, const char *const *letters,
                             const char *rest)
{
    return write(equation, NULL, letters, rest);
}
