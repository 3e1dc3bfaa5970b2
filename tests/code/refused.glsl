// SPDX-License-Identifier: MIT
// What must be refused: //! [shade|limit] LINE:COLUMN and words of the message, then the text.
//! 1:1 no function float sdf(vec3 p)
//! shade 1:1 no function vec3 shade(FragmentProperties properties)
//! 1:28 there is no variable q
float sdf(vec3 p) { return q; }
//! 2:12 did you mean "radius"
float sdf(vec3 p) { float radius = 1.0;
    return raduis; }
//! 1:28 there is no function lenght; did you mean "length"?
float sdf(vec3 p) { return lenght(p); }
//! 1:28 there is no function jet_times
float sdf(vec3 p) { return jet_times(mat3(1.0), mat3(1.0))[0].x; }
//! 1:28 there is no variable jet_of
float sdf(vec3 p) { return jet_of; }
//! 1:28 map is defined below, in line 2; move it up
float sdf(vec3 p) { return map(p); }
float map(vec3 p) { return 1.0; }
//! 1:28 length is a function; call it
float sdf(vec3 p) { return length; }
//! 1:38 expected ; after return, not }
float sdf(vec3 p) { return p.x + 1.0 }
//! 1:33 expected a value, not ;
float sdf(vec3 p) { return p.x *; }
//! 2:1 the text ends; expected } to match the {
float sdf(vec3 p) { return 1.0;
//! 1:39 expected ) to match the (, not ;
float sdf(vec3 p) { return (p.x + 1.0 ; }
//! 1:31 expected ] to match the [, not ;
float sdf(vec3 p) { return p[0; }
//! 1:35 expected a type, not }
float sdf(vec3 p) { return 1.0; } }
//! 1:1 there is no type Float; did you mean "float"?
Float sdf(vec3 p) { return 1.0; }
//! 1:21 there is no type vec; did you mean "vec2"?
float sdf(vec3 p) { vec a = p; return 1.0; }
//! 1:21 there is no type retrun; did you mean "return"?
float sdf(vec3 p) { retrun 1.0; }
//! 1:21 there is no type retun; did you mean "return"?
float sdf(vec3 p) { retun p; }
//! 1:11 there is no type flaot
float sdf(flaot p) { return 1.0; }
//! 1:21 the character $ has no meaning here
float sdf(vec3 p) { $x; return 1.0; }
//! 1:21 there are no texts here
float sdf(vec3 p) { "x"; return 1.0; }
//! 2:10 a character that has no meaning outside of comments
/* é */ float sdf(vec3 p) {
/* ☃ */  é; return 1.0; }
//! 2:3 the comment that begins here has no end
float sdf(vec3 p) { return 1.0; }
  /* never
//! 1:28 1.5.2 is not a number
float sdf(vec3 p) { return 1.5.2; }
//! 1:28 2x is not a number
float sdf(vec3 p) { return 2x; }
//! 1:28 08 is not a number
float sdf(vec3 p) { return 08; }
//! 1:28 above the maximum 2147483647 of int
float sdf(vec3 p) { return 2147483648; }
//! 1:28 above the maximum 4294967295 of uint
float sdf(vec3 p) { return 4294967296u; }
//! 1:28 above the maximum 3.40282e+38 of float
float sdf(vec3 p) { return 1e39; }
//! 1:1 no preprocessor: for #define write const
#define PI 3.14159
float sdf(vec3 p) { return PI; }
//! 2:1 no preprocessor
float sdf(vec3 p) {
#line 100
return 1.0; }
//! 1:1 no preprocessor
#version 430
float sdf(vec3 p) { return 1.0; }
//! 1:21 the character \ has no meaning here
float sdf(vec3 p) { \
return 1.0; }
//! 1:21 while is not known here: write for (int i = 0; i < 64; i++)
float sdf(vec3 p) { while (true) {} return 1.0; }
//! 1:21 do is not known here: write for
float sdf(vec3 p) { do { p.x++; } while (p.x < 1.0); return 1.0; }
//! 1:21 goto is not known here
float sdf(vec3 p) { goto end; end: return 1.0; }
//! 1:21 switch is not known here: write if and else
float sdf(vec3 p) { switch (1) { case 1: return 1.0; } return 1.0; }
//! shade 1:45 discard is not known here
vec3 shade(FragmentProperties properties) { discard; return vec3(1); }
//! 1:1 struct is not known here
struct Ball { float r; };
float sdf(vec3 p) { return 1.0; }
//! 1:1 uniform is not known here: declare parameters
uniform float r;
float sdf(vec3 p) { return r; }
//! 1:1 layout is not known here
layout(binding = 0) buffer B { float x; };
float sdf(vec3 p) { return 1.0; }
//! 1:21 double is not known here: write float
float sdf(vec3 p) { double a = 1.0; return 1.0; }
//! 1:21 mat2x3 is not known here: only square matrices
float sdf(vec3 p) { mat2x3 a; return 1.0; }
//! 1:11 sampler2D is not known here: there are no textures
float sdf(sampler2D s) { return 1.0; }
//! shade 2:16 texture is not known here: there are no textures
vec3 shade(FragmentProperties f) {
  return vec3( texture(1, f.world_position.xy)); }
//! 1:28 dFdx is not known here: code is asked about one point
float sdf(vec3 p) { return dFdx(p.x); }
//! 1:28 gl_FragCoord is not known here
float sdf(vec3 p) { return gl_FragCoord.x; }
//! 1:27 two underscores
float sdf(vec3 p) { float a__b = 1.0; return 1.0; }
//! 1:28 the value returned is vec3, not float
float sdf(vec3 p) { return p; }
//! 1:32 the value returned is vec3, not float
float sdf(vec3 p) { return 2.0 * p; }
//! 1:29 a is float, not int; write int(...)
float sdf(vec3 p) { int a = 1.5; return 1.0; }
//! 1:32 a is vec2, not vec3
float sdf(vec3 p) { vec3 a = p.xy; return 1.0; }
//! 1:31 + cannot join vec3 and vec2
float sdf(vec3 p) { return (p + p.xy).x; }
//! 1:35 * cannot join mat2 and vec3
float sdf(vec3 p) { mat2 m; p = m * p; return 1.0; }
//! 1:31 *= cannot join vec3 and mat2
float sdf(vec3 p) { mat2 m; p *= m; return 1.0; }
//! 1:34 += cannot join int and float
float sdf(vec3 p) { int i = 1; i += 1.0; return 1.0; }
//! 1:25 += cannot join float and vec3
float sdf(vec3 p) { p.x += p; return 1.0; }
//! 1:33 + cannot join bool and int
float sdf(vec3 p) { return true + 1; }
//! 1:32 % is for int; write mod()
float sdf(vec3 p) { return p.x % 2.0; }
//! 1:32 & cannot join float and int
float sdf(vec3 p) { return p.x & 1; }
//! 1:27 < compares numbers; for vectors write lessThan()
float sdf(vec3 p) { if (p < vec3(1.0)) { } return 1.0; }
//! 1:27 == cannot join vec3 and float
float sdf(vec3 p) { if (p == 1.0) { } return 1.0; }
//! 1:30 && cannot join bool and float
float sdf(vec3 p) { if (true && p.x) { } return 1.0; }
//! 1:25 ! cannot be used on bvec3; write not()
float sdf(vec3 p) { if (!lessThan(p, p)) { } return 1.0; }
//! 1:28 - cannot be used on bool
float sdf(vec3 p) { return -true; }
//! 1:28 ~ cannot be used on float
float sdf(vec3 p) { return ~p.x; }
//! 1:25 the condition is int, not bool
float sdf(vec3 p) { if (1) { } return 1.0; }
//! 1:32 the condition of ? is float, not bool
float sdf(vec3 p) { return p.x ? 1.0 : 2.0; }
//! 1:33 ? cannot choose between vec3 and vec2
float sdf(vec3 p) { return true ? p : p.xy; }
//! 1:28 vec3 cannot be made of (vec2)
float sdf(vec3 p) { return vec3(p.xy).x; }
//! 1:28 vec2 cannot be made of (vec3, float)
float sdf(vec3 p) { return vec2(p, 1.0).x; }
//! 1:28 mat2 cannot be made of (vec3)
float sdf(vec3 p) { return mat2(p)[0][0]; }
//! 1:28 vec3 cannot be made of ()
float sdf(vec3 p) { return vec3().x; }
//! 1:28 min takes 2 arguments, not 1
float sdf(vec3 p) { return min(p.x); }
//! 1:28 atan takes 1 or 2 arguments, not 3
float sdf(vec3 p) { return atan(1.0, 1.0, 1.0); }
//! 1:28 dot cannot take (vec3, vec2)
float sdf(vec3 p) { return dot(p, p.xy); }
//! 1:28 length cannot take (mat3)
float sdf(vec3 p) { return length(mat3(1.0)); }
//! 1:28 abs cannot take (bool)
float sdf(vec3 p) { return abs(true); }
//! 1:28 mul of two vectors: write dot()
float sdf(vec3 p) { return mul(p, p); }
//! 2:28 f takes 1 argument, not 2
float f(float a) { return a; }
float sdf(vec3 p) { return f(p.x, 1.0); }
//! 2:31 argument 1 of f is vec3, not float
float f(float a) { return a; }
float sdf(vec3 p) { return f( p); }
//! 3:28 no function f takes (vec3)
float f(float a) { return a; }
float f(vec2 a) { return a.x; }
float sdf(vec3 p) { return f(p); }
//! 3:28 several functions f fit (int, int)
float f(float a, int b) { return a; }
float f(int a, float b) { return b; }
float sdf(vec3 p) { return f(1, 1); }
//! 2:24 f is defined in line 1 already
float f(float a) { return a; }
float sdf(vec3 p); int f(float a) { return 1; }
//! 2:5 f is declared in another way in line 1
float f(float a);
int f(float a) { return 1; }
//! 2:28 f is declared, but nowhere defined
float f(float a);
float sdf(vec3 p) { return f(p.x); }
//! 1:40 a function calls itself: sdf -> sdf
float sdf(vec3 p) { return p.x > 0.0 ? sdf(p * 0.5) : 1.0; }
//! 3:30 a function calls itself: sdf -> g -> sdf
float sdf(vec3 p);
float g(vec3 p) {
    return p.x > 0.0 ? 1.0 : sdf(p); }
float sdf(vec3 p) { return g(p); }
//! 1:7 sdf can end without a return
float sdf(vec3 p) { if (p.x > 0.0) return 1.0; }
//! 1:7 sdf can end without a return
float sdf(vec3 p) { for (int i = 0; i < 3; i++) { return 1.0; } }
//! 1:21 sdf returns float, not nothing
float sdf(vec3 p) { return; }
//! 1:19 f is void, so it returns no value
void f() { return 1.0; }
float sdf(vec3 p) { return 1.0; }
//! 2:31 this is no value for a
void f() { }
float sdf(vec3 p) { float a = f(); return 1.0; }
//! 1:30 a is declared in line 1 already
float sdf(vec3 p) { float a, a; return 1.0; }
//! 1:27 p is declared in line 1 already
float sdf(vec3 p) { float p; return 1.0; }
//! 1:23 p is declared in line 1 already
float f(float p, vec2 p) { return 1.0; }
//! 1:26 void cannot be the type of a variable
float sdf(vec3 p) { void v; return 1.0; }
//! 1:20 FragmentProperties cannot be the type of a variable
FragmentProperties f;
//! 1:38 k is constant and cannot be changed
float sdf(vec3 p) { const int k = 1; k = 2; return 1.0; }
//! 2:21 R is constant and cannot be changed
float R = 1.0;
float sdf(vec3 p) { R += 1.0; return R; }
//! 1:27 p is constant and cannot be changed
float sdf(const vec3 p) { p.x = 1.0; return 1.0; }
//! 1:49 i counts a loop
float sdf(vec3 p) { for (int i = 0; i < 3; i++) i = 0; return 1.0; }
//! 1:23 a component stands here twice
float sdf(vec3 p) { p.xx = vec2(1.0); return 1.0; }
//! 1:24 this is a value, not a variable
float sdf(vec3 p) { (p + p).x = 1.0; return 1.0; }
//! 1:21 this is a value, not a variable
float sdf(vec3 p) { 1.0++; return 1.0; }
//! 2:27 this is a value, not a variable
void f(out float a) { a = 1.0; }
float sdf(vec3 p) { f(p.x + 1.0); return 1.0; }
//! 2:30 argument 1 of f is int, not float
void f(out float a) { a = 1.0; }
float sdf(vec3 p) { int i; f(i); return 1.0; }
//! 1:47 the index of what is assigned to cannot itself assign
float sdf(vec3 p) { float a[3]; int i = 0; a[i++] = 1.0; return 1.0; }
//! 1:23 an index of .xy cannot be assigned to
float sdf(vec3 p) { p.xy[0] = 1.0; return 1.0; }
//! 1:23 vec3 has no component w
float sdf(vec3 p) { p.w = 1.0; return 1.0; }
//! 1:30 vec3 has no member xg
float sdf(vec3 p) { return p.xg; }
//! 1:30 vec3 has no member xyzxy
float sdf(vec3 p) { return p.xyzxy; }
//! 1:30 values have no functions of their own: .length()
float sdf(vec3 p) { return p.length(); }
//! 1:31 float has no index
float sdf(vec3 p) { return p.x[0]; }
//! 1:30 the index 3 is outside of vec3
float sdf(vec3 p) { return p[3]; }
//! 1:49 the index -1 is outside of float[2]
float sdf(vec3 p) { float a[2]; return a[0] + a[-1]; }
//! 1:30 an index is int, not float
float sdf(vec3 p) { return p[1.0]; }
//! 1:29 an array has at least one element
float sdf(vec3 p) { float a[0]; return 1.0; }
//! 1:29 the length of an array is a constant int
float sdf(vec3 p) { float a[int(p.x)]; return 1.0; }
//! limit 1:29 elements of an array above the maximum 64 (code_array)
float sdf(vec3 p) { float a[65]; return 1.0; }
//! limit 1:29 elements of an array above the maximum 64 (code_array)
float sdf(vec3 p) { float a[16777216]; return a[int(p.x)]; }
//! 1:31 an array has one index
float sdf(vec3 p) { float a[2][2]; return 1.0; }
//! 1:34 an array of 2 elements gets 3 values
float sdf(vec3 p) { float a[2] = float[2](1.0, 2.0, 3.0); return 1.0; }
//! 1:27 a has no value
float sdf(vec3 p) { float a[]; return 1.0; }
//! 1:33 k has no value
float sdf(vec3 p) { const float k; return 1.0; }
//! 1:34 { } can only be the initial value
float sdf(vec3 p) { float a; a = {1.0}; return 1.0; }
//! 1:7 k has no value: it is neither a constant nor a declared parameter
float k;
float sdf(vec3 p) { return k; }
//! 2:17 a constant cannot be made by a function of yours
float f() { return 1.0; }
const float k = f();
//! 1:32 a division by 0
float sdf(vec3 p) { return 1.0 / 0.0; }
//! 1:32 a division by 0
float sdf(vec3 p) { return p.x / (1.0 - 1.0); }
//! 1:31 a division by 0
float sdf(vec3 p) { return (p / vec3(1.0, 0.0, 1.0)).x; }
//! 1:30 a division by 0
float sdf(vec3 p) { return 1 % 0; }
//! 1:25 a division by 0
float sdf(vec3 p) { p.x /= 0; return 1.0; }
//! 1:28 the constant that exp gives is infinite
float sdf(vec3 p) { return exp(100.0); }
//! 1:33 the constant that * gives is infinite
float sdf(vec3 p) { return 1e20 * 1e20; }
//! 1:21 the loop has no bound
float sdf(vec3 p) { for (;;) {} return 1.0; }
//! 1:21 the loop has no bound
float sdf(vec3 p) { for (int i = 0; ; i++) {} return 1.0; }
//! 1:21 the loop has no step
float sdf(vec3 p) { for (int i = 0; i < 3;) {} return 1.0; }
//! 1:39 the bound of the loop is not constant
float sdf(vec3 p) { for (int i = 0; i < int(p.x); i++) {} return 1.0; }
//! 1:37 the bound of the loop is not constant
float sdf(vec3 p) { for (int i = 0; true; i++) {} return 1.0; }
//! 1:43 more than one condition: write if (...) break;
float sdf(vec3 p) { for (int i = 0; i < 3 && p.x > 0.0; i++) {} return 1.0; }
//! 1:34 the start of the loop is not constant
float sdf(vec3 p) { for (int i = int(p.x); i < 3; i++) {} return 1.0; }
//! 1:47 the step of the loop is not constant
float sdf(vec3 p) { for (int i = 1; i < 64; i *= 2) {} return 1.0; }
//! 1:33 the loop does not begin with one variable
float sdf(vec3 p) { int i; for (i = 0; i < 3; i++) {} return 1.0; }
//! 1:30 the loop does not begin with one variable
float sdf(vec3 p) { for (int i = 0, j = 0; i < 3; i++) {} return 1.0; }
//! 1:31 the variable of a loop is an int or a float
float sdf(vec3 p) { for (vec2 i = vec2(0.0); i.x < 3.0; i++) {} return 1.0; }
//! 1:21 the loop never ends
float sdf(vec3 p) { for (int i = 0; i < 3; i += 0) {} return 1.0; }
//! 1:21 the loop never ends
float sdf(vec3 p) { for (float t = 1e9; t < 2e9; t += 1.0) {} return 1.0; }
//! 1:21 the loop never ends
float sdf(vec3 p) { for (int i = 1; i > 0; i += 1000000000) {} return 1.0; }
//! 1:21 the loop never ends
float sdf(vec3 p) { for (uint i = 3u; i != 7u; i--) {} return 1.0; }
//! limit 1:21 iterations of loops above the maximum 256 (code_trips)
float sdf(vec3 p) { for (int i = 0; i >= 0; i++) {} return 1.0; }
//! limit 1:21 iterations of loops above the maximum 256 (code_trips)
float sdf(vec3 p) { for (int i = 0; i < 2000000000; i++) {} return 1.0; }
//! limit 1:21 iterations of loops above the maximum 256 (code_trips)
float sdf(vec3 p) { for (int i = 0; i < 4; i++)
  for (int j = 0; j < 4; j++) for (int k = 0; k < 16; k++) p.x += 1.0; return 1.0; }
//! 1:21 break stands in no loop
float sdf(vec3 p) { break; return 1.0; }
//! 1:36 continue stands in no loop
float sdf(vec3 p) { if (p.x > 0.0) continue; return 1.0; }
//! 1:27 a function cannot be inside another one
float sdf(vec3 p) { float f(float a) { return a; } return 1.0; }
//! 1:10 a function cannot return an array
float[2] f() { return float[2](1.0, 2.0); }
//! 1:7 sdf does not have the form float sdf(vec3 p)
float sdf(vec2 p) { return 1.0; }
//! 1:6 sdf does not have the form float sdf(vec3 p)
vec3 sdf(vec3 p) { return p; }
//! 1:7 sdf does not have the form float sdf(vec3 p)
float sdf(out vec3 p) { return 1.0; }
//! 1:7 sdf does not have the form float sdf(vec3 p)
float sdf(vec3 p, float r) { return 1.0; }
float other(vec3 p) { return 1.0; }
//! shade 1:7 shade does not have the form vec3 shade(FragmentProperties properties)
float shade(FragmentProperties properties) { return 1.0; }
//! shade 1:6 shade does not have the form
vec3 shade(vec3 p) { return p; }
//! shade 1:63 FragmentProperties has no member world_pos
vec3 shade(FragmentProperties properties) { return properties.world_pos; }
//! shade 1:63 did you mean "world_normal"?
vec3 shade(FragmentProperties properties) { return properties.world_normals; }
//! shade 1:56 world_normal can only be read
vec3 shade(FragmentProperties properties) { properties.world_normal = vec3(1); return vec3(1); }
//! shade 1:52 only its members can be used here
vec3 shade(FragmentProperties properties) { return properties + vec3(1); }
//! 1:51 Primitive3D has no member size; there are data, id
float sdf(vec3 p, Primitive3D q) { return p.x + q.size; }
//! 1:38 data can only be read
float sdf(vec3 p, Primitive3D q) { q.data[0] = 1.0; return 1.0; }
//! 1:50 the index 8 is outside of float[8]
float sdf(vec3 p, Primitive3D q) { return q.data[8]; }
//! 1:37 this parameter can only be read
float sdf(vec3 p, inout Primitive3D q) { return 1.0; }
//! 1:28 no value of Primitive3D can be made
float sdf(vec3 p) { return Primitive3D(); }
//! 1:21 expected a value, not in
float sdf(vec3 p) { in = 1.0; return 1.0; }
//! 1:13 expected a type, not }
void f() { }} void main() { }
//! 1:44 i is used and changed in one expression; make two statements of it
float sdf(vec3 p) { int i = 1; int j = i++ + i; return 1.0; }
//! 1:34 i is used and changed
float sdf(vec3 p) { int i = 1; i = i++; return 1.0; }
//! 2:41 a gets two results of one call; give it two variables
void f(inout float x, out float y) { y = x; x = 1.0; }
float sdf(vec3 p) { float a = 0.0; f(a, a); return a; }
//! 2:31 p gets two results of one call
void f(inout vec2 x, inout vec2 y) { x += y; y += x; }
float sdf(vec3 p) { f(p.xy, p.yz); return p.x; }
//! 2:53 m gets two results of one call
void f(out vec2 x, out float y) { x = vec2(1.0); y = 2.0; }
float sdf(vec3 p) { mat2 m = mat2(1.0); f(m[0], m[0][1]); return m[0][0]; }
//! 1:72 x is used and changed
float f(out float x) { return x; } float sdf(vec3 p) { float x; return max(x, f(x)); }
//! shade 2:7 Surface has no member gloss
Surface shade() { Surface s;
    s.gloss = 1.0; return s; }
//! shade 1:32 did you mean "roughness"
Surface shade() { Surface s; s.rougness = 1.0; return s; }
//! shade 1:38 the value is vec3, not float
Surface shade() { Surface s; s.ior = vec3(1); return s; }
//! shade 1:27 there are no arrays of Surface
Surface shade() { Surface s[2]; return s[0]; }
//! shade 1:34 the value returned is Surface, not vec3
vec3 shade() { Surface s; return s; }
//! shade 1:26 the value returned is vec3, not Surface
Surface shade() { return vec3(1); }
//! shade 1:26 Surface takes a color or nothing, not 2 arguments
Surface shade() { return Surface(vec3(1), 0.5); }
//! shade 1:34 the color is Surface, not vec3
Surface shade() { return Surface(Surface()); }
//! shade 1:31 Surface has no index
Surface shade() { Surface s; s[0] = 1.0; return s; }
//! shade 1:42 + cannot join Surface and Surface
Surface shade() { Surface s, t; return s + t; }
//! shade 1:39 == cannot join Surface and Surface
Surface shade() { Surface s, t; if (s == t) { return s; } return t; }
//! shade 1:42 { } is no value of Surface; set its members
Surface shade() { Surface s; Surface t = {1.0}; return s; }
//! shade 1:48 s is constant and cannot be changed
Surface shade() { const Surface s = Surface(); s.ior = 2.0; return s; }
//! shade 1:23 vec3 cannot be made of (Surface)
vec3 shade() { return vec3(Surface()); }
//! 1:9 sdf does not have the form float sdf(vec3 p)
Surface sdf(vec3 p) { return Surface(); }
