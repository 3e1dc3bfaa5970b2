/* SPDX-License-Identifier: MIT */
#include "decode.h"

#include <stdlib.h>
#include <string.h>

#include "shrink.h"

bool image_decode(const uint8_t *bytes, size_t length, void (*between)(void), struct decoded *out,
                  struct error *err)
{
    struct asset_info info;
    struct shrink shrink;
    bool ok;

    if (!asset_inspect(bytes, length, &info, err)) {
        return false;
    }
    shrink_init(&shrink, info.width, info.height);
    shrink.between = between;
    ok = strcmp(info.type, "image/png") == 0
             ? png_decode(bytes, length, &shrink, err)
             : hdr_decode(bytes + info.head, length - info.head, &shrink, err);
    if (ok) {
        *out = shrink_take(&shrink);
    }
    shrink_finish(&shrink);
    return ok;
}

void decoded_finish(struct decoded *decoded)
{
    free(decoded->rgba);
    *decoded = (struct decoded){0};
}
