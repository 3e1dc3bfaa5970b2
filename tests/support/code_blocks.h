/* SPDX-License-Identifier: MIT */
/* Files of tests/code: texts one after the other, each behind a line `//! HEAD`. */
#ifndef TESTS_SUPPORT_CODE_BLOCKS_H
#define TESTS_SUPPORT_CODE_BLOCKS_H

#include <stddef.h>

struct code_block {
    char *head, *text;
    int line; /* of the head, in the file */
};

struct code_blocks {
    char *whole;
    struct code_block *rows;
    size_t count;
};

/* Fails the test where the file cannot be read. */
struct code_blocks code_blocks_read(const char *path);
void code_blocks_finish(struct code_blocks *blocks);

#endif
