/* SPDX-License-Identifier: MIT */
#include "pair.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "json_text.h"

struct pair pair_of(const char *root, const char *more)
{
    struct error err = {0};
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out, "{'format':'fieldcast/1',%s'root':%s}", more, root);
    fclose(out);
    struct pair pair = {.scene = json_text_scene(text, &err)};
    pair.field = pair.scene ? field_compile(pair.scene, &err) : NULL;
    if (!pair.field) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
    free(text);
    return pair;
}

void pair_finish(struct pair *pair)
{
    field_unref(pair->field);
    scene_destroy(pair->scene);
}
