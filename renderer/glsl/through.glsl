/* SPDX-License-Identifier: MIT */
/* Leaving shapes out of the field. */

/* Empty space is this far away. */
const float FAR = 1e9;

/* Which shapes map() and surface() see. 0: all; FAR: those that light goes through are away; -FAR:
 * those that it does not go through are. */
float through = 0.0;

/* The distance of a shape that may be away; `clear` is the fourth number of its head. */
float hidden(float d, float clear)
{
    return d + max(clear * through, 0.0);
}
