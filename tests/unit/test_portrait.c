/* SPDX-License-Identifier: MIT */
/* Portraits: whatever a part is, its picture is filled by it and shows all of it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/draw/camera.h"
#include "renderer/field/field.h"
#include "renderer/portrait.h"
#include "tests/support/json_text.h"

enum { WIDTH = 120, HEIGHT = 80 };

struct extent {
    int left, right, top, bottom; /* first and last pixel that shows something */
    int count;
};

static struct scene *portrait_of(const char *root, struct error *err)
{
    char text[1024];

    snprintf(text, sizeof text, "{'format':'fieldcast/1','root':%s}", root);
    cJSON *document = json_text_parse(text, err);
    struct scene *scene = portrait_scene(document, err);
    cJSON_Delete(document);
    return scene;
}

static struct extent look(const struct scene *scene)
{
    struct field *field = field_compile(scene, NULL);
    const struct camera camera = camera_from_record(&scene->camera, WIDTH, HEIGHT);
    const double most = record_number(&scene->render, "max_distance");
    struct extent extent = {WIDTH, -1, HEIGHT, -1, 0};

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        double origin[3], direction[3];

        camera_ray(&camera, WIDTH, HEIGHT, x + 0.5, y + 0.5, origin, direction);
        if (field_march(field, origin, direction, most, 1e-4) >= 0) {
            extent.left = x < extent.left ? x : extent.left;
            extent.right = x > extent.right ? x : extent.right;
            extent.top = y < extent.top ? y : extent.top;
            extent.bottom = y > extent.bottom ? y : extent.bottom;
            extent.count++;
        }
    }
    field_unref(field);
    return extent;
}

/* All of it is in the picture, and in one direction it takes most of that. */
static void assert_framed(const char *root)
{
    struct error err = {0};
    struct scene *scene = portrait_of(root, &err);

    assert_non_null(scene);
    const struct extent extent = look(scene);
    const double wide = (extent.right - extent.left + 1.0) / WIDTH;
    const double high = (extent.bottom - extent.top + 1.0) / HEIGHT;
    if (extent.left < 1 || extent.top < 1 || extent.right > WIDTH - 2 ||
        extent.bottom > HEIGHT - 2 || fmax(wide, high) < 0.72) {
        fail_msg("%s: x %d to %d, y %d to %d", root, extent.left, extent.right, extent.top,
                 extent.bottom);
    }
    scene_destroy(scene);
}

static void shapes_fill_their_picture(void **state)
{
    (void)state;
    assert_framed("{'type':'sphere'}");
    assert_framed("{'type':'sphere','params':{'radius':0.01}}");
    assert_framed("{'type':'sphere','params':{'radius':5000}}");
    assert_framed("{'type':'box','params':{'size':[40,0.2,0.2]},"
                  "'transform':{'translation':[300,5,-70],'rotation':[0,0.4,1]}}");
    assert_framed("{'type':'torus'}");
}

/* Its box is much larger than what is left in it. */
static void a_small_rest_fills_its_picture(void **state)
{
    (void)state;
    assert_framed("{'type':'intersection','children':[{'type':'sphere','params':{'radius':3}},"
                  "{'type':'sphere','params':{'radius':3},"
                  "'transform':{'translation':[5.6,0,0]}}]}");
}

static void what_has_no_end_is_cut(void **state)
{
    (void)state;
    assert_framed("{'type':'plane'}");
    assert_framed("{'type':'union','children':[{'type':'plane'},{'type':'sphere',"
                  "'transform':{'translation':[9,1,0]}}]}");
    assert_framed("{'type':'gyroid'}");
}

static void what_shows_nothing_is_refused(void **state)
{
    struct error err = {0};

    (void)state;
    assert_null(portrait_of("{'type':'union'}", &err));
    assert_int_equal(err.kind, ERROR_INVALID);
    assert_string_equal(err.place, "/root");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_fill_their_picture),
        cmocka_unit_test(a_small_rest_fills_its_picture),
        cmocka_unit_test(what_has_no_end_is_cut),
        cmocka_unit_test(what_shows_nothing_is_refused),
    };

    return cmocka_run_group_tests_name("portraits", tests, NULL, NULL);
}
