/* SPDX-License-Identifier: MIT */
/* Whole files as text. Tests run in the root of the repository. */
#ifndef TESTS_SUPPORT_TEXT_FILE_H
#define TESTS_SUPPORT_TEXT_FILE_H

#include <stddef.h>

/* Fails the test where the file cannot be read. Ends with a NUL that `*out_length` (may be NULL)
 * does not count. Caller frees. */
char *text_file_read(const char *path, size_t *out_length);

#endif
