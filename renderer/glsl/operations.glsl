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

/* In one but not in the other. */
float op_exclusive(float a, float b)
{
    return max(min(a, b), -max(a, b));
}

/* Share of b in that. */
float op_exclusive_share(float a, float b)
{
    return (a + b >= 0.0 ? b < a : b > a) ? 1.0 : 0.0;
}

/* Between the two. */
float op_morph(float a, float b, float t)
{
    return mix(a, b, t);
}

/* Share of b in that. */
float op_morph_share(float a, float b, float t)
{
    return t;
}

#define KERNEL_CUBIC 1
#define KERNEL_QUARTIC 2
#define KERNEL_CIRCULAR 3
#define KERNEL_EXPONENTIAL 4
#define KERNEL_ROOT 5
#define KERNEL_POWER 6
#define KERNEL_POLYNOMIAL 7

/* How far below the lesser of two distances their blend is, where they are x apart. The kernel is a
 * literal wherever this is called, so that one line stays of it. */
float blend_depth(float x, float k, int kernel, float order)
{
    float h = max(k - x, 0.0) / k, y = 1.0 - h;
    return kernel == KERNEL_CUBIC         ? k * h * h * h / 6.0
           : kernel == KERNEL_QUARTIC     ? k * h * h * h * h * 0.125
           : kernel == KERNEL_CIRCULAR    ? k * (1.0 - 0.5 * (y + sqrt(2.0 - y * y)))
           : kernel == KERNEL_EXPONENTIAL ? log2(1.0 + exp2(-k * x)) / k
           : kernel == KERNEL_ROOT        ? 0.5 * k / (sqrt(x * x + k) + x)
           : kernel == KERNEL_POLYNOMIAL  ? k * pow(h, order) / (2.0 * order)
                                          : k * h * h * 0.25;
}

/* The derivative of the blend by the greater of the two. */
float blend_greater(float x, float k, int kernel, float order)
{
    float h = max(k - x, 0.0) / k, y = 1.0 - h, root = sqrt(x * x + k);
    return kernel == KERNEL_CUBIC         ? 0.5 * h * h
           : kernel == KERNEL_QUARTIC     ? 0.5 * h * h * h
           : kernel == KERNEL_CIRCULAR    ? 0.5 - 0.5 * y / sqrt(2.0 - y * y)
           : kernel == KERNEL_EXPONENTIAL ? 1.0 / (1.0 + exp2(k * x))
           : kernel == KERNEL_ROOT        ? 0.5 * k / (root * (root + x))
           : kernel == KERNEL_POLYNOMIAL  ? 0.5 * pow(h, order - 1.0)
                                          : 0.5 * h;
}

/* The lesser by the greater of two distances, both above 0. */
float power_ratio(float lower, float upper)
{
    return max(lower, 1e-30) / max(upper, 1e-30);
}

/* The smooth minimum. */
float smin(float a, float b, float k, int kernel, float order)
{
    float lower = min(a, b), upper = max(a, b);
    if (kernel == KERNEL_POWER) {
        float part = exp2(k * log2(power_ratio(lower, upper)));
        return lower > 0.0 ? lower * exp2(-log2(1.0 + part) / k) : lower;
    }
    return lower - blend_depth(upper - lower, k, kernel, order);
}

/* Share of b in the smooth minimum: its derivative by b, by the sum of both. */
float smin_share(float a, float b, float k, int kernel, float order)
{
    float lower = min(a, b), upper = max(a, b);
    float greater = blend_greater(upper - lower, k, kernel, order);
    if (kernel == KERNEL_POWER) {
        float share = exp2((k + 1.0) * log2(power_ratio(lower, upper)));
        greater = lower > 0.0 ? share / (1.0 + share) : 0.0;
    }
    return b < a ? 1.0 - greater : greater;
}

/* In either, blended where the distances are near each other. */
float op_smooth_union(float a, float b, float k, int kernel, float order)
{
    return smin(a, b, k, kernel, order);
}

/* Share of b in the smooth union. */
float op_smooth_union_share(float a, float b, float k, int kernel, float order)
{
    return smin_share(a, b, k, kernel, order);
}

/* In both, blended. */
float op_smooth_intersection(float a, float b, float k, int kernel, float order)
{
    return -smin(-a, -b, k, kernel, order);
}

/* Share of b in the smooth intersection. */
float op_smooth_intersection_share(float a, float b, float k, int kernel, float order)
{
    return smin_share(-a, -b, k, kernel, order);
}

/* In a but not in b, blended. */
float op_smooth_difference(float a, float b, float k, int kernel, float order)
{
    return -smin(-a, b, k, kernel, order);
}

/* Share of b in the smooth difference. */
float op_smooth_difference_share(float a, float b, float k, int kernel, float order)
{
    return smin_share(-a, b, k, kernel, order);
}
