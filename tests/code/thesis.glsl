// SPDX-License-Identifier: MIT
// Listings of the thesis, as printed: a primitive with two numbers, a shader with three properties.
//! hex_prism
float sdHexPrism(vec3 p, Primitive3D primitive) {
float2 h = float2(primitive.data[0], primitive.data[1]);

const vec3 k = vec3 ( -0.8660254, 0.5, 0.57735);
p = abs(p);
p.xy -= 2.0* min(dot(k.xy, p.xy), 0.0)*k.xy;
vec2 d = vec2(
length(p.xy - vec2(clamp(p.x,-k.z*h.x,k.z*h.x), h.x))*sign(p.y
-h.x), p.z-h.y);
return min(max(d.x,d.y),0.0) + length(max(d,0.0));
}
//! blend
float3 _Color1;
float3 _Color2;
float _Blend;

float3 shade(FragmentProperties properties) {
return lerp(_Color1, _Color2, _Blend);
}
