/* SPDX-License-Identifier: MIT */
/* From nodes to instructions. */
#include "field_emit.h"

#include <math.h>

#include "field_code.h"
#include "field_instance.h"
#include "field_isolate.h"
#include "field_materials.h"
#include "field_sites.h"

static uint32_t subtree_count(const struct node *node)
{
    uint32_t count = 1;

    for (size_t i = 0; i < node->child_count; i++) {
        count += subtree_count(node->children[i]);
    }
    return count;
}

/* Nodes that are passed over have their numbers too. Those of models have none of their own. */
static void skip(struct builder *b, const struct node *node)
{
    b->index += b->instance ? 0 : subtree_count(node);
}

/* The block of an operation's or distance modifier's parameters. */
static void add_block(struct builder *b, const struct node *node, const struct sdf *sdf,
                      double scale, struct field_instruction *instruction)
{
    struct param_slot places[SDF_PARAMS_MAX];

    instruction->params =
        builder_add_vec4s(b, (size_t)field_layout(node->params.type->params, 0, places));
    instruction->arguments = builder_add_arguments(b, SDF_PARAMS_MAX);
    instruction->choices = field_choices(&node->params);
    builder_put_params(b, node->params.type->params, node->params.values, sdf, scale,
                       instruction->params, 0, instruction->arguments);
}

struct field_instruction field_union_at(const struct builder *b, uint16_t slot)
{
    return (struct field_instruction){
        .op = FIELD_COMBINE, .type = b->union_type, .sdf = b->union_sdf, .a = slot, .b = slot + 1};
}

static enum field_before before_next(enum field_before before, const struct result *own)
{
    return own->shown || before == FIELD_SEEN     ? FIELD_SEEN
           : own->solid || before == FIELD_UNSEEN ? FIELD_UNSEEN
                                                  : FIELD_NOTHING;
}

/* The children and, where there is one, the node's own shape, which is in the slot. */
static struct result emit_union(struct builder *b, const struct node *node,
                                const struct node_frame *frame, uint16_t slot,
                                enum field_before before, struct result own)
{
    for (size_t i = 0; i < node->child_count; i++) {
        i = sites_operand(b, i, &own);
        struct result child =
            field_emit(b, node->children[i], frame, slot, before_next(before, &own));
        field_join(&own, &child);
    }
    return own;
}

/* An operation's operands, folded from the left. */
struct fold {
    struct result whole;
    size_t count;       /* of children that the operation sees */
    bool dead, lost;    /* nothing is left, whatever comes; nothing that is seen */
    size_t side_count;  /* numbers that say a side, */
    uint32_t side_vec4; /* the last four of them here */
};

/* Whether the operation tells an operand that is FIELD_FAR away from none. */
static bool needs_sides(const struct builder *b, const struct field_instruction *combine)
{
    const struct sdf *sdf = combine->sdf;

    return sdf->rule != SDF_ANY || sdf->operands > 0 ||
           (sdf->feels_far && sdf->feels_far(b->field->arguments + combine->arguments));
}

static enum field_side side_of(const struct result *first, const struct result *second)
{
    return !second->shown ? FIELD_FIRST : first->shown ? FIELD_BOTH : FIELD_SECOND;
}

static void add_combine(struct builder *b, struct field_instruction combine, struct fold *fold,
                        const struct result *child)
{
    combine.side = side_of(&fold->whole, child);
    if (needs_sides(b, &combine)) {
        const size_t component = fold->side_count++ % 4;
        if (component == 0) {
            fold->side_vec4 = builder_add_vec4s(b, 1);
        }
        combine.seen = 4 * fold->side_vec4 + (uint32_t)component;
        b->field->params[combine.seen] = (float)combine.side;
    }
    builder_add_instruction(b, combine);
}

/* The box of the first operands with one more. */
static struct bounds folded_box(const struct result *whole, const struct result *child,
                                enum sdf_rule rule)
{
    if (!whole->shown || !child->shown) {
        return child->shown || !whole->solid ? child->box : whole->box;
    }
    return rule == SDF_ANY   ? bounds_union(whole->box, child->box)
           : rule == SDF_ALL ? bounds_intersection(whole->box, child->box)
                             : whole->box;
}

