/* SPDX-License-Identifier: MIT */
#include "decode.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

bool image_decode(const uint8_t *bytes, size_t length, struct decoded *out, struct error *err)
{
    struct asset_info info;
    struct decoded decoded;
    bool ok;

    if (!asset_inspect(bytes, length, &info, err)) {
        return false;
    }
    decoded =
        (struct decoded){info.width, info.height,
                         memory_alloc((size_t)info.width * (size_t)info.height, 3 * sizeof(float))};
    ok = strcmp(info.type, "image/png") == 0
             ? png_decode(bytes, length, &decoded, err)
             : hdr_decode(bytes + info.head, length - info.head, &decoded, err);
    if (!ok) {
        decoded_finish(&decoded);
        return false;
    }
    *out = decoded;
    return true;
}

void decoded_finish(struct decoded *decoded)
{
    free(decoded->rgb);
    *decoded = (struct decoded){0};
}
