/* SPDX-License-Identifier: MIT */
/* Looks up embedded files. */
#include "embedded.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "protocol/memory.h"

enum { GZIP = 16 + MAX_WBITS }; /* for inflateInit2 */

/* The last four bytes of gzip are the length, the lowest first (RFC 1952, 2.3.1). */
static size_t unpacked_length(const struct embedded *file)
{
    const unsigned char *end = file->bytes + file->length;

    return end[-4] | (size_t)end[-3] << 8 | (size_t)end[-2] << 16 | (size_t)end[-1] << 24;
}

void *embedded_unpack(const struct embedded *file, size_t *out_length)
{
    const size_t length = unpacked_length(file);
    unsigned char *bytes = memory_alloc(length + 1, 1);
    z_stream stream = {.next_in = (unsigned char *)file->bytes,
                       .avail_in = (unsigned)file->length,
                       .next_out = bytes,
                       .avail_out = (unsigned)length + 1};

    if (inflateInit2(&stream, GZIP) != Z_OK || inflate(&stream, Z_FINISH) != Z_STREAM_END) {
        abort(); /* the bytes are our own: there was no memory */
    }
    inflateEnd(&stream);
    *out_length = length;
    return bytes;
}

static const struct embedded *find(const struct embedded *table, size_t count, const char *path)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(table[i].path, path) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

const struct embedded *page_find(const char *path)
{
    return find(page_table, page_count, path);
}

const struct embedded *examples_find(const char *id)
{
    return find(examples_table, examples_count, id);
}

const struct embedded *example_files_find(const char *id)
{
    return find(example_files_table, example_files_count, id);
}

const struct embedded *cards_find(const char *id)
{
    return find(cards_table, cards_count, id);
}

const struct embedded *templates_find(const char *name)
{
    return find(templates_table, templates_count, name);
}

const struct embedded *references_find(const char *type)
{
    return find(references_table, references_count, type);
}
