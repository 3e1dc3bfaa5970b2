/* SPDX-License-Identifier: MIT */
/* Distance functions of primitives; in C they are in renderer/sdf/shapes.c. */

/* The point in a node's own space: three rows of (x, y, z, translation). */
vec3 local(vec3 p, vec4 x, vec4 y, vec4 z)
{
    return vec3(dot(x.xyz, p) + x.w, dot(y.xyz, p) + y.w, dot(z.xyz, p) + z.w);
}

/* Distance to the intersection of two half-spaces at right angles. */
float corner(float a, float b)
{
    return min(max(a, b), 0.0) + length(max(vec2(a, b), 0.0));
}

/* A ball. */
float sd_sphere(vec3 p, float radius)
{
    return length(p) - radius;
}

/* A cuboid of full lengths `size`. */
float sd_box(vec3 p, vec3 size)
{
    vec3 q = abs(p) - size * 0.5;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

/* A ball with three radii: the greater of two bounds, of which the box is not near the surface. */
float sd_ellipsoid(vec3 p, vec3 radii)
{
    float smallest = min(radii.x, min(radii.y, radii.z));
    return max((length(p / radii) - 1.0) * smallest, sd_box(p, 2.0 * radii) - smallest / 16.0);
}

/* A cuboid whose rounding lies inside `size`; radius at most half of the least length. */
float sd_round_box(vec3 p, vec3 size, float radius)
{
    return sd_box(p, size - 2.0 * radius) - radius;
}

/* Bars along the edges of a cuboid: outside to each kind of bar, inside to sides and openings. */
float sd_box_frame(vec3 p, vec3 size, float thickness)
{
    vec3 q = abs(p) - 0.5 * size, along = max(q, 0.0);
    vec3 across = max(max(q, -thickness - q), 0.0);
    vec3 openings =
        mix(max(q + thickness, 0.0), vec3(1e9), lessThanEqual(0.5 * size, vec3(thickness)));
    float outside = min(length(vec3(along.x, across.yz)),
                        min(length(vec3(along.y, across.xz)), length(vec3(along.z, across.xy))));
    float depth = min(length(openings.xy), min(length(openings.yz), length(openings.zx)));
    return outside > 0.0 ? outside : max(max(q.x, max(q.y, q.z)), -depth);
}

/* The discs around (radius, 0) and (-radius, 0), for x >= 0; behind x = 0 is where they meet. */
float disc_pair(float x, float y, float radius, float tube)
{
    float from = length(vec2(x - radius, y));
    float meet = sqrt(max((tube - radius) * (tube + radius), 0.0));
    return radius * from < tube * (radius - x) ? -length(vec2(x, abs(y) - meet)) : from - tube;
}

/* A ring around Y. */
float sd_torus(vec3 p, float radius, float tube)
{
    return disc_pair(length(p.xz), p.y, radius, tube);
}

/* A part of a ring around Z by one of its ends: inside to the tube, and where it meets itself. */
float sd_capped_torus(vec3 p, float end_x, float tube, float end_y)
{
    vec2 q = vec2(abs(p.x), p.y), end = vec2(end_x, end_y);
    bool beyond = q.x * end.y - q.y * end.x > 0.0;
    float radius = length(end), r = length(q);
    float ring = length(beyond ? vec3(q - end, p.z) : vec3(r - radius, 0.0, p.z));
    float middle = beyond ? end.x : radius, from = beyond ? q.x : r;
    float depth = middle * ring + tube * (from - middle) >= 0.0 ? tube - ring : 1e9;
    float pole = sqrt(max((tube - radius) * (tube + radius), 0.0));
    depth = tube > radius ? min(depth, length(vec3(q, abs(p.z) - pole))) : depth;
    float seam = sqrt(max((tube - end.x) * (tube + end.x), 0.0));
    float w = length(vec2(q.y - end.y, p.z));
    bool seamed = w > 0.0 ? end.y * w + seam * (q.y - end.y) < 0.0 : end.y < seam;
    seamed = seamed && tube > end.x;
    depth = seamed ? min(depth, length(vec2(q.x, w - seam))) : depth;
    return ring < tube ? -depth : ring - tube;
}

/* A link of a chain, along Y. */
float sd_link(vec3 p, float straight, float radius, float tube)
{
    float r = length(vec2(p.x, max(abs(p.y) - 0.5 * straight, 0.0)));
    return disc_pair(r, p.z, radius, tube);
}

/* A cylinder along Y. */
float sd_cylinder(vec3 p, float radius, float height)
{
    return corner(length(p.xz) - radius, abs(p.y) - 0.5 * height);
}

/* A cylinder along Y whose rounding lies inside; at most the radius and half of the height. */
float sd_round_cylinder(vec3 p, float radius, float height, float rounding)
{
    return sd_cylinder(p, radius - rounding, height - 2.0 * rounding) - rounding;
}

/* All points near the segment from a to b. */
float sd_capsule(vec3 p, vec3 a, vec3 b, float radius)
{
    vec3 pa = p - a, ba = b - a;
    float t = clamp(dot(pa, ba) / max(dot(ba, ba), 1e-30), 0.0, 1.0);
    return length(pa - t * ba) - radius;
}

/* A cone along Y, tip up: nearest point of slope or base, in the half-plane below the tip. */
float sd_cone(vec3 p, float radius, float height)
{
    vec2 q = vec2(length(p.xz), 0.5 * height - p.y), tip = vec2(radius, height);
    vec2 slope = q - tip * clamp(dot(q, tip) / dot(tip, tip), 0.0, 1.0);
    vec2 base = vec2(max(q.x - radius, 0.0), q.y - height);
    float d = sqrt(min(dot(slope, slope), dot(base, base)));
    return max(q.x * height - q.y * radius, q.y - height) > 0.0 ? d : -d;
}

/* A cone along Y without its tip: nearest point of its slope, or of its nearer end. */
float sd_capped_cone(vec3 p, float radius1, float radius2, float height)
{
    vec2 q = vec2(length(p.xz), p.y), w = q - vec2(radius1, -0.5 * height);
    vec2 slope = vec2(radius2 - radius1, height);
    vec2 side = w - slope * clamp(dot(w, slope) / dot(slope, slope), 0.0, 1.0);
    vec2 cap = vec2(max(q.x - (q.y < 0.0 ? radius1 : radius2), 0.0), abs(q.y) - 0.5 * height);
    float d = sqrt(min(dot(side, side), dot(cap, cap)));
    return cap.y > 0.0 || w.x * slope.y > w.y * slope.x ? d : -d;
}

/* Balls at the origin and above it, a cone's wall between them; or the greater one alone. */
float sd_round_cone(vec3 p, float radius1, float radius2, float height)
{
    vec2 q = vec2(length(p.xz), p.y);
    float tilt = (radius1 - radius2) / height, level = sqrt(max((1.0 - tilt) * (1.0 + tilt), 0.0));
    float along = q.y * level - q.x * tilt;
    bool first = tilt >= 1.0 || (tilt > -1.0 && along < 0.0);
    bool second = tilt <= -1.0 || along > level * height;
    return first    ? length(q) - radius1
           : second ? length(q - vec2(0.0, height)) - radius2
                    : dot(q, vec2(level, tilt)) - radius1;
}

/* A part of a ball around +Y by the end of its section's straight side; all of it where x is 0. */
float sd_solid_angle(vec3 p, float end_x, float end_y)
{
    vec2 q = vec2(length(p.xz), p.y), end = vec2(end_x, end_y);
    float ball = length(q) - length(end);
    float side = length(q - end * clamp(dot(q, end) / dot(end, end), 0.0, 1.0));
    float d = q.x * end.y < q.y * end.x ? max(ball, -side) : side;
    return end.x == 0.0 ? ball : d;
}

/* The part of a ball above y = height, which is at most the radius up or down. */
float sd_cut_sphere(vec3 p, float radius, float height)
{
    vec2 q = vec2(length(p.xz), p.y);
    vec2 rim = vec2(sqrt(max((radius - height) * (radius + height), 0.0)), height);
    bool beside = q.x > rim.x && q.x * rim.y > q.y * rim.x;
    return beside ? length(q - rim) : max(length(q) - radius, height - q.y);
}

/* A ball without another one, centred at x = away, which leaves something of it. */
float sd_death_star(vec3 p, float radius1, float radius2, float away)
{
    vec2 q = vec2(p.x, length(p.yz)), rim;
    rim.x = away > 0.0 ? 0.5 * (away + (radius1 - radius2) * (radius1 + radius2) / away) : 1e9;
    rim.y = sqrt(max((radius1 - rim.x) * (radius1 + rim.x), 0.0));
    rim.y = radius2 < 0.999999 * (radius1 + away) ? rim.y : 0.0;
    bool beside = q.x * rim.y > q.y * rim.x && (q.x - away) * rim.y > q.y * (rim.x - away);
    float two = max(length(q) - radius1, radius2 - length(q - vec2(away, 0.0)));
    return beside ? length(q - rim) : two;
}

/* Everything on one side of a plane; unit normal. */
float sd_plane(vec3 p, vec3 normal, float offset)
{
    return dot(p, normal) - offset;
}
