/* SPDX-License-Identifier: MIT */
/* What volumes do to light, as numbers: pictures as light against closed forms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

enum { WIDTH = 32, HEIGHT = 24 };

static struct renderer *renderer;

static int set_up(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* Seen from z = 5, from above where that is said, or along z. One colour around, which lights
 * nothing where `ambient` is 0. */
static const char *const perspective = "'position':[0,0,5],'target':[0,0,0],'fov':40";
static const char *const along_z =
    "'type':'orthographic','position':[0,0,5],'target':[0,0,0],'height':2";
static const char *const along_y = "'type':'orthographic','position':[0,5,0],'target':[0,0,"
                                   "0],'up':[0,0,-1],'height':2";

struct setting {
    const char *camera, *volumes, *children, *lights, *render;
    double around, ambient;
};

static struct image draw(const struct setting *s)
{
    char text[4400];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','camera':{%s},'volumes':[%s],'lights':[%s],"
             "'render':{'antialiasing':'none'%s},"
             "'environment':{'type':'solid','color':[%g,%g,%g],'intensity':%g},"
             "'root':{'type':'union','children':[%s]}}",
             s->camera, s->volumes, s->lights ? s->lights : "", s->render ? s->render : "",
             s->around, s->around, s->around, s->ambient, s->children ? s->children : "");
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.as_floats = true;
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

static double red(const struct image *image, int x, int y)
{
    return ((const float *)image->pixels)[4 * (y * WIDTH + x)];
}

static void assert_near(double value, double expected, double part, const char *what, int x, int y)
{
    if (!(fabs(value - expected) <= part * fabs(expected) + 1e-3)) {
        fail_msg("%s at %d, %d: %g, expected %g", what, x, y, value, expected);
    }
}

/* The direction of a pixel's ray of `perspective`. */
static void pixel_ray(int x, int y, double out[3])
{
    const double tall = tan(20 * M_PI / 180);
    const double d[3] = {(2 * (x + 0.5) / WIDTH - 1) * tall * WIDTH / HEIGHT,
                         (1 - 2 * (y + 0.5) / HEIGHT) * tall, -1};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);

    for (int i = 0; i < 3; i++) {
        out[i] = d[i] / length;
    }
}

/* How long the ray from z = 5 is within a box, or within a ball where `sizes[1]` is 0. */
static double way_inside(const double d[3], const double centre[3], const double sizes[3])
{
    double enter = 0, leave = 1e9;

    for (int i = 0; i < 3; i++) {
        const double from = (i == 2 ? 5 : 0) - centre[i];
        const double a = (-sizes[i] / 2 - from) / d[i], b = (sizes[i] / 2 - from) / d[i];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    if (sizes[1] == 0) {
        const double from[3] = {-centre[0], -centre[1], 5 - centre[2]};
        const double b = from[0] * d[0] + from[1] * d[1] + from[2] * d[2];
        const double c = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
        const double root = b * b - c + sizes[0] * sizes[0];
        return root > 0 ? 2 * sqrt(root) : 0;
    }
    return fmax(leave - enter, 0);
}

/* The same within an ellipsoid: a ball, in lengths of its radii. */
static double way_in_egg(const double d[3], const double centre[3], const double radii[3])
{
    double a = 0, b = 0, c = -1;

    for (int i = 0; i < 3; i++) {
        const double way = d[i] / radii[i], from = ((i == 2 ? 5 : 0) - centre[i]) / radii[i];
        a += way * way;
        b += way * from;
        c += from * from;
    }
    return b * b > a * c ? 2 * sqrt(b * b - a * c) / a : 0;
}

#define PLAIN "'source':'constant','falloff':0,"
#define BLACK PLAIN "'color':[0,0,0],"
#define A_BOX "{'type':'box'," BLACK "'density':0.8}"
#define A_BALL "{'type':'sphere'," BLACK "'density':2,'position':[0.3,0.2,-1]}"
#define AN_EGG                                                                                     \
    "{'type':'ellipsoid'," BLACK "'density':2,'position':[0.3,0.2,-1],'radii':[0.6,1.1,1.7]}"
#define TWO_BOXES                                                                                  \
    "{'type':'box'," BLACK "'density':0.5},"                                                       \
    "{'type':'box'," BLACK "'density':1.5,'size':[1,3,1],'position':[0.4,0,0.8]}"

static void what_is_let_through(void **state)
{
    (void)state;
    static const double middle[3] = {0}, ball[3] = {0.3, 0.2, -1}, other[3] = {0.4, 0, 0.8};
    static const double box_size[3] = {2, 2, 2}, radius[3] = {1}, tall[3] = {1, 3, 1};

    static const struct {
        const char *volumes;
        const double *centres[2], *sizes[2];
        double density[2];
    } cases[] = {
        {A_BOX, {middle, middle}, {box_size, box_size}, {0.8, 0}},
        {A_BALL, {ball, ball}, {radius, radius}, {2, 0}},
        {A_BOX "," A_BALL, {middle, ball}, {box_size, radius}, {0.8, 2}},
        {TWO_BOXES, {middle, other}, {box_size, tall}, {0.5, 1.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct image image = draw(
            &(struct setting){.camera = perspective, .volumes = cases[i].volumes, .around = 1});
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                double d[3], depth = 0;
                pixel_ray(x, y, d);
                for (int k = 0; k < 2; k++) {
                    depth +=
                        cases[i].density[k] * way_inside(d, cases[i].centres[k], cases[i].sizes[k]);
                }
                assert_near(red(&image, x, y), exp(-depth), 0.01, cases[i].volumes, x, y);
            }
        }
        image_finish(&image);
    }
}

static void an_egg_lets_through_what_a_stretched_ball_does(void **state)
{
    (void)state;
    static const double centre[3] = {0.3, 0.2, -1}, radii[3] = {0.6, 1.1, 1.7};
    int inside = 0;
    struct image image =
        draw(&(struct setting){.camera = perspective, .volumes = AN_EGG, .around = 1});

    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double d[3];
            pixel_ray(x, y, d);
            const double way = way_in_egg(d, centre, radii);
            assert_near(red(&image, x, y), exp(-2 * way), 0.01, "an egg", x, y);
            inside += way > 0;
        }
    }
    image_finish(&image);
    assert_true(inside > 30);
}

