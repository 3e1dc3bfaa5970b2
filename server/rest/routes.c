/* SPDX-License-Identifier: MIT */
#include "routes.h"

static const struct route table[] = {
    {"GET", "/v1/scenes", scenes_list, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/scenes", scenes_create, BODY_JSON, GUARDED, SCENE_NEW},
    {"POST", "/v1/import", scenes_import, BODY_JSON, GUARDED, SCENE_NEW},
    {"GET", "/v1/scenes/{}", scenes_read, BODY_NONE, GUARDED, SCENE_NAMED},
    {"PUT", "/v1/scenes/{}", scenes_replace, BODY_JSON, GUARDED, SCENE_NAMED},
    {"PATCH", "/v1/scenes/{}", scenes_edit, BODY_JSON, GUARDED, SCENE_NAMED},
    {"DELETE", "/v1/scenes/{}", scenes_delete, BODY_NONE, GUARDED, SCENE_NAMED},
    {"GET", "/v1/scenes/{}/live", scenes_live, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/scenes/{}/poster.jpg", scenes_poster, BODY_NONE, GUARDED, SCENE_NEW},
    {"GET", "/v1/scenes/{}/equations", equations_judge, BODY_NONE, GUARDED, SCENE_JUDGED},
    {"GET", "/v1/scenes/{}/image.{}", images_of_scene, BODY_NONE, GUARDED, SCENE_NAMED},
    {"GET", "/v1/assets", assets_list, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/assets", assets_create, BODY_FILE, GUARDED, SCENE_ALL},
    {"GET", "/v1/assets/{}", assets_read, BODY_NONE, GUARDED, SCENE_NEW},
    {"DELETE", "/v1/assets/{}", assets_delete, BODY_NONE, GUARDED, SCENE_ALL},
    {"GET", "/v1/library", library_list, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/library", library_import, BODY_JSON, GUARDED, SCENE_NEW},
    {"GET", "/v1/library.json", library_export, BODY_NONE, GUARDED, SCENE_NEW},
    {"GET", "/v1/library/{}", library_read, BODY_NONE, GUARDED, SCENE_NONE},
    {"PUT", "/v1/library/{}", library_put, BODY_JSON, GUARDED, SCENE_NEW},
    {"DELETE", "/v1/library/{}", library_delete, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/library/{}/picture.png", images_of_entry, BODY_NONE, GUARDED, SCENE_NEW},
    {"POST", "/v1/render", images_render, BODY_JSON, GUARDED, SCENE_NEW},
    {"GET", "/v1/queue", images_queue, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/implicitize", equations_implicitize, BODY_QUESTION, GUARDED, SCENE_NEW},
    {"GET", "/v1/implicitize/{}", implicitize_look, BODY_NONE, GUARDED, SCENE_NONE},
    {"DELETE", "/v1/implicitize/{}", implicitize_cancel, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/verify", equations_verify, BODY_QUESTION, GUARDED, SCENE_NEW},
    {"POST", "/v1/typeset", equations_typeset, BODY_QUESTION, GUARDED, SCENE_NEW},
    {"POST", "/v1/groebner", groebner_begin, BODY_QUESTION, GUARDED, SCENE_NEW},
    {"GET", "/v1/groebner/{}", groebner_look, BODY_NONE, GUARDED, SCENE_NONE},
    {"DELETE", "/v1/groebner/{}", groebner_cancel, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples", site_examples, BODY_NONE, GUARDED, SCENE_NEW},
    {"GET", "/v1/examples/{}", site_example, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples/{}/card.jpg", site_card, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples/{}/image.{}", images_of_example, BODY_NONE, GUARDED, SCENE_NEW},
    {"GET", "/v1/reference/{}.jpg", site_reference, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/schema.json", site_schema, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/metrics", site_metrics, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/healthz", site_health, BODY_NONE, OPEN, SCENE_NONE},
    {"GET", "/readyz", site_ready, BODY_NONE, OPEN, SCENE_NONE},
    {"GET", "/", site_app, BODY_NONE, PAGE, SCENE_NONE},
    {"GET", "/s/{}", site_app, BODY_NONE, PAGE, SCENE_NONE},
};

/* Everything else that can be read is a file of the page. */
static const struct route asset_route = {"GET", "", site_asset, BODY_NONE, OPEN, SCENE_NONE};

const struct route_table routes = {table, sizeof table / sizeof *table, &asset_route};
