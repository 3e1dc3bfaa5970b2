/* SPDX-License-Identifier: MIT */
/* A request as the parameters of a job and of its file: the one place that translates it. */
#include "renderer.h"

struct job_desc job_desc_of(const struct render_request *request)
{
    const struct record *picture = &request->picture;
    const double *region = record_vector(picture, "region");
    struct job_desc desc = {
        .width = render_request_int(request, "width"),
        .height = render_request_int(request, "height"),
        .region = {(int)region[0], (int)region[1], (int)region[2], (int)region[3]},
        .camera = record_is_empty(&request->camera) ? NULL : &request->camera,
        .section = record_is_empty(&request->section) ? NULL : &request->section,
        .level = record_is_set(picture, "level") ? render_request_int(request, "level") : -1,
        .samples = render_request_int(request, "samples"),
        .transparent =
            record_is_set(picture, "transparent") ? render_request_int(request, "transparent") : -1,
        .exact = render_request_is(request, "exact"),
        .in_rounds = render_request_is(request, "in_rounds"),
        .sparse = render_request_is(request, "sparse"),
        .as_floats = codec_is_raw(request->codec),
        .raw_depth = render_request_is(request, "depths"),
        .isolated = (const char *const *)request->isolate.ids,
        .isolated_count = request->isolate.count,
    };

    render_request_outputs(request, desc.aovs);
    return desc;
}

struct encode_params encode_params_of(const struct render_request *request)
{
    return (struct encode_params){
        .format = request->codec,
        .quality = render_request_int(request, "quality"),
        .chroma_halved = render_request_is(request, "chroma_halved"),
        .fast = render_request_is(request, "fast"),
        .zipped = render_request_is(request, "zipped"),
        .whole = render_request_is(request, "whole"),
    };
}
