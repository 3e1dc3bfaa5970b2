/* SPDX-License-Identifier: MIT */
/* UTF-8 by the table of RFC 3629, section 4. */
#include "utf8.h"

/* Bytes of the sequence that begins with `first`, 0: none does; the range of its second byte. */
static size_t begin(unsigned char first, unsigned char *low, unsigned char *high)
{
    /* No overlong forms, no surrogates, nothing above U+10FFFF. */
    *low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    *high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (first < 0x80) {
        return 1;
    }
    if (first < 0xc2 || first > 0xf4) {
        return 0;
    }
    return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

size_t utf8_sequence(const char *text, size_t left)
{
    const unsigned char *s = (const unsigned char *)text;
    unsigned char low, high;
    const size_t count = begin(s[0], &low, &high);

    for (size_t i = 1; i < count; i++) {
        if (i >= left || s[i] < low || s[i] > high) {
            return 0;
        }
        low = 0x80;
        high = 0xbf;
    }
    return count;
}

bool utf8_feed(struct utf8_stream *stream, const char *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)bytes[i];

        if (stream->left == 0) {
            const size_t count = begin(c, &stream->low, &stream->high);

            if (count == 0) {
                return false;
            }
            stream->left = (unsigned char)(count - 1);
        } else if (c < stream->low || c > stream->high) {
            return false;
        } else {
            stream->left--;
            stream->low = 0x80;
            stream->high = 0xbf;
        }
    }
    return true;
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