/* Seen along z through its middle: the density grows over the falloff, from either end. */
static void density_grows_from_the_rim_of_an_egg(void **state)
{
    (void)state;
    static const char *const shapes[] = {"'type':'sphere','radius':8",
                                         "'type':'ellipsoid','radii':[8,8,8]",
                                         "'type':'ellipsoid','radii':[30,50,8]"};
    double found[3];

    for (int i = 0; i < 3; i++) {
        char volume[300];
        snprintf(volume, sizeof volume,
                 "{%s,'source':'constant','falloff':2,'color':[0,0,0],"
                 "'position':[0,0,-10],'density':0.1}",
                 shapes[i]);
        struct image image = draw(&(struct setting){
            .camera = along_z, .volumes = volume, .around = 1, .render = ",'level':'final'"});
        found[i] = red(&image, WIDTH / 2, HEIGHT / 2);
        image_finish(&image);
    }
    /* smoothstep is a half on average over its way */
    assert_near(found[0], exp(-0.1 * (16 - 2)), 0.02, "a ball", 0, 0);
    assert_near(found[1], found[0], 1e-4, "three radii alike", 0, 0);
    assert_near(found[2], found[0], 0.02, "a flat one", 0, 0);
}

static void emission_and_absorption(void **state)
{
    (void)state;
    struct image image = draw(
        &(struct setting){.camera = perspective,
                          .volumes = "{'type':'box'," BLACK "'density':0.7,'emission':[1.5,0,0]}"});

    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double d[3];
            pixel_ray(x, y, d);
            const double way = way_inside(d, (double[3]){0}, (double[3]){2, 2, 2});
            assert_near(red(&image, x, y), 1.5 * (1 - exp(-0.7 * way)), 0.01, "emission", x, y);
        }
    }
    image_finish(&image);
}

/* All pixels but those near the rim of the picture. */
static void assert_all(const struct setting *s, double expected, double part, const char *what)
{
    struct image image = draw(s);

    for (int y = 2; y < HEIGHT - 2; y++) {
        for (int x = 2; x < WIDTH - 2; x++) {
            assert_near(red(&image, x, y), expected, part, what, x, y);
        }
    }
    image_finish(&image);
}

#define LAMP(direction) "{'type':'directional','intensity':3,'direction':" direction "}"
/* 2 thick, endless to the sides. */
#define SLAB(more) "{'type':'box'," PLAIN "'density':0.6,'size':[90,90,2]" more "}"

/* Henyey and Greenstein's, times pi: in the unit of lamps. */
static double phase(double cosine, double g)
{
    return (1 - g * g) / (4 * pow(1 + g * g - 2 * g * cosine, 1.5));
}

