/* SPDX-License-Identifier: MIT */
/* Functions of GLSL's own. */
#include <string.h>

#include "emit.h"

/* clang-format off */
static const struct spmd_builtin builtins[] = {
    {"abs", GIVES_SAME, WRITTEN_EACH}, {"sign", GIVES_SAME, WRITTEN_EACH},
    {"floor", GIVES_SAME, WRITTEN_EACH}, {"ceil", GIVES_SAME, WRITTEN_EACH},
    {"trunc", GIVES_SAME, WRITTEN_EACH}, {"round", GIVES_SAME, WRITTEN_EACH},
    {"fract", GIVES_SAME, WRITTEN_EACH},
    {"min", GIVES_SAME, WRITTEN_EACH}, {"max", GIVES_SAME, WRITTEN_EACH},
    {"clamp", GIVES_SAME, WRITTEN_EACH}, {"step", GIVES_SAME, WRITTEN_EACH},
    {"smoothstep", GIVES_SAME, WRITTEN_EACH}, {"mod", GIVES_SAME, WRITTEN_EACH},
    {"sqrt", GIVES_SAME, WRITTEN_EACH}, {"inversesqrt", GIVES_SAME, WRITTEN_EACH},
    {"exp", GIVES_SAME, WRITTEN_EACH}, {"exp2", GIVES_SAME, WRITTEN_EACH},
    {"log", GIVES_SAME, WRITTEN_EACH}, {"log2", GIVES_SAME, WRITTEN_EACH},
    {"pow", GIVES_SAME, WRITTEN_EACH}, {"sin", GIVES_SAME, WRITTEN_EACH},
    {"cos", GIVES_SAME, WRITTEN_EACH}, {"tan", GIVES_SAME, WRITTEN_EACH},
    {"asin", GIVES_SAME, WRITTEN_EACH}, {"acos", GIVES_SAME, WRITTEN_EACH},
    {"atan", GIVES_SAME, WRITTEN_EACH}, {"mix", GIVES_SAME, WRITTEN_SPECIAL},
    {"length", GIVES_FLOAT, WRITTEN_SPECIAL}, {"distance", GIVES_FLOAT, WRITTEN_SPECIAL},
    {"dot", GIVES_FLOAT, WRITTEN_SPECIAL}, {"normalize", GIVES_SAME, WRITTEN_SPECIAL},
    {"reflect", GIVES_SAME, WRITTEN_SPECIAL}, {"cross", GIVES_VEC3, WRITTEN_SPECIAL},
    {"lessThan", GIVES_BOOLS, WRITTEN_SPECIAL}, {"lessThanEqual", GIVES_BOOLS, WRITTEN_SPECIAL},
    {"greaterThan", GIVES_BOOLS, WRITTEN_SPECIAL},
    {"greaterThanEqual", GIVES_BOOLS, WRITTEN_SPECIAL},
    {"equal", GIVES_BOOLS, WRITTEN_SPECIAL}, {"any", GIVES_BOOL, WRITTEN_SPECIAL},
    {"all", GIVES_BOOL, WRITTEN_SPECIAL},
    {"uintBitsToFloat", GIVES_FLOATS, WRITTEN_SPECIAL},
    {"floatBitsToUint", GIVES_UINTS, WRITTEN_SPECIAL},
    {"texelFetch", GIVES_VEC4, WRITTEN_SPECIAL}, {"textureLod", GIVES_VEC4, WRITTEN_SPECIAL},
    {"textureSize", GIVES_IVEC2, WRITTEN_SPECIAL},
    /* Number i of the scene's vec4s, and of the instruction's own. */
    {"param", GIVES_VEC4, WRITTEN_SPECIAL}, {"own_param", GIVES_VEC4, WRITTEN_SPECIAL},
    /* Whether it is so in a lane of those that are here, and what the first of them has. */
    {"any_lane", GIVES_SAME, WRITTEN_SPECIAL}, {"first_lane", GIVES_SAME, WRITTEN_SPECIAL},
};
/* clang-format on */

const struct spmd_builtin *spmd_builtin_find(const char *name)
{
    for (size_t i = 0; i < sizeof builtins / sizeof builtins[0]; i++) {
        if (strcmp(builtins[i].name, name) == 0) {
            return &builtins[i];
        }
    }
    return NULL;
}

bool spmd_builtin_joins(const char *name)
{
    return strcmp(name, "any_lane") == 0 || strcmp(name, "first_lane") == 0;
}

enum { ARGS_MAX = 4 };

