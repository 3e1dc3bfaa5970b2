/* SPDX-License-Identifier: MIT */
/* What light that goes through a surface is dyed by: of each shader, in whole pictures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 64, HEIGHT = 48 };

static struct renderer *renderer;

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* A ball of the material in a white room, or over a white floor in the light of a lamp. */
static struct image draw(const char *material, const char *lights, bool floor)
{
    char text[1600];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','camera':{'position':[0,1,3],'target':[0,0,0]},"
             "'lights':[%s],'render':{'antialiasing':'none','ray_depth':8,"
             "'occlusion':false},'environment':{'type':'solid','color':[1,1,1],"
             "'floor':%s,'floor_height':-0.8,'floor_color':[1,1,1]},"
             "'materials':{'own':%s},"
             "'root':{'id':'r','type':'sphere','material':'own',"
             "'params':{'radius':0.7}}}",
             lights, floor ? "true" : "false", material);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

#define MATERIAL(shader, properties) "{'shader':'" shader "','properties':{" properties "}}"
#define LAMP "{'type':'directional','intensity':2,'direction':[0.3,-1,-0.2]}"

static double value(const struct image *image, int x, int y, int channel)
{
    return (double)((const float *)image->pixels)[4 * (y * WIDTH + x) + channel];
}

/* As bright as its surroundings, whatever its colours are: it cannot be seen. */
static void assert_unseen(const char *material)
{
    struct image image = draw(material, "", false);

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int c = 0; c < 3; c++) {
            const double got = value(&image, i % WIDTH, i / WIDTH, c);
            if (!(fabs(got - 1) < 0.02)) {
                fail_msg("%s: %g in a white room, at %d, %d", material, got, i % WIDTH, i / WIDTH);
            }
        }
    }
    image_finish(&image);
}

static void clear_things_cannot_be_seen_in_a_white_room(void **state)
{
    (void)state;
    assert_unseen(MATERIAL("phong", "'diffuse':[0,0,0],'opacity':0"));
    assert_unseen(MATERIAL("blinn", "'diffuse':[0,0,0],'opacity':0,'ior':1"));
    assert_unseen(MATERIAL("phong", "'diffuse':[1,0,0],'opacity':0,'reflectivity':0.1"));
    assert_unseen(MATERIAL("checker", "'color1':[0,0,1],'color2':[0,0,0],'opacity':0,'scale':0.2"));
    assert_unseen(MATERIAL("standard", "'base_color':[1,1,1],'transmission':1,"
                                       "'roughness':0"));
}

/* Nor does their colour fall on the floor. */
static void light_through_phong_keeps_its_colour(void **state)
{
    struct image black =
        draw(MATERIAL("phong", "'specular':[0,0,0],'diffuse':[0,0,0],'opacity':0"), LAMP, true);
    struct image red =
        draw(MATERIAL("phong", "'specular':[0,0,0],'diffuse':[1,0,0],'opacity':0"), LAMP, true);

    (void)state;
    assert_true(drawing_is_same(&black, &red));
    for (int i = 0; i < WIDTH * HEIGHT; i++) { /* nothing in the scene has a colour */
        const double r = value(&red, i % WIDTH, i / WIDTH, 0);
        assert_true(fabs(r - value(&red, i % WIDTH, i / WIDTH, 1)) < 0.01 * r + 1e-3);
    }
    image_finish(&black);
    image_finish(&red);
}

/* Green and blue of white light that goes through the middle of the ball. */
static double left_of(const char *material)
{
    struct image image = draw(material, "", false);
    const double left = value(&image, WIDTH / 2, HEIGHT / 2, 1);

    assert_true(value(&image, WIDTH / 2, HEIGHT / 2, 0) > 0.9);
    image_finish(&image);
    return left;
}

static void what_dyes_is_what_the_reference_says(void **state)
{
    (void)state;
    /* The standard colour once, where light enters; else what is inside, by its way of 1.4. */
    const double once =
        left_of(MATERIAL("standard", "'base_color':[1,0.5,0.5],'transmission':1,'roughness':0,"
                                     "'ior':1"));
    assert_true(fabs(once - 0.5) < 0.01);
    const double inside =
        left_of(MATERIAL("phong", "'opacity':0,'ior':1,'attenuation_color':[1,0.5,0.5],"
                                  "'attenuation_distance':1.4"));
    assert_true(fabs(inside - 0.5) < 0.01);
}

/* --- glass that is none --- */

#define BALL(r, x, y, z)                                                                           \
    "{'type':'sphere','material':'own','params':{'radius':" #r "},'transform':{'translation':[" #x \
    "," #y "," #z "]}},"