static void light_scattered_once(void **state)
{
    (void)state;
    const double depth = 0.6 * 2, back = (1 - exp(-2 * depth)) / 2, forth = depth * exp(-depth);

    assert_all(&(struct setting){.camera = along_z,
                                 .volumes = SLAB(",'color':[0.5,0,0]"),
                                 .lights = LAMP("[0,0,-1]")},
               3 * 0.5 * phase(-1, 0) * back, 0.01, "lit from the eye");
    assert_all(&(struct setting){.camera = along_z,
                                 .volumes = SLAB(",'color':[1,1,1],'anisotropy':0.4"),
                                 .lights = LAMP("[0,0,-1]")},
               3 * phase(-1, 0.4) * back, 0.01, "lit from the eye, forwards");
    assert_all(&(struct setting){.camera = along_z,
                                 .volumes = SLAB(",'color':[1,1,1],'anisotropy':0.4"),
                                 .lights = LAMP("[0,0,1]")},
               3 * phase(1, 0.4) * forth, 0.01, "lit from behind, forwards");
    assert_all(
        &(struct setting){
            .camera = along_z, .volumes = SLAB(",'color':[1,1,1]"), .around = 1, .ambient = 1},
        1, 0.01, "white smoke in a white furnace");
}

static void what_is_behind_a_wall_is_not_there(void **state)
{
    (void)state;
    static const char wall[] = "{'type':'box','params':{'size':[9,9,0.2]},"
                               "'transform':{'translation':[0,0,2]}}";
    struct image with = draw(&(struct setting){
        .camera = perspective, .volumes = TWO_BOXES, .children = wall, .lights = LAMP("[0,0,-1]")});
    struct image without = draw(&(struct setting){
        .camera = perspective, .volumes = "", .children = wall, .lights = LAMP("[0,0,-1]")});

    assert_true(red(&with, 9, 9) > 0.1);
    assert_true(drawing_is_same(&with, &without));
    image_finish(&with);
    image_finish(&without);

    static const char inside[] = "{'type':'box','params':{'size':[9,9,1]},"
                                 "'transform':{'translation':[0,0,-0.5]}}";
    assert_all(&(struct setting){.camera = along_z,
                                 .volumes = SLAB(",'color':[0,0,0],'emission':[2,2,2]"),
                                 .children = inside},
               2 * (1 - exp(-0.6)), 0.01, "a wall in the middle");
}

static void order_does_not_matter(void **state)
{
    (void)state;
    static const char *const volumes[] = {
        "{'id':'a','type':'sphere','density':3,'position':[-1,0,1],'seed':4}",
        "{'id':'b','type':'box','density':2,'position':[0.8,0,-1],'size':[1,1,1]}"};
    struct image images[2];

    for (int i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text, "%s,%s", volumes[i], volumes[1 - i]);
        images[i] = draw(&(struct setting){
            .camera = perspective, .volumes = text, .lights = LAMP("[-1,-1,-1]"), .around = 0.2});
    }
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            assert_near(red(&images[1], x, y), red(&images[0], x, y), 1e-3, "order", x, y);
        }
    }
    image_finish(&images[0]);
    image_finish(&images[1]);
}

/* Light from the side, and a wall that keeps it from the lower half. */
static void the_scene_throws_shadows(void **state)
{
    (void)state;
    static const char wall[] = "{'type':'box','params':{'size':[0.2,4,9]},"
                               "'transform':{'translation':[2.5,-2,0]}}";
    struct setting s = {.camera = along_z,
                        .volumes = "{'type':'box'," PLAIN "'density':0.02,'color':[1,1,1]}",
                        .children = wall,
                        .lights = "{'type':'directional','intensity':50,"
                                  "'direction':[-1,0,0],'size':40}"};
    const double lit = 50 * phase(0, 0) * (1 - exp(-0.02 * 2));
    struct image image = draw(&s);

    assert_near(red(&image, WIDTH / 2, HEIGHT / 4), lit, 0.05, "light", WIDTH / 2, HEIGHT / 4);
    assert_near(red(&image, WIDTH / 2, 3 * HEIGHT / 4), 0, 0, "shadow", WIDTH / 2, 3 * HEIGHT / 4);
    image_finish(&image);
    s.render = ",'shadows':false";
    image = draw(&s);
    assert_near(red(&image, WIDTH / 2, 3 * HEIGHT / 4), lit, 0.05, "off", WIDTH / 2,
                3 * HEIGHT / 4);
    image_finish(&image);
}

/* Light that comes low over a floor, beside which steps are short: the part that is scattered at a
 * place is dimmed by the smoke on its way, of which none may be left out. Along z all is alike. */