static int widest(const struct value *args, int count)
{
    int most = 1;

    for (int i = 0; i < count; i++) {
        most = args[i].count > most ? args[i].count : most;
    }
    return most;
}

static struct value each(struct emit *e, const char *name, const struct value *args, int count)
{
    struct value out = emit_values(e, widest(args, count));

    for (int i = 0; i < out.count; i++) {
        struct component of[ARGS_MAX];
        for (int k = 0; k < count; k++) {
            of[k] = emit_value_at(&args[k], i);
        }
        out.at[i] = emit_each(e, name, of, count);
    }
    return out;
}

static struct component dot(struct emit *e, const struct value *a, const struct value *b)
{
    struct component sum = emit_operator(e, OP_MULTIPLY, a->at[0], b->at[0]);

    for (int i = 1; i < a->count; i++) {
        sum = emit_operator(e, OP_ADD, sum, emit_operator(e, OP_MULTIPLY, a->at[i], b->at[i]));
    }
    return sum;
}

static struct value one(struct emit *e, struct component x)
{
    struct value out = emit_values(e, 1);

    out.at[0] = x;
    return out;
}

/* a op b, component by component. */
static struct value both(struct emit *e, enum op op, const struct value *a, const struct value *b)
{
    struct value out = emit_values(e, a->count > b->count ? a->count : b->count);

    for (int i = 0; i < out.count; i++) {
        out.at[i] = emit_operator(e, op, emit_value_at(a, i), emit_value_at(b, i));
    }
    return out;
}

static struct value length(struct emit *e, const struct value *args)
{
    struct component square = dot(e, &args[0], &args[0]);

    return args[0].count == 1 ? one(e, emit_each(e, "abs", args[0].at, 1))
                              : one(e, emit_each(e, "sqrt", &square, 1));
}

static struct value distance(struct emit *e, const struct value *args)
{
    struct value apart = both(e, OP_SUBTRACT, &args[0], &args[1]);

    return length(e, &apart);
}

static struct value dot_of(struct emit *e, const struct value *args)
{
    return one(e, dot(e, &args[0], &args[1]));
}

static struct value normalize(struct emit *e, const struct value *args)
{
    struct component square = dot(e, &args[0], &args[0]);
    struct value by = one(e, emit_each(e, "inversesqrt", &square, 1));

    return both(e, OP_MULTIPLY, &args[0], &by);
}

static struct value reflect(struct emit *e, const struct value *args)
{
    const struct component two = {"2.0f", BASE_FLOAT, false};
    struct value by = one(e, emit_operator(e, OP_MULTIPLY, two, dot(e, &args[1], &args[0])));
    struct value back = both(e, OP_MULTIPLY, &by, &args[1]);

    return both(e, OP_SUBTRACT, &args[0], &back);
}

static struct value cross(struct emit *e, const struct value *args)
{
    const struct component *a = args[0].at, *b = args[1].at;
    struct value out = emit_values(e, 3);

    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out.at[i] = emit_operator(e, OP_SUBTRACT, emit_operator(e, OP_MULTIPLY, a[j], b[k]),
                                  emit_operator(e, OP_MULTIPLY, a[k], b[j]));
    }
    return out;
}

static struct value mix(struct emit *e, const struct value *args)
{
    if (args[2].at[0].base != BASE_BOOL) {
        return each(e, "mix", args, 3);
    }
    struct value out = emit_values(e, widest(args, 3));
    for (int i = 0; i < out.count; i++) {
        struct component no = emit_value_at(&args[0], i), yes = emit_value_at(&args[1], i);
        struct component mask = emit_spread(e, emit_value_at(&args[2], i));
        out.at[i] = emit_select(e, mask, yes, no);
    }
    return out;
}

static struct value together(struct emit *e, const struct value *args, enum op op)
{
    struct component sum = args[0].at[0];

    for (int i = 1; i < args[0].count; i++) {
        sum = emit_operator(e, op, sum, args[0].at[i]);
    }
    return one(e, sum);
}

static struct value bits(struct emit *e, const struct value *args, enum base to)
{
    struct value out = emit_values(e, args[0].count);

    for (int i = 0; i < out.count; i++) {
        struct component x = args[0].at[i];
        out.at[i] = emit_temp(e, to, x.varying, x.varying ? "(%s)%s" : "%s_of_bits(%s)",
                              x.varying ? emit_type(to, true) : emit_type(to, false), x.text);
    }
    return out;
}

/* (texture, place, level) */
static struct value look_up(struct emit *e, const struct value *args, const char *function)
{
    struct value out = emit_values(e, 4);

