/* SPDX-License-Identifier: MIT */
/* A request of a picture: the same from a query, from JSON and from options, and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/nodes.h"
#include "protocol/render_request.h"
#include "renderer/renderer.h"
#include "tests/support/json_text.h"

struct member {
    const char *name, *text;
};

static const struct member members[] = {
    {"width", "320"},
    {"height", "200"},
    {"region", "1,2,30,40"},
    {"aov", "depth,color"},
    {"level", "final"},
    {"samples", "2"},
    {"transparent", "on"},
    {"quality", "70"},
    {"camera.fov", "50.5"},
    {"camera.up", "0,0,1"},
    {"camera.type", "orthographic"},
    {"section.normal", "0,0,-2"},
    {"section.offset", "0.25"},
};

static void read_texts(struct render_request *out, enum request_form form, char separator)
{
    struct error err = {0};

    render_request_init(out);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        char name[32];

        snprintf(name, sizeof name, "%s", members[i].name);
        if (strchr(name, '.')) {
            *strchr(name, '.') = separator;
        }
        assert_true(render_request_set_text(out, form, name, members[i].text, &err));
    }
    assert_true(render_request_check(out, form, &err));
}

static bool read_json(struct render_request *out, const char *text, struct error *err)
{
    cJSON *json = json_text_parse(text, err);

    assert_non_null(json);
    render_request_init(out);
    const bool ok =
        render_request_read(out, json, err) && render_request_check(out, REQUEST_JSON, err);
    cJSON_Delete(json);
    return ok;
}

static void every_form_says_the_same(void **state)
{
    struct render_request query, option, json, copy;
    struct error err = {0};

    (void)state;
    read_texts(&query, REQUEST_QUERY, '.');
    read_texts(&option, REQUEST_OPTION, '-');
    assert_true(read_json(&json,
                          "{'width':320,'height':200,'region':[1,2,30,40],'aov':'color,depth',"
                          "'level':'final','samples':2,'transparent':true,'quality':70,"
                          "'camera':{'fov':50.5,'up':[0,0,1],'type':'orthographic'},"
                          "'section':{'normal':[0,0,-2],'offset':0.25}}",
                          &err));
    assert_true(render_request_equal(&query, &option));
    assert_true(render_request_equal(&query, &json));
    render_request_copy(&copy, &query);
    assert_true(render_request_equal(&query, &copy));
    record_put(&copy.camera, "fov", 51);
    assert_false(render_request_equal(&query, &copy));
    record_put(&copy.camera, "fov", 50.5);
    assert_true(render_request_equal(&query, &copy));
    record_put(&copy.section, "offset", 0.5);
    assert_false(render_request_equal(&query, &copy));
    render_request_finish(&query);
    render_request_finish(&option);
    render_request_finish(&json);
    render_request_finish(&copy);
}

/* Every member has a text above, so none can be left out of what follows. */
static void no_member_is_left_out(void **state)
{
    (void)state;
    for (const struct param *param = picture_type.params; param->name; param++) {
        size_t i = 0;

        while (i < sizeof members / sizeof *members && strcmp(members[i].name, param->name) != 0) {
            i++;
        }
        if (i == sizeof members / sizeof *members) {
            fail_msg("nothing is asked of %s", param->name);
        }
    }
}

static void what_is_printed_is_read(void **state)
{
    struct render_request sent, got;
    struct error err = {0};

    (void)state;
    read_texts(&sent, REQUEST_QUERY, '.');
    sent.codec = CODEC_JPEG;
    record_put(&sent.delivery, "fast", true);
    cJSON *ids = json_text_parse("['b','a','b']", &err), *printed;
    assert_true(id_set_read(&sent.isolate, ids, LIMIT_ISOLATED, "", &err));
    assert_int_equal(sent.isolate.count, 2);
    printed = render_request_print(&sent);
    render_request_init(&got);
    assert_true(render_request_unpack(&got, printed, &err));
    assert_true(render_request_equal(&sent, &got));
    cJSON_Delete(ids);
    cJSON_Delete(printed);
    render_request_finish(&sent);
    render_request_finish(&got);
}