static void fold_child(struct builder *b, struct fold *fold,
                       const struct field_instruction *combine, const struct result *child,
                       bool leads)
{
    const enum sdf_rule rule = combine->sdf->rule;
    const bool vital = leads || (rule == SDF_ALL && !child->hidden);

    fold->count += !child->apart && (leads || !child->hidden);
    fold->dead = fold->dead || (vital && !child->solid);
    fold->lost = fold->lost || (vital && !child->shown && !child->apart);
    if (!child->solid || fold->dead) {
        return;
    }
    struct result *whole = &fold->whole;
    if (whole->solid) {
        add_combine(b, *combine, fold, child);
    }
    field_join_transmissive(whole, child);
    whole->box = folded_box(whole, child, rule);
    whole->solid = true;
    whole->shown = whole->shown || child->shown;
}

/* Folds the children from the left into `slot`. */
static struct fold emit_folded(struct builder *b, const struct node *node,
                               struct field_instruction combine, const struct node_frame *frame,
                               uint16_t slot)
{
    const enum sdf_rule rule = combine.sdf->rule;
    struct fold fold = {.count = 0};
    const bool cutting = b->cutting, ended = b->ended;

    combine.a = slot;
    combine.b = slot + 1;
    for (size_t i = 0; i < node->child_count; i++) {
        if (combine.sdf->operands > 0 && i >= combine.sdf->operands) {
            skip(b, node->children[i]);
            continue;
        }
        b->cutting = cutting || (fold.count > 0 && rule != SDF_ANY);
        b->cuts_transmissive =
            cutting ? b->cuts_transmissive : fold.whole.transmissive || !fold.whole.shown;
        b->ended = ended && (rule == SDF_ANY || (rule == SDF_FIRST && i == 0));
        struct result child =
            field_emit(b, node->children[i], frame, slot + fold.whole.solid, FIELD_NOTHING);
        b->cutting = cutting;
        b->ended = ended;
        fold_child(b, &fold, &combine, &child, rule == SDF_FIRST && i == 0);
    }
    fold.whole.solid = fold.whole.solid && !fold.dead;
    fold.whole.shown = fold.whole.shown && !fold.lost;
    return fold;
}

/* The box after the node changed the field of `count` operands in it. */
static struct bounds changed_box(const struct node *node, const struct sdf *sdf, struct bounds box,
                                 size_t count)
{
    double numbers[SDF_NUMBERS_MAX];

    sdf_numbers(node->params.type->params, node->params.values, numbers);
    box = bounds_grow(box, sdf->lowered ? sdf->lowered(numbers, count) : 0);
    box.stretch *= sdf->stretched ? sdf->stretched(numbers, count) : 1;
    return box;
}

static struct result emit_combine(struct builder *b, const struct node *node, const struct sdf *sdf,
                                  const struct node_frame *frame, uint16_t slot)
{
    struct field_instruction combine = {.op = FIELD_COMBINE, .type = node->type, .sdf = sdf};

    const bool measured = b->measured;

    add_block(b, node, sdf, frame->scale, &combine);
    b->measured = measured || node->type->record.params[0].name; /* other ones take one distance */
    struct fold fold = emit_folded(b, node, combine, frame, slot);
    b->measured = measured;
    if (fold.whole.solid) {
        fold.whole.box = changed_box(node, sdf, fold.whole.box, fold.count);
    }
    return fold.whole;
}

static struct result emit_distance(struct builder *b, const struct node *node,
                                   const struct sdf *sdf, const struct node_frame *frame,
                                   uint16_t slot)
{
    struct field_instruction change = {
        .op = FIELD_DISTANCE, .type = node->type, .sdf = sdf, .a = slot};

    const bool measured = b->measured;

    add_block(b, node, sdf, frame->scale, &change);
    b->measured = true;
    struct result whole = emit_union(b, node, frame, slot, FIELD_NOTHING, (struct result){0});
    b->measured = measured;
    if (whole.solid) {
        builder_add_instruction(b, change);
        whole.box = changed_box(node, sdf, whole.box, 1);
    }
    return whole;
}

