/* SPDX-License-Identifier: MIT */
/* What is UTF-8 and what only looks like it. */
#ifndef PROTOCOL_UTF8_H
#define PROTOCOL_UTF8_H

#include <stddef.h>

/* Bytes of the sequence at `text`, of which `left` > 0 bytes are there; 0: not UTF-8. */
size_t utf8_sequence(const char *text, size_t left);
/* Writes the sequence of a character that is no surrogate; how many bytes. */
size_t utf8_put(char out[4], unsigned long code);

#endif
