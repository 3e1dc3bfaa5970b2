/* SPDX-License-Identifier: MIT */
/* Cuts a file into texts. */
#include "code_blocks.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "text_file.h"

struct code_blocks code_blocks_read(const char *path)
{
    struct code_blocks blocks = {.whole = text_file_read(path, NULL)};
    struct code_block *row = NULL;
    int line = 1;

    for (char *at = blocks.whole, *next; *at; at = next, line++) {
        char *end = strchr(at, '\n');
        next = end ? end + 1 : at + strlen(at);
        if (strncmp(at, "//! ", 4) == 0 && end) {
            blocks.rows = memory_resize(blocks.rows, blocks.count + 1, sizeof *row);
            row = &blocks.rows[blocks.count++];
            *row = (struct code_block){at + 4, next, line};
            *at = *end = '\0'; /* ends the text before it, too */
        }
    }
    return blocks;
}

void code_blocks_finish(struct code_blocks *blocks)
{
    free(blocks->rows);
    free(blocks->whole);
    *blocks = (struct code_blocks){0};
}