#define BLOCK(a, b, c, x, y, z)                                                                    \
    "{'type':'box','material':'own','params':{'size':[" #a "," #b "," #c                           \
    "]},'transform':{'translation':[" #x "," #y "," #z "]}},"

/* Things on a floor at -0.7, each with a comma behind. */
static const struct {
    const char *name, *text;
} arrangements[] = {
    {"touches the floor", BALL(0.7, 0, 0, 0)},
    {"hardly touches it", BALL(0.7, 0, 0.003, 0)},
    {"overlaps it", BALL(0.7, 0, -0.1, 0)},
    {"is almost under it", BALL(0.7, 0, -0.5, 0)},
    {"two touch", BALL(0.7, -0.7, 0, 0) BALL(0.7, 0.7, 0, 0)},
    {"one on another", BALL(0.4, 0, -0.3, 0) BALL(0.4, 0, 0.5, 0)},
    {"block on the floor", BLOCK(1, 1, 1, 0, -0.2, 0)},
    {"block in the floor", BLOCK(1, 1, 1, 0, -0.3, 0)},
    {"row of small ones", BALL(0.05, -0.36, -0.65, 0) BALL(0.05, -0.24, -0.65, 0)
                              BALL(0.05, -0.12, -0.65, 0) BALL(0.05, 0, -0.65, 0)},
    {"around a solid", BALL(0.5, 0.9, -0.4, -1)},
};

static const char *const views[] = {
    "'position':[0,1,3.4],'target':[0,-0.2,0]",
    "'position':[0,-0.4,3.4],'target':[0,-0.5,0]",
    "'position':[0,4,1],'target':[0,-0.5,0]",
    "'position':[0,6,20],'target':[0,-0.5,0],'fov':8",
    "'type':'orthographic','height':2.4,'position':[0,1,3.4],'target':[0,-0.2,0]",
};