static void smoke_close_to_a_floor_dims_as_elsewhere(void **state)
{
    (void)state;
    static const double density = 0.6, up = 0.2;
    const double across = sqrt(1 - up * up), all = 1 - exp(-density * 4);
    struct image image = draw(&(struct setting){
        .camera = "'type':'orthographic','position':[0,-0.75,5],'target':[0,-0.75,0],"
                  "'height':0.1",
        .volumes = "{'type':'box'," PLAIN "'density':0.6,'color':[1,1,1],"
                   "'position':[4,0,0],'size':[16,1.6,4]}",
        .children = "{'type':'plane','params':{'offset':-0.8}}",
        .lights = "{'type':'directional','intensity':30,'shadow':'hard',"
                  "'direction':[-0.9797958971,-0.2,0]}"});

    for (int y = 0; y < HEIGHT - 1; y++) { /* the last row may be the floor */
        const double height = -0.75 + 0.1 * (0.5 - (y + 0.5) / HEIGHT);
        const double way = fmin((0.8 - height) / up, 12 / across);
        assert_near(red(&image, WIDTH / 2, y), 30 * phase(0, 0) * all * exp(-density * way), 0.02,
                    "light", WIDTH / 2, y);
    }
    image_finish(&image);
}

/* A floor seen from above, in light straight down through smoke that is not in sight. */
static void smoke_throws_shadows(void **state)
{
    (void)state;
    static const char lamp[] = "{'type':'directional','intensity':3,"
                               "'direction':[0,-1,0]}";
    struct setting s = {
        .camera = along_y, .volumes = "", .children = "{'type':'plane'}", .lights = lamp};
    struct image clear = draw(&s);

    s.volumes = "{'type':'box'," BLACK "'density':0.5,'size':[1,2,1],"
                "'position':[0.5,7,0]}";
    struct image dim = draw(&s);
    for (int y = 7; y < HEIGHT - 7; y++) {
        assert_near(red(&dim, WIDTH / 2 + 6, y), red(&clear, WIDTH / 2 + 6, y) * exp(-1), 0.01,
                    "shade", WIDTH / 2 + 6, y);
        assert_true(red(&dim, 2, y) == red(&clear, 2, y) && red(&dim, 2, y) > 0.5);
    }
    image_finish(&clear);
    image_finish(&dim);
    s.render = ",'shadows':false";
    dim = draw(&s);
    s.volumes = "";
    clear = draw(&s);
    assert_true(drawing_is_same(&dim, &clear));
    image_finish(&clear);
    image_finish(&dim);
}

static double mean_of(const struct setting *s)
{
    struct image image = draw(s);
    double sum = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        sum += red(&image, i % WIDTH, i / WIDTH);
    }
    image_finish(&image);
    return sum / (WIDTH * HEIGHT);
}

/* Above a plane the density falls by e for each 0.2. */
static void density_by_field(void **state)
{
    (void)state;
    const double depth = 4 * 0.2 * (1 - exp(-1.5 / 0.2));
    const double mean = mean_of(
        &(struct setting){.camera = along_y,
                          .volumes = "{'type':'box','size':[9,3,9],'source':'field','reach':0.2,"
                                     "'falloff':0,'density':4,'color':[0,0,0],'emission':[1,1,1]}",
                          .children = "{'type':'plane'}"});

    assert_near(mean, 1 - exp(-depth), 0.01, "field", 0, 0);
}

static void noise_fills_its_part(void **state)
{
    (void)state;
    static const double parts[] = {0, 0.2, 0.5, 0.8, 1};

    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        char volume[300];
        int filled = 0;
        snprintf(volume, sizeof volume,
                 "{'type':'box','size':[90,90,0.0005],'density':1000,'frequency':40,"
                 "'falloff':0,'color':[0,0,0],'cover':%g}",
                 parts[i]);
        struct image image =
            draw(&(struct setting){.camera = along_z, .volumes = volume, .around = 1});
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            filled += red(&image, k % WIDTH, k / WIDTH) < 0.998;
        }
        image_finish(&image);
        const double found = (double)filled / (WIDTH * HEIGHT);
        if (fabs(found - parts[i]) > 0.06 * (parts[i] > 0 && parts[i] < 1)) {
            fail_msg("%g of space is filled, expected %g", found, parts[i]);
        }
    }
}

/* As many as there may be, at the highest level: drivers that count iterations of loops must not
 * end one before all volumes are through. */
