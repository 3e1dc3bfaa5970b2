/* SPDX-License-Identifier: MIT */
/* UTF-8 by the table of RFC 3629, section 4. */
#include "utf8.h"

size_t utf8_sequence(const char *text, size_t left)
{
    const unsigned char *s = (const unsigned char *)text;
    unsigned char low = 0x80, high = 0xbf; /* of the second byte */
    size_t count;
    if (s[0] < 0x80) {
        return 1;
    }
    if (s[0] >= 0xc2 && s[0] <= 0xdf) {
        count = 2;
    } else if (s[0] >= 0xe0 && s[0] <= 0xef) {
        count = 3;
        low = s[0] == 0xe0 ? 0xa0 : low;   /* no overlong forms */
        high = s[0] == 0xed ? 0x9f : high; /* no surrogates */
    } else if (s[0] >= 0xf0 && s[0] <= 0xf4) {
        count = 4;
        low = s[0] == 0xf0 ? 0x90 : low;
        high = s[0] == 0xf4 ? 0x8f : high; /* nothing above U+10FFFF */
    } else {
        return 0;
    }
    for (size_t i = 1; i < count; i++) {
        if (i >= left || s[i] < low || s[i] > high) {
            return 0;
        }
        low = 0x80;
        high = 0xbf;
    }
    return count;
}

size_t utf8_put(char out[4], unsigned long code)
{
    const size_t count = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    static const unsigned char first[] = {0, 0, 0xc0, 0xe0, 0xf0};

    for (size_t i = count - 1; i > 0; i--) {
        out[i] = (char)(0x80 | (code & 0x3f));
        code >>= 6;
    }
    out[0] = (char)(first[count] | code);
    return count;
}
