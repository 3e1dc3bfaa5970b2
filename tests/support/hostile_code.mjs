// SPDX-License-Identifier: MIT
// Texts of code, by families. HOSTILE: what shall be refused, with line and column, and what looks bad
// and has a meaning, so that it is drawn. HONEST: what authors write; none of it may be refused.
// A text without a function of its own is the body of `float sdf(vec3 p)`.
const sdf = (body) => `float sdf(vec3 p) {\n    ${body}\n}`;
const whole = (text) => (/\b(sdf|shade)\s*\(|\(vec3 p, Primitive3D/.test(text) ? text : sdf(text));
const texts = (list) => list.map(whole);
const times = (count, make) => Array.from({ length: count }, (_, i) => make(i)).join('');

const doubling = (count, step) => `float f0(float x) { return sin(x); }\n${times(count, (i) => step(i + 1, i))}${sdf(`return f${count}(p.x);`)}`;
const behind = (text) => `${text}\n${sdf('return length(p) - 0.5;')}`;
const nested = (count, open, inside, close) => open.repeat(count) + inside + close.repeat(count);
const loops = (count, trips) => `float d = 0.0; ${times(count, (i) => `for (int i${i} = 0; i${i} < ${trips}; i${i}++) `)} d += 0.01; return d;`;

const refused = {
    'recursion': [
        'float f(float x) { return f(x); }\nfloat sdf(vec3 p) { return f(p.x); }',
        'float sdf(vec3 p) { return sdf(p * 0.5); }',
        'float g(float x);\nfloat f(float x) { return g(x); }\nfloat g(float x) { return f(x); }\nfloat sdf(vec3 p) { return f(p.x); }',
        'float f(float x) { return x > 0.0 ? f(x - 1.0) : 0.0; }\nfloat sdf(vec3 p) { return f(p.x); }',
        'float f(float x) { if (false) return f(x); return x; }\nfloat sdf(vec3 p) { return f(p.x); }',
        'float a(float x);\nfloat b(float x) { return a(x); }\nfloat c(float x) { return b(x); }\nfloat a(float x) { return c(x); }\nfloat sdf(vec3 p) { return c(p.x); }',
        'float f(float x) { return f(f(x)); }\nfloat sdf(vec3 p) { return length(p); }',
        'float f(vec2 x) { return f(x.xy); }\nfloat f(float x) { return x; }\nfloat sdf(vec3 p) { return f(p.xy); }',
        'float f(float x);\nfloat sdf(vec3 p) { return f(p.x); }',
    ],
    'loops without an end': [
        'while (true) {} return 1.0;', 'do {} while (true); return 1.0;', 'for (;;) {} return 1.0;',
        'for (int i = 0; ; i++) {} return 1.0;', 'for (int i = 0; i < 10; ) {} return 1.0;', 'for (int i = 0; i < 10; i += 0) {} return 1.0;',
        'for (int i = 0; i < 10; i--) {} return 1.0;', 'for (int i = 0; i != 7; i += 2) {} return 1.0;', 'for (int i = 0; i >= 0; i++) {} return 1.0;',
        'for (float x = 0.0; x < 1.0; x += 0.0) {} return 1.0;', 'for (float x = 0.0; x < 1e9; x += 1e-9) {} return 1.0;',
        'for (float x = 16777216.0; x < 16777300.0; x += 0.5) {} return 1.0;', 'for (int i = 0; i < int(p.x); i++) {} return 1.0;',
        'int n = 5; for (int i = 0; i < n; i++) { n++; } return 1.0;', 'for (int i = 0; i < 10; i++) { i = 0; } return 1.0;',
        'for (int i = 0; i < 10; i++) { i--; } return 1.0;', 'goto here; here: return 1.0;', 'for (int i = 0; true; i++) {} return 1.0;',
        'for (bool b = true; b; ) {} return 1.0;', 'switch (1) { default: return 1.0; }', 'for (uint i = 0u; i < 4294967295u; i++) {} return 1.0;',
    ],
    'loops without measure': [
        ...[257, 1000, 65536, 2000000000, 2147483647].map((n) => `float d = 0.0; for (int i = 0; i < ${n}; i++) d += p.x; return d;`),
        loops(2, 17), loops(3, 7), loops(6, 64), loops(16, 2),
        times(9, (i) => `for (int i${i} = 0; i${i} < 31; i${i}++) p.x += 0.1; `) + 'return p.x;',
        `float f(float x) { for (int i = 0; i < 100; i++) x += 0.1; return x; }\n${sdf('float d = 0.0; for (int i = 0; i < 100; i++) d += f(p.x); return d;')}`,
        `float d = 0.0; for (int i = 0; i < 256; i++) d += fbm(p * d, 8); return d;`,
        `float d = 0.0; for (int i = 0; i < 200; i++) { ${times(60, (i) => `d += p.x * ${i}.5 + p.y * d; `)} } return d;`,
    ],
    'chains of calls': [
        doubling(13, (i, j) => `float f${i}(float x) { return f${j}(x) + f${j}(x + 1.0); }\n`),
        doubling(40, (i, j) => `float f${i}(float x) { return f${j}(x) * f${j}(x); }\n`),
        doubling(8, (i, j) => `float f${i}(float x) { return f${j}(f${j}(f${j}(x))); }\n`),
        doubling(12, (i, j) => `float f${i}(float x) { return x > 0.0 ? f${j}(x) : f${j}(-x); }\n`),
        doubling(12, (i, j) => `float f${i}(float x) { float a = f${j}(x); x = f${j}(a); return a + x; }\n`),
        doubling(66, (i, j) => `float f${i}(float x) { return f${j}(x); }\n`),
        doubling(200, (i, j) => `float f${i}(float x) { return f${j}(x) + 1.0; }\n`),
        `vec4 g0(vec4 x) { return x.wzyx; }\n${times(11, (i) => `vec4 g${i + 1}(vec4 x) { return g${i}(x) * g${i}(x.yzwx); }\n`)}${sdf('return g11(vec4(p, 1.0)).x;')}`,
    ],
    'long to compile': [
        `float a = p.x; ${'a=sin(a);'.repeat(1200)} return a;`, `float a = p.x; ${'a=pow(a,a+1.0);'.repeat(200)} return a;`,
        `float a = p.x; ${'a=atan(a,p.y);'.repeat(100)} return a;`, `float a = p.x; ${'a=acos(a);'.repeat(120)} return a;`,
        `float a = p.x; ${'a+=fbm(p*a,8);'.repeat(30)} return a;`, `float a = p.x; ${'a+=noise(p*a);'.repeat(60)} return a;`,
        'mat4 m[64]; m[int(p.x)][int(p.y)][int(p.z)] = 1.0; return m[0][0][0];', 'vec4 m[32]; m[int(p.x)][int(p.y)] = 1.0; return m[0][0];',
        `${times(60, (i) => `float a${i}[64]; `)} return a0[int(p.x)];`, `float a[64]; ${times(100, () => 'a[int(p.x)] = a[int(p.y)]; ')} return a[0];`,
        `int i = int(p.x * 9.0), j = 2; ${'i=i/(j+3);j=i%(i+j);'.repeat(180)} return float(i);`,
        `ivec4 i = ivec4(p.xyzx * 9.0); ${'i=i/(i.yzwx+11);'.repeat(97)} return float(i.x);`,
        `uint i = uint(p.x * 9.0); ${'i=i/(i+11u)+7u;'.repeat(300)} return float(i);`,
        `ivec4 i = ivec4(p.xyzx * 9.0); ${'i=clamp(i,i.yzwx,i.zwxy);'.repeat(400)} return float(i.x);`,
        `float a = p.x; ${'a=stripes(a)+p.y;'.repeat(600)} return a;`, `vec4 a = p.xyzx; ${'a=a/a.yzwx;'.repeat(440)} return a.x;`,
        `float a = p.x, b = p.y; ${times(330, (i) => `if(a<b){a+=b;}else{if(b<a+${i}.)return a;b+=a;}`)} return a;`,
        `float a = p.x; ${times(500, (i) => `if(a<${i}.0)return p.y;`)} return a;`,
        `mat4 m = mat4(p.x); ${'m=inverse(m)+m;'.repeat(60)} return m[0][0];`, `mat4 m = mat4(p.x); ${'m=m*m;'.repeat(90)} return m[0][0];`,
        `mat4 m = mat4(p.x); int i = int(p.y); ${'m[i]=m[i+1];'.repeat(40)} return m[0][0];`,
        `vec3 c = p; ${'c=cross(c,p)+c;'.repeat(400)} return c.x;`, `vec4 a = p.xyzx; ${'a=smoothstep(a,a.yzwx,a.zwxy);'.repeat(200)} return a.x;`,
        `float a = p.x; ${'for(int i=0;i<2;i++){a+=p.y*a;if(a<p.y)break;}'.repeat(120)} return a;`,
    ],
    'size': [
        `return p.x${'+1'.repeat(7000)};`, `return p.x${' + p.x * p.y'.repeat(1400)};`, behind('x'.repeat(20000)), behind(`// ${'x'.repeat(16400)}`),
        `float a[65536]; return a[int(p.x)];`, `float a[65]; return a[0];`, 'float a[2147483647]; return 1.0;', 'float a[-1]; return 1.0;', 'float a[0]; return 1.0;',
        'float a[int(p.x)]; return 1.0;', `${times(9, (i) => `vec4 a${i}[64]; `)} return a0[0].x;`, 'vec4 a[64][64]; return 1.0;', 'mat4 a[64]; return a[0][0][0];',
        `return ${nested(1000, '(', '1.0', ')')};`, `return ${nested(200, '-(', 'p.x', ')')};`, `return ${nested(300, 'sin(', 'p.x', ')')};`,
        `${nested(100, '{', 'p.x += 1.0;', '}')} return p.x;`, `${nested(80, 'if (p.x > 0.0) {', 'p.x += 1.0;', '}')} return p.x;`,
        `return ${times(90, (i) => `p.x > ${i}.0 ? ${i}.0 : `)} 1.0;`, `return p${'[0]'.repeat(300)};`, `return ${'!'.repeat(500)}true ? 1.0 : 2.0;`,
        `float ${'a'.repeat(300)} = ; return 1.0;`, `return 0.${'1'.repeat(9000)}e;`, behind(`float f(${times(300, (i) => `float a${i}, `)}float z) { return z`),
    ],
    'the preprocessor': [
        '#define x 1', '#define f(a) a a', '#version 450', '#extension GL_ARB_gpu_shader5 : enable', '#extension all : enable', '#include "frame.glsl"', '#include </etc/passwd>', '#if 1', '#ifdef GL_ES',
        '#pragma optimize(off)', '#line 7', '#line 1 2', '#error no', '#undef length', '#', ' \t#define y 2', '%:define x 1', '??=define x 1', '/* */ #define x 1', '#de\\\nfine x 1', '__LINE__', '#define sdf main',
    ].map(behind),
    'what drivers have': [
        'gl_FragDepth = 1.0; return 1.0;', 'return gl_FragCoord.x;', 'return float(gl_GlobalInvocationID.x);', 'return float(gl_NumWorkGroups.x);', 'return gl_PointSize;', 'return float(gl_LocalInvocationIndex);',
        'discard;', 'barrier(); return 1.0;', 'memoryBarrier(); return 1.0;', 'groupMemoryBarrier(); return 1.0;', 'memoryBarrierShared(); return 1.0;',
        'return dFdx(p.x);', 'return fwidth(p.x);', 'EmitVertex(); return 1.0;', 'return float(atomicAdd(x, 1));', 'return float(atomicCounterIncrement(c));', 'return imageLoad(i, ivec2(0)).x;', 'imageStore(i, ivec2(0), vec4(0)); return 1.0;',
        'return texture(t, p.xy).x;', 'return texelFetch(t, ivec2(0), 0).x;', 'return float(textureSize(t, 0).x);', 'return noise1(p.x);', 'return interpolateAtCentroid(p.x);', 'return uintBitsToFloat(0x7fc00000u);', 'return floatBitsToInt(p.x) > 0 ? 1.0 : 0.0;',
        'return unpackHalf2x16(7u).x;', 'printf("x"); return 1.0;', 'return subgroupAdd(p.x);', 'return N(0).x;', 'return numbers[0].x;', 'return zero;', 'return float(tile.z);', 'return eye.x;', 'return map(p);', 'return user_0_f0(p);', 'return code_sqrt(p.x);', 'main(); return 1.0;',
    ],
    'declarations': [
        'layout(binding = 0) buffer B { float b[]; };', 'layout(local_size_x = 1024) in;', 'uniform float x;', 'uniform sampler2D t;', 'layout(rgba8) uniform image2D i;', 'shared float s[1024];', 'in float x;', 'out vec4 color;',
        'float state = 0.0;\nvoid f() { state += 1.0; }', 'float state;\nfloat f() { return state++; }', 'coherent volatile buffer B { int x; };', 'layout(binding = 0) uniform atomic_uint c;', 'struct S { float x; };', 'struct S { S s; };', 'precise float x;', 'invariant gl_Position;', 'varying vec3 v;', 'subroutine float f();',
        'typedef float real;', 'namespace a { float b; }', 'class A {};', 'template<class T> T f(T t) { return t; }', 'interface I { float f(); };', 'import math;', 'cbuffer C { float c; };', 'Texture2D t;', 'RWStructuredBuffer<float> b;', '[numthreads(1, 1, 1)]', 'asm { nop }', 'extern float x;', 'void main() { }  }',
    ].map(behind),
    'ways out': [
        `${sdf('return 1.0;')}\n} void main() { discard;`, `${sdf('return 1.0;')}\n}\nfloat user_0(vec3 p) { return 0.0;`, 'return 1.0; } float g(vec3 p) { return 1.0; } }', `float sdf(vec3 p) { return 1.0; } /*`, `float sdf(vec3 p) { return 1.0; /* `,
        `float sdf(vec3 p) { return 1.0 */ ; }`, `*/ float sdf(vec3 p) { return 1.0; } /*`, 'return 1.0; // \\\n}', 'return "}";', "return '}';", 'return `1`;', 'return 1.0;\u2028}\u2029 void main() {', 'return 1.0; \u0000 }', '\ufeff\ufeff return 1.0;', 'return 1.0\u00a0;', 'return \u03c0;', 'float \u0430 = 1.0; return \u0430;', 'return \uff11;', 'return 1.0; \u202e } niam',
        '<% return 1.0; %>', 'float a<:2:>; return a<:0:>;', 'return \\u0031;', 'return ??/\n1.0;', 'return @1;', 'return $p;', 'return 1.0;;}', 'return 1.0; }{',
    ],
    'order and place': [
        'float a = p.x; return a + (a = 2.0);', 'float a = 1.0; return a++ + a++;', 'float a = 1.0; a = a++; return a;', 'int i = 0; float a[3]; a[i] = float(i++); return a[0];', 'float a = 1.0; return max(a, a = 2.0);',
        'void f(inout float x, inout float y) { x = 1.0; y = 2.0; }\nfloat sdf(vec3 p) { float a = 0.0; f(a, a); return a; }', 'void f(out float x) { x = 1.0; }\nfloat sdf(vec3 p) { f(1.0); return 1.0; }', 'void f(out float x) { x = 1.0; }\nfloat sdf(vec3 p) { const float c = 1.0; f(c); return c; }',
        'const float c = 1.0; c = 2.0; return c;', '1.0 = p.x; return 1.0;', 'p.xx = vec2(1.0); return p.x;', 'p + p = p; return 1.0;', 'length(p) = 1.0; return 1.0;', 'p.xyzw = vec4(1.0); return 1.0;', 'return p.q;', 'return p[3];', 'return p[-1];', 'float a[2]; return a[2];', 'mat2 m; return m[2][0];', 'radius = 2.0; return radius;',
    ],
    'types': [
        'return p;', 'return true;', 'float a = p; return a;', 'return vec3(1.0) + vec2(1.0);', 'return p * mat2(1.0);', 'return 1.0 % 2.0;', 'return p.x & 1;', 'return !p.x ? 1.0 : 2.0;', 'if (p.x) return 1.0; return 2.0;', 'double d = 1.0; return float(d);', 'sampler2D s; return 1.0;', 'void v; return 1.0;', 'vec3 v = vec3(1.0, 2.0); return v.x;', 'mat3 m = mat3(1.0, 2.0); return m[0][0];', 'float f; return f();', 'return sin;', 'return sin(p.x, p.y);', 'return undefined(p);', 'float a; float a; return a;', 'string s = 1; return 1.0;', 'return mix(p, p);', 'return 1.0f1;', 'return 08;', 'return 0x;', 'return 1e;', 'return 99999999999;', '',
    ],
    'no numbers': [
        'float zero = 0.0; return length(p) / zero;', 'return length(p) / 0.0;', 'return p.x / (1.0 - 1.0);', 'return float(1 / 0);', 'return float(7 % 0);', 'return float(7u / 0u);', 'return mod(p.x, 0.0) / 0.0;', 'float d = p.x - p.x; return 1.0 / d;', 'vec3 q = p / vec3(1.0, 0.0, 1.0); return q.x;', 'float a = 1e30; return a * a * a;', 'return p.x * 1e39;', 'float a = exp(1000.0); return a;', 'float a = 1e38 * 10.0; return a - a;', 'mat2 m = mat2(1.0) / 0.0; return m[0][0];',
    ],
};

// What C leaves open or processors trap on; here it has a meaning, the same in both evaluators.
const drawn = {
    'bounds at run time': [
        'float a[4]; return a[int(p.x * 1000000.0)] + length(p) - 0.5;', 'float a[4]; a[int(p.x * -1e9)] = 1.0; return length(p) - 0.5;', 'vec3 v = p; v[int(p.x * 99.0)] = 0.5; return length(v) - 0.5;', 'mat3 m = mat3(1.0); return length(m[int(p.y * 50.0)]) + length(p) - 1.5;', 'float a[2]; int i = -2147483647; return a[i] + length(p) - 0.5;',
    ],
    'numbers at run time': [
        'int a = -2147483647 - 1; int b = int(p.x) - int(p.x) - 1; return float(a / b) * 1e-12 + length(p) - 0.5;', 'int a = int(p.x * 1e30); return float(a) * 1e-12 + length(p) - 0.5;', 'int s = 1 << int(p.x * 99.0); return float(s) * 1e-12 + length(p) - 0.5;', 'uint u = uint(-1.0 - abs(p.x)); return float(u) * 1e-12 + length(p) - 0.5;', 'return sqrt(-1.0 - abs(p.x)) + length(p) - 0.5;', 'return log(-abs(p.x)) * 1e-3 + length(p) - 0.5;', 'return asin(2.0 + abs(p.x)) * 0.01 + length(p) - 0.6;', 'return normalize(p * 0.0).x + length(p) - 0.5;', 'return pow(-abs(p.x), 0.5) * 0.01 + length(p) - 0.5;', 'float a; return a + length(p) - 0.5;', 'return float(int(p)) * 0.01 + length(p) - 0.5;', 'float length = 1.0; return length(p) - 0.5;', 'return inverse(mat3(0.0))[0][0] + length(p) - 0.5;', 'return smoothstep(1.0, 0.0, p.x) * 0.1 + length(p) - 0.5;', 'return atan(0.0, 0.0 * p.x) + length(p) - 0.5;', 'return mod(p.x, 0.0 * p.y) * 0.01 + length(p) - 0.5;',
        'float d = 0.0; for (int i = 2147483640; i <= 2147483647; i++) d += 0.001; return length(p) - 0.5 - d;', 'float d = 0.0; for (uint i = 8u; i >= 0u; i--) d += 0.001; return length(p) - 0.5 - d;',
    ],
    'at the bounds': [
        loops(1, 256), loops(7, 2), loops(2, 15), `float a[64]; return a[63] + length(p) - 0.5;`, `return length(p) - 0.5; // ${'x'.repeat(16000)}`, `return ${nested(28, '(', 'length(p) - 0.5', ')')};`,
        doubling(7, (i, j) => `float f${i}(float x) { return f${j}(x) * 0.5 + f${j}(x + 1.0) * 0.5; }\n`).replace('sin(x)', 'x'),
    ],
};

const honest = {
    'shapes': [
        'return length(p) - 0.5;', 'return length(p)-0.5; // a ball', '/* a ball */ return length(p) - radius;', 'return length(p) - float(1) / 2.;', 'vec3 q = abs(p) - 0.5; return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);', 'vec2 q = vec2(length(p.xz) - 0.5, p.y); return length(q) - 0.2;', 'return p.y + 0.5;', 'return max(length(p.xz) - 0.3, abs(p.y) - 0.5);', 'p = abs(p); return (p.x + p.y + p.z - 0.8) * 0.57735027;', 'float h = clamp(p.y, -0.4, 0.4); p.y -= h; return length(p) - 0.2;',
        'vec2 c = vec2(0.8, 0.6); vec2 q = vec2(length(p.xz), -p.y); float d = length(q - c * max(dot(q, c), 0.0)); return d * (q.x * c.y - q.y * c.x < 0.0 ? -1.0 : 1.0);', 'float k0 = length(p / vec3(0.6, 0.4, 0.5)); float k1 = length(p / vec3(0.36, 0.16, 0.25)); return k0 * (k0 - 1.0) / max(k1, 1e-6);',
        'const vec3 k = vec3(-0.8660254, 0.5, 0.57735); p = abs(p); p.xy -= 2.0 * min(dot(k.xy, p.xy), 0.0) * k.xy; vec2 d = vec2(length(p.xy - vec2(clamp(p.x, -k.z * 0.4, k.z * 0.4), 0.4)) * sign(p.y - 0.4), p.z - 0.2); return min(max(d.x, d.y), 0.0) + length(max(d, 0.0));',
        'return length(p.xy) < 0.5 ? abs(p.z) - 0.1 : length(vec2(length(p.xy) - 0.5, p.z)) - 0.1;', 'float3 q = p; return length(q) - 0.5;', 'float2 q = float2(length(p.xz), p.y); return length(q) - 0.5;', 'return lerp(length(p) - 0.5, length(p) - 0.7, saturate(p.y));', 'return length(mul(float3x3(1,0,0,0,1,0,0,0,1), p)) - 0.5;',
    ],
    'combined': [
        'float a = length(p - vec3(0.3, 0.0, 0.0)) - 0.4; float b = length(p + vec3(0.3, 0.0, 0.0)) - 0.4; return min(a, b);', 'float a = length(p) - 0.5; float b = abs(p.x) - 0.1; return max(a, -b);', 'float k = 0.2; float a = length(p) - 0.4; float b = p.y; float h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0); return mix(b, a, h) - k * h * (1.0 - h);',
        'float smin(float a, float b, float k) { float h = max(k - abs(a - b), 0.0) / k; return min(a, b) - h * h * k * 0.25; }\nfloat sdf(vec3 p) { return smin(length(p) - 0.4, length(p - vec3(0.5, 0.0, 0.0)) - 0.3, 0.2); }', 'float ball(vec3 p, float r) { return length(p) - r; }\nfloat sdf(vec3 p) { float d = 1e3; for (int i = 0; i < 5; i++) { d = min(d, ball(p - vec3(float(i) * 0.3 - 0.6, 0.0, 0.0), 0.1)); } return d; }', 'float d = 1.0; vec3 at[3]; at[0] = vec3(0.3); at[1] = vec3(-0.3); at[2] = vec3(0.0); for (int i = 0; i < 3; i++) d = min(d, length(p - at[i]) - 0.2); return d;', 'float r[3] = float[3](0.1, 0.2, 0.3); float d = 9.0; for (int i = 0; i < 3; ++i) { d = min(d, abs(length(p) - r[i]) - 0.02); } return d;',
        'void fold(inout vec3 q) { q = abs(q); if (q.x < q.y) q.xy = q.yx; }\nfloat sdf(vec3 p) { fold(p); return length(p - vec3(0.4, 0.0, 0.0)) - 0.2; }',
    ],
    'turned and repeated': [
        'float c = cos(p.y), s = sin(p.y); p.xz = mat2(c, -s, s, c) * p.xz; return (length(max(abs(p) - 0.3, 0.0)) - 0.05) * 0.6;', 'p.x = mod(p.x + 0.5, 1.0) - 0.5; return length(p) - 0.3;', 'p -= round(p); return length(p) - 0.3;', 'float a = atan(p.z, p.x); float r = length(p.xz); a = mod(a + 0.3927, 0.7854) - 0.3927; p.xz = r * vec2(cos(a), sin(a)); return length(p - vec3(0.6, 0.0, 0.0)) - 0.1;', 'mat3 m = mat3(0.8, 0.0, 0.6, 0.0, 1.0, 0.0, -0.6, 0.0, 0.8); p = m * p; return length(max(abs(p) - vec3(0.3, 0.1, 0.4), 0.0));', 'vec3 q = fract(p + 0.5) - 0.5; return max(length(q) - 0.2, length(p) - 1.5);', 'p.xy *= mat2(0.6, 0.8, -0.8, 0.6); return max(abs(p.x) - 0.2, max(abs(p.y) - 0.4, abs(p.z) - 0.3));',
    ],
    'waves and patterns': [
        'return (length(p) - 0.5 + 0.03 * sin(10.0 * p.x) * sin(10.0 * p.y) * sin(10.0 * p.z)) * 0.6;', 'return (dot(sin(p * 6.0), cos(p.yzx * 6.0)) / 6.0) * 0.5;', 'return (length(p) - 0.5 + 0.1 * noise(p * 4.0)) * 0.6;', 'return (length(p) - 0.5 + 0.1 * fbm(p * 3.0, 5)) * 0.5;', 'return length(p) - 0.5 - 0.01 * checker(p * 4.0);', 'return (p.y + 0.2 * fbm(vec3(p.xz, 0.0), 4)) * 0.6;', 'return (length(p) - 0.5 + 0.01 * stripes(p.y * 5.0)) * 0.8;', 'float d = length(p) - 0.5; float a = 0.1; vec3 q = p * 4.0; for (int i = 0; i < 4; i++) { d += a * noise(q) * 0.3; q *= 2.0; a *= 0.5; } return d * 0.5;', 'float h = hash(floor(p * 2.0)); return (length(fract(p * 2.0) - 0.5) - 0.1 - 0.2 * h) * 0.4;',
    ],
    'fractals': [
        'vec3 z = p; float dr = 1.0, r = 0.0; for (int i = 0; i < 5; i++) { r = length(z); if (r > 2.0) break; float t = acos(z.z / max(r, 1e-6)) * 8.0; float f = atan(z.y, z.x) * 8.0; dr = pow(r, 7.0) * 8.0 * dr + 1.0; z = pow(r, 8.0) * vec3(sin(t) * cos(f), sin(f) * sin(t), cos(t)) + p; } return 0.5 * log(max(r, 1e-6)) * r / dr;',
        'float s = 1.0; vec3 z = p; for (int i = 0; i < 8; i++) { z = abs(z); if (z.x < z.y) z.xy = z.yx; if (z.x < z.z) z.xz = z.zx; if (z.y < z.z) z.yz = z.zy; z = z * 3.0 - vec3(2.0); if (z.z < -1.0) z.z += 2.0; s *= 3.0; } return (length(z) - 1.0) / s;', 'float scale = 1.0; vec3 z = p; for (int i = 0; i < 6; i++) { z = 2.0 * clamp(z, -1.0, 1.0) - z; float r2 = dot(z, z); float k = max(1.5 / max(r2, 1e-3), 1.0); z *= k; scale *= k; } return 0.25 * abs(z.y) / scale;', 'vec4 z = vec4(p, 0.0); float md2 = 1.0; for (int i = 0; i < 7; i++) { md2 *= 4.0 * dot(z, z); z = vec4(z.x * z.x - dot(z.yzw, z.yzw), 2.0 * z.x * z.yzw) + vec4(-0.2, 0.6, 0.2, 0.2); if (dot(z, z) > 4.0) break; } float m = dot(z, z); return 0.25 * sqrt(m / max(md2, 1e-9)) * log(max(m, 1e-9));',
        'vec3 z = p; for (int i = 0; i < 9; i++) { if (z.x + z.y < 0.0) z.xy = -z.yx; if (z.x + z.z < 0.0) z.xz = -z.zx; if (z.y + z.z < 0.0) z.zy = -z.yz; z = z * 2.0 - 1.0; } return length(z) * 0.001953125;',
    ],
    'as they come from elsewhere': [
        'float sdf(float3 p)\n{\n\tfloat3 d = abs(p) - float3(0.5, 0.5, 0.5);\n\treturn length(max(d, 0.0f)) + min(max(d.x, max(d.y, d.z)), 0.0f);\n}', 'float sdf(in vec3 p) { return length(p) - 0.5; }', 'float SphereDistance(vec3 p, Primitive3D primitive) { return length(p) - 0.5; }', 'static const float R = 0.5;\nfloat sdf(vec3 p) { return length(p) - R; }', 'const float PI = 3.14159265, TAU = 2.0 * PI;\nfloat sdf(vec3 p) { return length(p) - 0.5 + 0.0 * TAU; }', 'precision highp float;\nfloat sdf(vec3 p) { return length(p) - 0.5; }', 'float sdf(vec3 p) { [unroll] for (int i = 0; i < 2; i++) { p = abs(p) - 0.1; } return length(p) - 0.5; }',
        'float sd(vec2 p) { return length(p) - 0.3; }\nfloat sd(vec3 p) { return sd(vec2(length(p.xz) - 0.5, p.y)); }\nfloat sdf(vec3 p) { return sd(p); }', 'float f(float x);\nfloat sdf(vec3 p) { return f(p.x) + length(p) - 0.5; }\nfloat f(float x) { return x * 0.01; }',
    ],
    'colours': [
        'vec3 shade(FragmentProperties properties) { return vec3(0.8, 0.2, 0.1); }', 'vec3 shade(FragmentProperties properties) { return properties.world_normal * 0.5 + 0.5; }', 'vec3 shade(FragmentProperties properties) { return mix(vec3(1.0), vec3(0.1, 0.2, 0.6), checker(properties.object_position * 4.0)); }', 'vec4 shade(FragmentProperties properties) { return vec4(fract(properties.world_position), 1.0); }',
        'vec3 shade(FragmentProperties properties) { float f = pow(1.0 - abs(dot(properties.world_normal, properties.ray_direction)), 5.0); return vec3(f) + 0.1; }', 'Surface shade(FragmentProperties properties) { Surface s = Surface(vec3(0.9)); s.metallic = 1.0; s.roughness = 0.2; return s; }', 'vec3 shade() { return vec3(0.5); }', 'vec3 shade(FragmentProperties p) { return vec3(0.5 + 0.5 * fbm(p.object_position * 3.0, 5)); }', 'vec3 shade(FragmentProperties p) { vec3 w = triplanar(p.world_normal); return w * hash(floor(p.world_position * 8.0)); }',
    ],
};

const flat = (families, verdict) =>
    Object.entries(families).flatMap(([family, list]) => texts(list).map((code, i) => ({ family, name: `${family} ${i + 1}`, code, verdict })));

export const HOSTILE = [...flat(refused, 'refused'), ...flat(drawn, 'drawn')];
export const HONEST = flat(honest, 'drawn');
export const isShade = (code) => /\bshade\s*\(/.test(code);