    emit_line(e, "vf t%d[4];", e->temps);
    emit_line(e, "%s(c, %s, m, %s, %s, %s, t%d);", function, args[0].at[0].text,
              emit_spread(e, args[1].at[0]).text, emit_spread(e, args[1].at[1]).text,
              emit_spread(e, args[2].at[0]).text, e->temps);
    for (int i = 0; i < 4; i++) {
        out.at[i] = (struct component){emit_text(e, "t%d[%d]", e->temps, i), BASE_FLOAT, true};
    }
    e->temps++;
    return out;
}

static struct value texture_lod(struct emit *e, const struct value *args)
{
    return look_up(e, args, "lanes_texture");
}

static struct value texel_fetch(struct emit *e, const struct value *args)
{
    return look_up(e, args, "lanes_texel");
}

static struct value texture_size(struct emit *e, const struct value *args)
{
    struct value out = emit_values(e, 2);

    for (int i = 0; i < 2; i++) {
        out.at[i] =
            emit_temp(e, BASE_INT, false, "lanes_texture_size(c, %s, %d)", args[0].at[0].text, i);
    }
    return out;
}

static struct value param(struct emit *e, const struct value *args, const char *where)
{
    struct value out = emit_values(e, 4);
    const struct component at = args[0].at[0];

    for (int i = 0; i < 4; i++) {
        out.at[i] =
            at.varying ? emit_temp(e, BASE_FLOAT, true, "lanes_gather(c->%s, 4 * %s + %d, m)",
                                   where, at.text, i)
                       : emit_temp(e, BASE_FLOAT, false, "c->%s[4 * (%s) + %d]", where, at.text, i);
    }
    return out;
}

/* One number of all lanes. */
static struct value any_lane(struct emit *e, const struct value *args)
{
    return one(
        e, emit_temp(e, BASE_BOOL, false, "lanes_any(m & %s)", emit_spread(e, args[0].at[0]).text));
}

static struct value first_lane(struct emit *e, const struct value *args)
{
    return one(e, emit_temp(e, args[0].at[0].base, false, "(%s)[lanes_first(m)]",
                            emit_spread(e, args[0].at[0]).text));
}

static struct value special(struct emit *e, const char *name, const struct value *args)
{
    static const struct {
        const char *name;
        struct value (*write)(struct emit *e, const struct value *args);
    } rows[] = {{"length", length},
                {"distance", distance},
                {"dot", dot_of},
                {"normalize", normalize},
                {"reflect", reflect},
                {"cross", cross},
                {"mix", mix},
                {"any_lane", any_lane},
                {"first_lane", first_lane},
                {"textureLod", texture_lod},
                {"textureSize", texture_size},
                {"texelFetch", texel_fetch}};
    static const struct {
        const char *name;
        enum op op;
    } compares[] = {{"lessThan", OP_LESS},
                    {"lessThanEqual", OP_LESS_EQUAL},
                    {"greaterThan", OP_GREATER},
                    {"greaterThanEqual", OP_GREATER_EQUAL},
                    {"equal", OP_EQUAL}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strcmp(rows[i].name, name) == 0) {
            return rows[i].write(e, args);
        }
    }
    for (size_t i = 0; i < sizeof compares / sizeof compares[0]; i++) {
        if (strcmp(compares[i].name, name) == 0) {
            return both(e, compares[i].op, &args[0], &args[1]);
        }
    }
    return strcmp(name, "any") == 0               ? together(e, args, OP_OR)
           : strcmp(name, "all") == 0             ? together(e, args, OP_AND)
           : strcmp(name, "uintBitsToFloat") == 0 ? bits(e, args, BASE_FLOAT)
           : strcmp(name, "floatBitsToUint") == 0 ? bits(e, args, BASE_UINT)
           : strcmp(name, "param") == 0           ? param(e, args, "params")
                                                  : param(e, args, "own");
}

struct value emit_builtin(struct emit *e, struct expr *expr)
{
    const struct spmd_builtin *builtin = spmd_builtin_find(expr->name->text);
    struct value args[ARGS_MAX];
    int count = 0;

    for (struct expr *arg = expr->args; arg && count < ARGS_MAX; arg = arg->next) {
        args[count++] = emit_value(e, arg);
    }
    if (strcmp(builtin->name, "atan") == 0 && count == 2) {
        return each(e, "atan2", args, 2);
    }
    return builtin->written == WRITTEN_EACH ? each(e, builtin->name, args, count)
                                            : special(e, builtin->name, args);
}
