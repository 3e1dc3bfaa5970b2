/* SPDX-License-Identifier: MIT */
/* The name of a file by what is in it. */
#ifndef SERVER_DIGEST_H
#define SERVER_DIGEST_H

#include <stddef.h>

#include "protocol/asset.h"

/* SHA-256 in hexadecimal digits. */
void digest_text(const void *bytes, size_t length, char out[ASSET_ID_CHARACTERS + 1]);

#endif
