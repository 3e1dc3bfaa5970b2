/* SPDX-License-Identifier: MIT */
#include "edited_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "drawing.h"
#include "edits.h"
#include "json_text.h"
#include "numeric_edit.h"

#define BESIDE                                                                                     \
    "{'format':'fieldcast/1','camera':{'position':[0,3,7],'target':[0,0,0]},"                      \
    "'render':{'max_distance':60},"                                                                \
    "'lights':[{'id':'sun','type':'directional','direction':[-0.5,-1,-0.3]},"                      \
    "{'id':'lamp','type':'point','position':[2,3,2],'intensity':9}],"                              \
    "'materials':{'m0':{'shader':'phong'},'m1':{'shader':'checker'},"                              \
    "'m2':{'shader':'standard','properties':{'metallic':1,'base_color':[0.8,0.7,0.5]}},"           \
    "'m3':{'shader':'standard','properties':{'transmission':0.8}}},"

/* Many small shapes on a plane, of the first materials; the third one is metal. */
static void write_scattered(struct random *random, FILE *out, int count, size_t materials)
{
    const double size = 2.5 / sqrt(count);

    static const char *const types[] = {"sphere", "box", "torus", "capsule"};

    fputs("{'id':'shapes','type':'union','children':[{'id':'floor','type':'plane'}", out);
    for (int i = 0; i < count; i++) {
        fprintf(out,
                ",{'id':'s%d','type':'%s','material':'m%d','transform':{'translation':"
                "[%.3f,%.3f,%.3f],'scale':[%.3f,%.3f,%.3f]}}",
                i, types[random_below(random, 4)], (int)random_below(random, materials),
                random_between(random, -3, 3), random_between(random, 0, 0.6),
                random_between(random, -3, 3), size, size, size * random_between(random, 0.5, 1.5));
    }
    fputs("]}", out);
}

/* Of all types: repeats and mirrors, blends and cuts. */
static void write_kinds(struct random *random, FILE *out)
{
    const struct random_limits limits = {.depth = 2, .lean = true, .inner = true};

    fputs("'root':{'id':'root','type':'union','children':[", out);
    for (int i = 0; i < 24; i++) {
        const struct node_type *type;
        do {
            type = node_type_at(random_below(random, node_type_count()));
        } while (type->kind == KIND_CODE || type->kind == KIND_MODEL || type->kind == KIND_FLAT ||
                 type->kind == KIND_EQUATION);
        fputs(i > 0 ? "," : "", out);
        fprintf(out,
                "{'id':'g%d','type':'group','material':'m%d','transform':{'translation':"
                "[%.3f,0,%.3f],'scale':[0.35,0.35,0.35]},'children':[",
                i, i % 4, i % 6 - 2.5, i / 6 - 1.5);
        random_node(random, out, type, &limits);
        fputs("]}", out);
    }
    fputs("]}}", out);
}

static FILE *begin_text(char **text, size_t *length)
{
    FILE *out = open_memstream(text, length);

    assert_non_null(out);
    fputs(BESIDE, out);
    return out;
}

static struct scene *end_text(FILE *out, char **text)
{
    assert_int_equal(fclose(out), 0);
    struct scene *scene = json_text_valid_scene(*text);
    free(*text);
    return scene;
}

/* `before`, `after`: of what they are in, in the text. */
static struct scene *scattered(struct random *random, int count, size_t materials,
                               const char *before, const char *after)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = begin_text(&text, &length);

    fprintf(out, "'root':%s", before);
    write_scattered(random, out, count, materials);
    fprintf(out, "%s}", after);
    return end_text(out, &text);
}

struct scene *edited_scene_scattered(struct random *random, int count, size_t materials)
{
    return scattered(random, count, materials, "", "");
}

struct scene *edited_scene_twisted(struct random *random, int count, size_t materials)
{
    return scattered(random, count, materials, "{'type':'twist','params':{'rate':0.1},'children':[",
                     "]}");
}

struct scene *edited_scene_mirrored(struct random *random, int count, size_t materials)
{
    return scattered(random, count, materials, "{'id':'mirror','type':'mirror','children':[", "]}");
}

static struct scene *scene_of_kinds(struct random *random)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = begin_text(&text, &length);

    write_kinds(random, out);
    return end_text(out, &text);
}

struct scene *edited_scene(struct random *random, size_t life, int count)
{
    return life % 6 == 5   ? drawing_read(DRAWING_RICH)
           : life % 3 == 1 ? scene_of_kinds(random)
                           : edited_scene_scattered(random, count, 3);
}

/* What has the shapes as its children. */
static const struct node *shapes_of(const struct scene *scene)
{
    return scene->root->child_count > 1 ? scene->root : scene->root->children[0];
}

const struct node *edited_scene_child(struct random *random, const struct scene *scene)
{
    const struct node *shapes = shapes_of(scene);

    return shapes->children[random_below(random, shapes->child_count)];
}

/* Something small goes a small way, mostly; numbers, materials, the camera and the floor; lights;
 * what is seen; nodes that come and go. */
cJSON *edited_scene_ops(struct random *random, const struct scene *scene, int number)
{
    const struct node *node = edited_scene_child(random, scene);
    const double *at = record_vector(&node->transform, "translation");
    const size_t what = random_below(random, 16);

    if (what < 5) {
        return edits_format(
            "[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]",
            node->id, at[0] + random_between(random, -0.1, 0.1), at[1],
            at[2] + random_between(random, -0.1, 0.1));
    }
    if (what < 8 && scene->materials.count == 4) { /* not of the other scene's */
        return edits_format("[{'op':'set','at':'/materials/m2/properties/roughness','value':%.3f}]",
                            random_between(random, 0, 1));
    }
    if (what == 8) {
        return edits_format("[{'op':'set','at':'/lights/%s/intensity','value':%.3f}]",
                            scene->lights.items[0]->name, random_between(random, 1, 5));
    }
    if (what == 9) {
        return edits_format("[{'op':'set','at':'/nodes/%s/visible','value':%s}]", node->id,
                            record_number(&node->common, "visible") != 0 ? "false" : "true");
    }
    if (what == 10) {
        return edits_format(
            "[{'op':'insert','into':'/nodes/%s','before':null,'value':{'id':'new%d',"
            "'type':'sphere','transform':{'translation':[0,%.3f,0],'scale':0.4}}}]",
            shapes_of(scene)->id, number, random_between(random, -1, 1));
    }
    if (what == 11) {
        return edits_format("[{'op':'remove','at':'/nodes/%s'}]", node->id);
    }
    if (what < 14) { /* far away, so that another place is looked at */
        return edits_format(
            "[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]",
            node->id, random_between(random, -2, 2), at[1], random_between(random, -2, 2));
    }
    return numeric_edit(random, scene, what == 14);
}
