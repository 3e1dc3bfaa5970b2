/* SPDX-License-Identifier: MIT */
/* The table of routes: method, path, handler. */
#ifndef SERVER_ROUTES_H
#define SERVER_ROUTES_H

#include "protocol/record.h"
#include "server/net/route.h"

extern const struct route_table routes;

/* The handlers. The word before the underscore names their file. */
void scenes_list(struct request *request);
void scenes_create(struct request *request);
void scenes_import(struct request *request);
void scenes_read(struct request *request);
void scenes_replace(struct request *request);
void scenes_edit(struct request *request);
void scenes_delete(struct request *request);
void scenes_live(struct request *request);
void scenes_poster(struct request *request);
void assets_list(struct request *request);
void assets_create(struct request *request);
void assets_read(struct request *request);
void assets_delete(struct request *request);
void library_list(struct request *request);
void library_export(struct request *request);
void library_import(struct request *request);
void library_read(struct request *request);
void library_put(struct request *request);
void library_delete(struct request *request);
void images_of_scene(struct request *request);
void images_of_example(struct request *request);
void images_of_entry(struct request *request);
void images_render(struct request *request);
void images_queue(struct request *request);
void equations_implicitize(struct request *request);
void equations_verify(struct request *request);
void equations_judge(struct request *request);
void equations_typeset(struct request *request);
/* Replies with the id of a question of the algebra, at /v1/ROAD/ID; copies `asked`. */
void question_begin(struct request *request, const char *road, const struct record *asked);
void implicitize_look(struct request *request);
void implicitize_cancel(struct request *request);
void groebner_begin(struct request *request);
void groebner_look(struct request *request);
void groebner_cancel(struct request *request);
void site_app(struct request *request);
void site_asset(struct request *request);
void site_examples(struct request *request);
void site_example(struct request *request);
void site_card(struct request *request);
void site_reference(struct request *request);
void site_schema(struct request *request);
void site_health(struct request *request);
void site_ready(struct request *request);
void site_metrics(struct request *request);

#endif
