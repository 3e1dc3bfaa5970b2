/* SPDX-License-Identifier: MIT */
/* Operations: each NAME combines two distances, each NAME_share tells how much of the result the
 * second operand is. How surfaces mix stands in mixture.glsl. */

/* In either. */
float op_union(float a, float b)
{
    return min(a, b);
}

/* Share of b in the union. */
float op_union_share(float a, float b)
{
    return b < a ? 1.0 : 0.0;
}

/* In both. */
float op_intersection(float a, float b)
{
    return max(a, b);
}

/* Share of b in the intersection. */
float op_intersection_share(float a, float b)
{
    return b > a ? 1.0 : 0.0;
}

/* In a but not in b. */
float op_difference(float a, float b)
{
    return max(a, -b);
}

/* Share of b in the difference. */
float op_difference_share(float a, float b)
{
    return -b > a ? 1.0 : 0.0;
}

/* In either, blended where the distances differ by less than k. */
float op_smooth_union(float a, float b, float k, int kernel)
{
    float h = max(k - abs(a - b), 0.0);
    return min(a, b) - h * h * 0.25 / k;
}

/* Share of b in the smooth union: its derivative by b. */
float op_smooth_union_share(float a, float b, float k, int kernel)
{
    float h = 0.5 * max(k - abs(a - b), 0.0) / k;
    return b < a ? 1.0 - h : h;
}

/* In both, blended. */
float op_smooth_intersection(float a, float b, float k, int kernel)
{
    return -op_smooth_union(-a, -b, k, kernel);
}

/* Share of b in the smooth intersection. */
float op_smooth_intersection_share(float a, float b, float k, int kernel)
{
    return op_smooth_union_share(-a, -b, k, kernel);
}

/* In a but not in b, blended. */
float op_smooth_difference(float a, float b, float k, int kernel)
{
    return -op_smooth_union(-a, b, k, kernel);
}

/* Share of b in the smooth difference. */
float op_smooth_difference_share(float a, float b, float k, int kernel)
{
    return op_smooth_union_share(-a, b, k, kernel);
}