static void many_volumes_and_lights(void **state)
{
    (void)state;
    char volumes[1600] = "", lights[1600] = "";

    for (int i = 0; i < LIMIT_VOLUMES; i++) {
        const size_t used = strlen(volumes);
        snprintf(volumes + used, sizeof volumes - used,
                 "%s{'type':'box','size':[9,9,%d],'position':[0,0,%d],'falloff':0,"
                 "'cover':1,'octaves':6,'color':[0,0,0],'density':0.05}",
                 i ? "," : "", 1 + i % 2, i / 2 - 2);
    }
    for (int i = 0; i < LIMIT_LIGHTS; i++) {
        const size_t used = strlen(lights);
        snprintf(lights + used, sizeof lights - used, "%s{'type':'point','position':[0,%d,3]}",
                 i ? "," : "", i);
    }
    assert_all(&(struct setting){.camera = along_z,
                                 .volumes = volumes,
                                 .lights = lights,
                                 .around = 1,
                                 .render = ",'level':'final'"},
               exp(-0.05 * 12), 0.01, "eight volumes, sixteen lights");
}

/* Only the first volume of a scene makes a program; numbers make none. */
static void numbers_compile_nothing(void **state)
{
    (void)state;
    static const char *const edits[] = {"[{'op':'insert','into':'/volumes','before':null,"
                                        "'value':{'id':'a','type':'box','emission':[1,1,1]}}]",
                                        "[{'op':'set','at':'/volumes/a/source','value':'field'},"
                                        "{'op':'set','at':'/volumes/a/type','value':'sphere'}]",
                                        "[{'op':'insert','into':'/volumes','before':null,"
                                        "'value':{'type':'box','position':[1,0,0]}}]"};
    struct scene *scene = drawing_parse("{'format':'fieldcast/1','root':{'type':'torus'}}");

    renderer_use_stage(renderer, RENDER_COMPUTE);
    struct resident *resident = resident_create(renderer, scene, 1);
    const struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image before = drawing_of(resident, &desc, AOV_COLOR);
    for (int i = 0; i < 3; i++) {
        const uint64_t compiled = renderer_counters(renderer).compilations;
        cJSON *ops = json_text_parse(edits[i], NULL);
        assert_true(resident_edit(resident, ops, (uint64_t)i + 2, NULL));
        cJSON_Delete(ops);
        struct image after = drawing_of(resident, &desc, AOV_COLOR);
        assert_false(drawing_is_same(&before, &after));
        assert_int_equal(renderer_counters(renderer).compilations > compiled, i == 0);
        image_finish(&before);
        before = after;
    }
    image_finish(&before);
    resident_destroy(resident);
    renderer_use_stage(renderer, RENDER_AUTO);
}

/* Along the sides of boxes, on them, and through the middle of balls. */
static void numbers_stay_numbers(void **state)
{
    (void)state;
    static const struct {
        const char *place;
        int height; /* 24: whole pixels, of which some are on the side of the third box */
    } views[] = {{"[1,0,5]", 2}, {"[1,1,5]", 2}, {"[0,0,0]", 2}, {"[1,1,1]", 2}, {"[0,0,5]", 24}};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        char camera[200];
        snprintf(camera, sizeof camera,
                 "'type':'orthographic','height':%d,'position':%s,"
                 "'target':[%.1s,%.1s,-9]",
                 views[i].height, views[i].place, views[i].place + 1, views[i].place + 3);
        struct image image = draw(
            &(struct setting){.camera = camera,
                              .volumes = TWO_BOXES ",{'type':'box','size':[3,3,3]},"
                                                   "{'type':'sphere','density':1000}",
                              .lights = LAMP("[0,0,-1]") "," LAMP("[0,-1,0]") ",{'type':'point',"
                                                                              "'position':[0,0,0]}",
                              .around = 1,
                              .ambient = 1});
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            assert_true(isfinite(red(&image, k % WIDTH, k / WIDTH)));
        }
        image_finish(&image);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_let_through),
        cmocka_unit_test(an_egg_lets_through_what_a_stretched_ball_does),
        cmocka_unit_test(density_grows_from_the_rim_of_an_egg),
        cmocka_unit_test(emission_and_absorption),
        cmocka_unit_test(light_scattered_once),
        cmocka_unit_test(what_is_behind_a_wall_is_not_there),
        cmocka_unit_test(order_does_not_matter),
        cmocka_unit_test(the_scene_throws_shadows),
        cmocka_unit_test(smoke_close_to_a_floor_dims_as_elsewhere),
        cmocka_unit_test(smoke_throws_shadows),
        cmocka_unit_test(density_by_field),
        cmocka_unit_test(noise_fills_its_part),
        cmocka_unit_test(many_volumes_and_lights),
        cmocka_unit_test(numbers_compile_nothing),
        cmocka_unit_test(numbers_stay_numbers),
    };

    return cmocka_run_group_tests_name("volumes", tests, set_up, tear_down);
}