/* Each member of a request changes what is drawn or how it is encoded. */
static void every_member_reaches_the_renderer(void **state)
{
    struct render_request usual;

    (void)state;
    render_request_init(&usual);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        struct render_request asked;
        struct error err = {0};

        if (strncmp(members[i].name, "camera", 6) == 0) {
            continue;
        }
        render_request_init(&asked);
        assert_true(
            render_request_set_text(&asked, REQUEST_QUERY, members[i].name, members[i].text, &err));
        const struct job_desc job = job_desc_of(&asked), usual_job = job_desc_of(&usual);
        const struct encode_params file = encode_params_of(&asked),
                                   usual_file = encode_params_of(&usual);
        if (memcmp(&job, &usual_job, sizeof job) == 0 &&
            memcmp(&file, &usual_file, sizeof file) == 0) {
            fail_msg("%s changes nothing", members[i].name);
        }
        render_request_finish(&asked);
    }
    render_request_finish(&usual);
}

static void check_refused(enum request_form form, const char *name, const char *text,
                          const char *place)
{
    struct render_request request;
    struct error err = {0};

    render_request_init(&request);
    assert_false(render_request_set_text(&request, form, name, text, &err) &&
                 render_request_check(&request, form, &err));
    assert_string_equal(err.place, place);
    render_request_finish(&request);
}

static void errors_name_the_place_in_its_form(void **state)
{
    struct render_request request;
    struct error err = {0};

    (void)state;
    check_refused(REQUEST_QUERY, "samples", "9", "?samples");
    check_refused(REQUEST_QUERY, "camera.fov", "wide", "?camera.fov");
    check_refused(REQUEST_QUERY, "fov", "40", "?fov");
    check_refused(REQUEST_QUERY, "region", "0,0,0,4", "?region");
    check_refused(REQUEST_QUERY, "region", "0,0,1.5,4", "?region");
    check_refused(REQUEST_OPTION, "camera-fov", "500", "--camera-fov");
    check_refused(REQUEST_OPTION, "aov", "smell", "--aov");
    check_refused(REQUEST_QUERY, "exact", "true", "?exact"); /* a delivery is nobody's to ask */
    assert_false(read_json(&request, "{'camera':{'fov':500}}", &err));
    assert_string_equal(err.place, "/camera/fov");
    render_request_finish(&request);
    check_refused(REQUEST_QUERY, "section.normal", "0,0,0", "?section.normal");
    check_refused(REQUEST_QUERY, "section.normal", "1,0", "?section.normal");
    check_refused(REQUEST_OPTION, "section-offset", "1e9", "--section-offset");
    check_refused(REQUEST_QUERY, "offset", "1", "?offset");
    assert_false(read_json(&request, "{'section':{'normal':[0,0,0]}}", &err));
    assert_string_equal(err.place, "/section/normal");
    assert_non_null(strstr(err.message, "0, 0, 0 has no direction"));
    render_request_finish(&request);
    assert_false(read_json(&request, "{'section':{'side':1}}", &err));
    assert_string_equal(err.place, "/section/side");
    render_request_finish(&request);
    assert_false(read_json(&request, "{'format':'hdr','aov':'color,normal'}", &err));
    assert_string_equal(err.place, "/aov");
    render_request_finish(&request);
    assert_false(read_json(&request, "{'delivery':{}}", &err));
    assert_string_equal(err.place, "/delivery");
    render_request_finish(&request);
}

/* A camera changes the scene's, member by member. */
static void a_camera_is_seen_from_the_scenes(void **state)
{
    struct render_request request;
    struct record scene;
    struct error err = {0};

    (void)state;
    record_init(&scene, &camera_type);
    record_put(&scene, "fov", 30);
    render_request_init(&request);
    render_request_see_from(&request, &scene);
    assert_true(record_is_empty(&request.camera)); /* it is the scene's as it is */
    assert_true(render_request_set_text(&request, REQUEST_QUERY, "camera.up", "0,0,1", &err));
    render_request_see_from(&request, &scene);
    assert_true(record_number(&request.camera, "fov") == 30);
    assert_true(record_vector(&request.camera, "up")[2] == 1);
    render_request_finish(&request);
    record_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_says_the_same),
        cmocka_unit_test(no_member_is_left_out),
        cmocka_unit_test(what_is_printed_is_read),
        cmocka_unit_test(every_member_reaches_the_renderer),
        cmocka_unit_test(errors_name_the_place_in_its_form),
        cmocka_unit_test(a_camera_is_seen_from_the_scenes),
    };

    return cmocka_run_group_tests_name("render_request", tests, NULL, NULL);
}
