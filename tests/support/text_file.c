/* SPDX-License-Identifier: MIT */
/* Whole files as text. */
#include "text_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

char *text_file_read(const char *path, size_t *out_length)
{
    FILE *file = fopen(path, "rb");

    if (!file) {
        fail_msg("%s cannot be read: tests run in the root of the repository", path);
    }
    char *text = NULL;
    size_t length = 0, count;
    do {
        text = realloc(text, length + 65536 + 1);
        assert_non_null(text);
        count = fread(text + length, 1, 65536, file);
        length += count;
    } while (count > 0);
    fclose(file);
    text[length] = '\0';
    if (out_length) {
        *out_length = length;
    }
    return text;
}
