/* SPDX-License-Identifier: MIT */
/* Files that scenes name by their SHA-256. This module reads only a file's first bytes. The rest is
 * read by the render process alone (renderer/image/decode.h). */
#ifndef PROTOCOL_ASSET_H
#define PROTOCOL_ASSET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "error.h"

enum { ASSET_ID_CHARACTERS = 64 }; /* small hexadecimal digits */

struct asset_info {
    const char *type; /* "image/png" or "image/vnd.radiance" */
    int width, height;
    size_t head; /* bytes before the pixels of a Radiance file; else 0 */
};

/* False and `err` where the file is none of these, or larger than limits.h allows. */
bool asset_inspect(const uint8_t *bytes, size_t length, struct asset_info *out, struct error *err);

#endif