/* Children see a point of their own, in slot point + 2; point + 1 is the modifier's own space. */
static struct result emit_domain(struct builder *b, const struct node *node, const struct sdf *sdf,
                                 const struct node_frame *frame, uint16_t slot)
{
    const struct sdf_domain *domain = sdf->domain;
    const size_t own_count = 4 * (size_t)domain->vec4s;
    const uint32_t block = builder_add_vec4s(b, FIELD_MATRIX_VEC4S + (size_t)domain->vec4s);
    uint32_t arguments = builder_add_arguments(b, 12 + own_count);

    builder_put(b, block, 0, arguments, 12, frame->matrix);
    uint16_t own = frame->point + 1, inner = frame->point + 2;
    bool loops = domain->range != NULL;
    struct field_instruction next = {.type = node->type,
                                     .sdf = sdf,
                                     .a = slot,
                                     .b = slot,
                                     .params = block,
                                     .arguments = arguments};
    next.op = FIELD_TRANSFORM, next.point = frame->point, next.out = own;
    builder_add_instruction(b, next);
    next.params += FIELD_MATRIX_VEC4S, next.arguments += 12;
    next.op = loops ? FIELD_LOOP : FIELD_WARP, next.point = own, next.out = inner;
    if (loops || domain->map) {
        builder_add_instruction(b, next);
    } else {
        inner = own;
    }

    struct node_frame inside = node_frame_create(inner, frame->scale, frame->material);
    const uint64_t trips_before = b->trips;
    const bool all_again = b->whole;
    b->trips = 0;
    b->whole = sites_set_scale(b, frame->scale) && all_again;
    struct result whole =
        emit_union(b, node, &inside, slot + loops, FIELD_NOTHING, (struct result){0});
    b->whole = all_again;
    if (!whole.solid) {
        return whole;
    }
    double params[SDF_NUMBERS_MAX], own_numbers[4 * SDF_DOMAIN_VEC4S_MAX] = {0};
    sdf_numbers(node->params.type->params, node->params.values, params);
    domain->prepare(params, &whole.box, frame->scale, own_numbers);
    builder_put(b, block + FIELD_MATRIX_VEC4S, 0, arguments + 12, (int)own_count, own_numbers);
    if (loops) {
        b->trips = (uint64_t)domain->cells(own_numbers) * (1 + b->trips);
        b->loops++;
        next.op = FIELD_LOOP_END, next.b = slot + 1;
        builder_add_instruction(b, next);
    }
    builder_add_trips(b, domain->trips ? (uint64_t)domain->trips(params) : 0);
    if (domain->after) {
        next.op = FIELD_AFTER, next.b = slot, next.out = own;
        next.seen = 4 * builder_add_vec4s(b, 1);
        b->field->params[next.seen] = (float)-FIELD_FAR;
        builder_add_instruction(b, next);
    }
    b->trips += trips_before;
    whole.box = domain->box(params, &whole.box);
    return whole;
}

static struct result emit_model(struct builder *b, const struct node *node,
                                const struct node_frame *frame, uint16_t slot,
                                enum field_before before, uint32_t number)
{
    const struct resource *model = node_model(b->scene, node);

    if (!model) {
        return (struct result){0};
    }
    const bool outermost = b->instance == 0;
    if (outermost) {
        b->instance = number;
        b->instance_node = node;
    }
    const struct instance_values *around = b->values;
    const struct instance_values own = instance_values_of(b->scene, node, model);
    b->values = &own;
    struct result result = field_emit(b, model->root, frame, slot, before);
    b->values = around;
    if (outermost) {
        b->instance = 0;
    }
    result.hidden = false;
    return result;
}

/* Whether a union goes on in a node of this kind: else the node is one of its operands. */
static bool continues(const struct builder *b, const struct node *node)
{
    switch (node->type->kind) {
    case KIND_SHAPE:
    case KIND_FLAT:
    case KIND_CODE:
    case KIND_EQUATION:
    case KIND_SURFACE:
    case KIND_MODEL:
    case KIND_GROUP:
        return true;
    case KIND_COMBINE:
        return node->type == b->union_type;
    case KIND_DISTANCE:
    case KIND_DOMAIN:
        break;
    }
    return false;
}

/* What is around isolated nodes is not seen itself. */
static struct result emit_own_shape(struct builder *b, const struct node *node,
                                    const struct node_frame *frame, uint16_t slot, uint32_t number)
{
    struct builder_mark mark = builder_mark(b);
    struct result own = field_emit_shape(b, node, frame, slot, number);

    if (own.solid && b->isolation && !b->within) {
        own.shown = own.transmissive = false;
        builder_hide(b, mark);
    }
    return own;
}

static struct result emit_joining(struct builder *b, const struct node *node,
                                  const struct node_frame *frame, uint16_t slot,
                                  enum field_before before, uint32_t number)
{
    const bool joined = before != FIELD_NOTHING;
    struct result own = {.hidden = false};

