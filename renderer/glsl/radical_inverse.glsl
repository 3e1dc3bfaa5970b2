/* SPDX-License-Identifier: MIT */

/* The bits of i, mirrored behind the point: van der Corput's sequence. Neither GLSL 3.30 nor GLSL
 * ES 3.00 has bitfieldReverse(). */
float radical_inverse(int i)
{
    uint x = uint(i);
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return float(x << 16 | x >> 16) * 2.3283064365386963e-10;
}
