/* SPDX-License-Identifier: MIT */
/* Leaving shapes out of the field. */

/* Empty space is this far away. */
const float FAR = 1e9;

/* Which shapes map() and surface() see. 0: all; FAR: those that light goes through are away; -FAR:
 * those that it does not go through are. */
float field_mask = 0.0;

/* Whether shapes that know but a lower bound of their distance give an estimate of it instead: what
 * comes near a ray is judged by that, steps are by the bound. */
bool field_estimates = false;

/* The distance of a shape that may be away; `transmissive` and `away` are the last numbers of its
 * head. */
float masked(float d, float transmissive, float away)
{
    return d + max(transmissive * field_mask, away);
}

/* A distance that may be no number, which does not matter where it is away. */
float unless_away(float d, float away)
{
    return away > 0.0 ? 0.0 : d;
}

/* What two distances make, or one of them alone: -1 the first, 1 the second. */
float sided(float d, float a, float b, float side)
{
    return side == 0.0 ? d : side > 0.0 ? b : a;
}

/* The share of the second in that. */
float sided_share(float share, float side)
{
    return side == 0.0 ? share : max(side, 0.0);
}