    switch (node->type->kind) {
    case KIND_SHAPE:
    case KIND_FLAT:
    case KIND_CODE:
    case KIND_EQUATION:
    case KIND_SURFACE:
        own = emit_own_shape(b, node, frame, slot + joined, number);
        if (own.solid && joined) {
            builder_add_instruction(b, field_union_at(b, slot));
        }
        break;
    case KIND_MODEL:
        own = emit_model(b, node, frame, slot, before, number);
        break;
    default:
        break;
    }
    return emit_union(b, node, frame, slot, before, own);
}

static struct result emit_apart(struct builder *b, const struct node *node,
                                const struct node_frame *frame, uint16_t slot)
{
    const struct sdf *sdf = sdf_find(node->type);
    const bool ended = b->ended;
    struct result result;

    switch (node->type->kind) {
    case KIND_COMBINE:
        return emit_combine(b, node, sdf, frame, slot);
    case KIND_DISTANCE:
        return emit_distance(b, node, sdf, frame, slot);
    default:
        b->ended = false;
        result = emit_domain(b, node, sdf, frame, slot);
        b->ended = ended;
        return result;
    }
}

/* Puts a guard around what was emitted since `mark` into `slot`, which held a distance already. It
 * pays where there are loops: llvmpipe runs all else whether it is needed or not. Where nothing is
 * seen before, the guard is always 0: the subtree's distance is taken as it is. */
static void guard(struct builder *b, struct builder_mark mark, enum field_before before,
                  uint16_t slot, const struct node_frame *outer, const struct bounds *box)
{
    if (!sites_set_guarded(b, b->trips != mark.trips)) {
        return;
    }
    struct bounds placed = bounds_transform(box, outer->back, 1);
    double numbers[8] = {0};
    for (int i = 0; i < 3; i++) {
        const double half = (placed.high[i] - placed.low[i]) / 2;
        const bool ends = half < FIELD_UNCUT;
        numbers[i] = ends ? placed.low[i] + half : 0;
        numbers[4 + i] = ends ? half : FIELD_UNCUT;
    }
    numbers[3] = before == FIELD_SEEN && b->loops > mark.loops ? outer->slot_scale : 0;
    struct field_instruction in = {.op = FIELD_GUARD,
                                   .a = slot,
                                   .point = outer->point,
                                   .params = builder_add_vec4s(b, 2),
                                   .arguments = builder_add_arguments(b, 8)};
    builder_put(b, in.params, 0, in.arguments, 8, numbers);
    builder_insert_instruction(b, mark.instructions, in);
    in.op = FIELD_GUARD_END;
    builder_add_instruction(b, in);
    b->trips++;
}

/* Where a node's numbers, nesting or count leave what can be drawn, with models written out. */
static void check(struct builder *b, const struct node *node, const struct node_frame *frame)
{
    char place[32 + LIMIT_ID_BYTES];
    struct error err = {0};

    snprintf(place, sizeof place, "/nodes/%s", b->instance ? b->instance_node->id : node->id);
    if (!node_frame_is_sane(frame)) {
        snprintf(place, sizeof place, "/nodes/%s/transform", node->id);
        error_set(&err, ERROR_LIMIT, place,
                  "with its parents' transforms it leaves the range of 1e-15 to 1e15");
    } else if (b->depth > LIMIT_NODE_DEPTH) {
        error_set(&err, ERROR_LIMIT, place,
                  "with its models it is nested %zu levels deep, above the maximum %d", b->depth,
                  LIMIT_NODE_DEPTH);
    } else if (++b->emitted > LIMIT_NODES) {
        error_set(&err, ERROR_LIMIT, place, "with its models it has more than %d nodes",
                  LIMIT_NODES);
    } else {
        return;
    }
    builder_fail(b, &err, place);
}

/* Of what makes its part of the program, apart from its children. */
static uint64_t member_hash(const struct builder *b, const struct node *node)
{
    uint64_t hash = field_text_hash(BUILDER_HASH_START, node->id);

    hash = builder_hash(builder_hash(hash, (uint32_t)node->type->number),
                        field_choices(&node->params));
    struct field_call call;
    if (field_call_of(b->scene, node, &call)) {
        hash = field_text_hash(hash, call.text);
    }
    return hash;
}

/* Whether the node has no part in the program. */
static bool is_left_out(const struct builder *b, bool hidden, uint64_t member)
{
    return (hidden || b->hiding) && !(b->drawn && field_has_member(b->drawn, member));
}

static struct result emit_node(struct builder *b, const struct node *node,
                               const struct node_frame *frame, uint16_t slot,
                               enum field_before before, uint32_t number)
{
    const bool joined = before != FIELD_NOTHING;