/* On a floor with two solid balls, in the light of the sun and of a lamp. */
static struct image draw_things(const char *things, const char *material, const char *view,
                                int width, int height)
{
    char text[2400];

    snprintf(
        text, sizeof text,
        "{'format':'fieldcast/1','camera':{%s},'lights':[" LAMP
        ",{'type':'point','intensity':4,'position':[1,2.5,1]}],"
        "'render':{'antialiasing':'none','ray_depth':8},"
        "'environment':{'type':'sky','floor':true,'floor_height':-0.7},"
        "'materials':{'own':%s,'red':" MATERIAL(
            "phong", "'diffuse':[0.8,0.1,0.1]") "},"
                                                "'root':{'type':'group','children':[%s"
                                                "{'type':'sphere','material':'red',"
                                                "'params':{'radius':0.25},"
                                                "'transform':{'translation':[0.9,-0.4,-1]}},"
                                                "{'type':'sphere','material':'red',"
                                                "'params':{'radius':0.2},"
                                                "'transform':{'translation':[0,-0.3,-0.2]}}]}}",
        view, material, things);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(width, height);
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

/* The picture is that without it, within 0.01 of a white of 1. In the corner of glass and floor,
 * narrower than a hundredth of a pixel, the floor's normal may be that of both: one pixel, and one
 * of 4000, may be off by up to 0.2. */
static void assert_none_seen(const struct image *with, const struct image *without,
                             const char *things, const char *view)
{
    const float *a = with->pixels, *b = without->pixels;
    const int pixels = with->width * with->height;
    int off = 0;
    double most = 0;

    for (int i = 0; i < pixels; i++) {
        double apart = 0;
        for (int c = 0; c < 3; c++) {
            apart = fmax(apart, fabs((double)a[4 * i + c] - (double)b[4 * i + c]));
        }
        off += !(apart <= 0.01);
        most = fmax(most, apart);
    }
    if (off > 1 + pixels / 4000 || !(most <= 0.2)) {
        fail_msg("%s, %d x %d, %s: %d pixels are off, by up to %g", things, with->width,
                 with->height, view, off, most);
    }
}

static void glass_of_index_one_is_invisible(void **state)
{
    static const char *const materials[] = {
        MATERIAL("phong", "'diffuse':[1,1,1],'specular':[0,0,0],'opacity':0,'ior':1"),
        MATERIAL("standard", "'base_color':[1,1,1],'transmission':1,'roughness':0,'ior':1")};
    static const int widths[] = {32, 64, 160};
    const size_t count = sizeof arrangements / sizeof arrangements[0];
    const size_t view_count = sizeof views / sizeof views[0];

    (void)state;
    for (size_t v = 0; v < view_count * 3; v++) {
        const char *view = views[v % view_count];
        const int width = widths[v / view_count];
        struct image without = draw_things("", materials[0], view, width, width * 3 / 4);
        for (size_t i = 0; i < count; i++) {
            struct image with = draw_things(arrangements[i].text, materials[(i + v) % 2], view,
                                            width, width * 3 / 4);
            assert_none_seen(&with, &without, arrangements[i].name, view);
            image_finish(&with);
        }
        image_finish(&without);
    }
}

/* --- cuts --- */

/* `operation` of a ball and a half space, seen from the front; materials `clear` and `red`. */
static struct image draw_cut(const char *body, const char *tool, const char *plane)
{
    char text[1600];

    snprintf(
        text, sizeof text,
        "{'format':'fieldcast/1','camera':{'position':[0,1.5,3],'target':[0,-0.1,0]},"
        "'lights':[{'type':'directional','intensity':3,'direction':[0,-1,0]}],"
        "'render':{'antialiasing':'none','ray_depth':8,'occlusion':false},"
        "'environment':{'type':'solid','color':[0.5,0.5,0.5],'floor':true,"
        "'floor_height':-0.8,'floor_color':[1,1,1]},"
        "'materials':{'clear':" MATERIAL(
            "phong", "'opacity':0,'ior':1.01") ","
                                               "'red':" MATERIAL(
                                                   "phong",
                                                   "'diffuse':[0.8,0,0]") "},"
                                                                          "'root':{'id':'r',"
                                                                          "'type':'intersection',"
                                                                          "'children':["
                                                                          "{'id':'a','type':"
                                                                          "'sphere','material':'%"
                                                                          "s','params':{'radius':"
                                                                          "0.7}},"
                                                                          "{'id':'b','type':"
                                                                          "'plane','material':'%"
                                                                          "s','params':{%s}}]}}",
        body, tool, plane);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

#define BACK "'normal':[0,0,-1],'offset':0.2"
#define TOP "'normal':[0,1,0],'offset':0.3"

static double redness(const struct image *image, int x, int y)
{
    return value(image, x, y, 0) / fmax(value(image, x, y, 1), 1e-3);
}

static void a_solid_cut_is_seen_from_inside(void **state)
{
    struct image image = draw_cut("clear", "red", BACK);
    const double red = redness(&image, WIDTH / 2, HEIGHT / 2);

    (void)state;
    if (!(red > 3)) {
        fail_msg("red is %g times green, through glass with a red back", red);
    }
    image_finish(&image);
    image = draw_cut("clear", "clear", BACK);
    assert_true(redness(&image, WIDTH / 2, HEIGHT / 2) < 1.1);
    image_finish(&image);
}

static void what_glass_cuts_out_of_a_solid_is_solid(void **state)
{
    struct image image = draw_cut("red", "clear", TOP);

    /* The face on top has the glass' own colour, 0.8, and all of the light. */
    const double green = value(&image, WIDTH / 2, 18, 1), want = 0.8 * (3 / M_PI + 0.5);

    (void)state;
    if (!(fabs(green - want) < 0.1 * want)) {
        fail_msg("%g instead of %g", green, want);
    }
    image_finish(&image);
}

/* On the floor in front of the ball, in its shadow: light comes straight down. */
static void a_solid_cut_throws_a_shadow(void **state)
{
    struct image clear = draw_cut("clear", "clear", TOP), solid = draw_cut("clear", "red", TOP);
    int darker = 0, red = 0;

    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        darker +=
            value(&solid, x, y, 0) < 0.7 * value(&clear, x, y, 0) && redness(&solid, x, y) < 1.2;
        red += redness(&solid, x, y) > 3;
    }
    print_message("%d places of the floor are darker, %d are red\n", darker, red);
    assert_true(darker > 60 && red > 60);
    image_finish(&clear);
    image_finish(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clear_things_cannot_be_seen_in_a_white_room),
        cmocka_unit_test(light_through_phong_keeps_its_colour),
        cmocka_unit_test(what_dyes_is_what_the_reference_says),
        cmocka_unit_test(glass_of_index_one_is_invisible),
        cmocka_unit_test(a_solid_cut_is_seen_from_inside),
        cmocka_unit_test(what_glass_cuts_out_of_a_solid_is_solid),
        cmocka_unit_test(a_solid_cut_throws_a_shadow),
    };

    return cmocka_run_group_tests_name("transmission", tests, start, end);
}
