/* SPDX-License-Identifier: MIT */
#include "digest.h"

#include <nettle/sha2.h>
#include <stdio.h>

void digest_text(const void *bytes, size_t length, char out[ASSET_ID_CHARACTERS + 1])
{
    struct sha256_ctx state;
    uint8_t digest[SHA256_DIGEST_SIZE];

    sha256_init(&state);
    sha256_update(&state, length, bytes);
    sha256_digest(&state, sizeof digest, digest);
    for (size_t i = 0; i < sizeof digest; i++) {
        snprintf(out + 2 * i, 3, "%02x", digest[i]);
    }
}