    if (continues(b, node)) {
        return emit_joining(b, node, frame, slot, before, number);
    }
    struct result result = emit_apart(b, node, frame, slot + joined);
    result.transmissive_box = result.box;
    if (result.solid && joined) {
        builder_add_instruction(b, field_union_at(b, slot));
    }
    return result;
}

/* `node` is as it is in the instance around. */
static struct result emit_entered(struct builder *b, const struct node *node,
                                  const struct node_frame *outer, uint16_t slot,
                                  enum field_before before, struct result result)
{
    const uint32_t number = b->instance ? b->instance : ++b->index;
    double from[12], ratio;
    struct node_frame frame = node_frame_enter(outer, node, from, &ratio);
    const char *material = record_text(&node->common, "material");

    if (*material) {
        frame.material = field_material_slot(b->scene, material);
    }
    const struct result nothing = result;
    struct builder_mark mark = builder_mark(b);
    b->depth++;
    check(b, node, &frame);
    sites_pass_guard(b);
    if (!b->failed) {
        result = emit_node(b, node, &frame, slot, before, number);
    }
    b->depth--;
    result.hidden = nothing.hidden;
    result.apart = nothing.apart;
    if (!result.solid) {
        builder_rewind(b, mark);
        return nothing;
    }
    result.box = bounds_transform(&result.box, from, ratio);
    result.transmissive_box = bounds_transform(&result.transmissive_box, from, ratio);
    if (before != FIELD_NOTHING) {
        guard(b, mark, before, slot, outer, &result.box);
    }
    const bool endless = b->ended && !bounds_is_finite(&result.box);
    if (result.hidden || result.apart || !result.shown || endless) {
        result.shown = result.transmissive = false;
        builder_hide(b, mark);
    }
    return result;
}

static enum isolated_part part_of(const struct builder *b, const struct node *node)
{
    return b->isolation && !b->within ? isolation_part(b->isolation, node) : ISOLATED_ITSELF;
}

/* What is empty space has to stand somewhere, too. */
static void check_empty(struct builder *b, const struct instance_values *values,
                        const struct node *node, const struct node_frame *outer)
{
    double from[12], ratio;
    struct instance_room room;
    const struct node *shown = instance_node(values, node, &room);
    struct node_frame frame = node_frame_enter(outer, shown, from, &ratio);
    const struct resource *model =
        node->type->kind == KIND_MODEL ? node_model(b->scene, node) : NULL;

    b->failed = b->failed || !node_frame_is_sane(&frame);
    if (node->type->kind == KIND_DOMAIN) {
        frame = node_frame_create(frame.point, frame.scale, frame.material);
    }
    if (model) {
        const struct instance_values own = instance_values_of(b->scene, shown, model);
        check_empty(b, &own, model->root, &frame);
    }
    for (size_t i = 0; i < node->child_count; i++) {
        check_empty(b, values, node->children[i], &frame);
    }
    instance_room_finish(&room);
}

static bool is_passed_over(struct builder *b, const struct node *node,
                           const struct node_frame *outer)
{
    if (!sites_has_changed(b)) {
        return true;
    }
    if (sites_is_empty(b)) {
        check_empty(b, b->values, node, outer);
        return true;
    }
    return false;
}

struct result field_emit(struct builder *b, const struct node *node, const struct node_frame *outer,
                         uint16_t slot, enum field_before before)
{
    const bool has_part = b->again && sites_has(b, node);

    if (has_part && is_passed_over(b, node, outer)) {
        return sites_take(b);
    }
    bool hidden = record_number(&node->common, "visible") == 0;
    const uint64_t member = b->again ? 0 : member_hash(b, node);
    if (b->failed || (b->again ? !has_part : is_left_out(b, hidden, member))) {
        skip(b, node);
        sites_leave_out(b);
        return (struct result){.hidden = true};
    }
    bool hiding = b->hiding, whole = b->whole;
    builder_add_member(b, member);
    const uint32_t site = sites_open(b, node);
    const enum isolated_part part = part_of(b, node);
    bool within = b->within;
    b->hiding = hiding || hidden;
    b->within = part != ISOLATED_AROUND;
    struct instance_room room;
    struct result result =
        emit_entered(b, instance_node(b->values, node, &room), outer, slot, before,
                     (struct result){.hidden = hidden, .apart = part == ISOLATED_AWAY});
    instance_room_finish(&room);
    sites_close(b, site, &result);
    b->whole = whole;
    b->hiding = hiding;
    b->within = within;
    return result;
}
