/* SPDX-License-Identifier: MIT */
/* The digest of a file's content, which is its name. */
#ifndef SERVER_DIGEST_H
#define SERVER_DIGEST_H

#include <stddef.h>

#include "protocol/asset.h"

/* SHA-256 as small hexadecimal digits with a NUL. */
void digest_text(const void *bytes, size_t length, char out[ASSET_ID_CHARACTERS + 1]);

#endif
