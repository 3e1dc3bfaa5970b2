// SPDX-License-Identifier: MIT
// Distance functions as people write them. A line with //! begins one, with its name; what it must
// give stands under that name in tests/unit/test_code.c.
//! sphere
float sdf(vec3 p) { return length(p) - 0.5; }
//! box
float sdf(vec3 p)
{
    vec3 q = abs(p) - vec3(1.0, 0.5, 0.25);
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}
//! whole_numbers_convert
float sdf(vec3 p) { float a = 1; return 2*p.x + a; }
//! number_forms
float sdf(vec3 p) { return p.x + .5 + 1. + 1e-1 + 2.5e+1 + 1.0f + 0x10 + 010 + 2u + 1h; }
//! comments
float sdf(vec3 p) { return /* one */ p.x // two é
 + /* three
 * four ☃ */ 1.0; }
//! precedence
float sdf(vec3 p) { return p.x + p.y * p.z - p.x / 4.0 - 1.0; }
//! left_to_right
float sdf(vec3 p) { return p.x - p.y - p.z; }
//! unary_minus
float sdf(vec3 p) { return - -p.x + -(p.y) * +p.z; }
//! swizzle_read
float sdf(vec3 p) { return p.zyx.x + p.xxy.z * p.gbr.x + p.sp.y; }
//! swizzle_write
float sdf(vec3 p) { vec4 v = vec4(0.0); v.wx = p.xy; v.gb = vec2(p.z); return v.w - v.x + v.y; }
//! swizzle_swap
float sdf(vec3 p) { p.xy = p.yx; p.yz *= p.zy; return p.x - p.y + 2.0 * p.z; }
//! swizzle_overlaps
float sdf(vec3 p) { vec3 q = p; q.yz = q.xy; p.zyx = p; vec2 b = q.yz; b.yx = b;
    return dot(p, q) + b.y; }
//! swizzle_of_swizzle
float sdf(vec3 p) { vec4 v = vec4(p, 1.0); v.wzyx.xy = vec2(3.0, 4.0); return v.w + v.z + v.x; }
//! swizzle_of_number
float sdf(vec3 p) { vec3 v = p.x.xxx; float f = 1.0; f.x += p.y; return v.y + f.x; }
//! shared_source
float sdf(vec3 p) { vec3 v = p; v *= v.x; return v.x + v.y + v.z; }
//! constructors
float sdf(vec3 p)
{
    vec4 v = vec4(p.xy, 1.0, p.z);
    return vec3(v).z + vec2(v.zw).y + vec3(2.0).y + vec3(p.xy, v.zw).x * vec4(p, p).w;
}
//! conversions
float sdf(vec3 p) { return float(int(p.x * 3.0)) + float(bool(1)) + float(true) + float(uint(2)); }
//! vector_conversions
float sdf(vec3 p) { ivec3 i = ivec3(p * 2.0); return float(i.x + i.y * 10 + i.z) + vec3(i).x; }
//! conversions_keep_inside
float sdf(vec3 p)
{
    int a = int(1e20 + p.x);
    uint b = uint(-abs(p.y) - 1.0);
    return float(a > 2147483000) + float(b) + float(int(uint(-1)));
}
//! large_whole_numbers
float sdf(vec3 p) { return float(uint(abs(p.x) * 1e9 + 2.2e9) > 2600000000u); }
//! large_angles
float sdf(vec3 p) { return float(abs(sin(p.x * 2e9)) <= 1.0) + float(abs(cos(p.y * 3e12)) <= 1.0); }
//! stripes_have_one_line_at_a_half
float sdf(vec3 p) { return stripes(0.49 + 0.0 * p.x) + 2.0 * stripes(0.53 + 0.0 * p.y); }
//! one_for_all
float sdf(vec3 p) { vec3 v = 0.5; v += 1; return dot(v, p) + (v / 2.0).x; }
//! matrix_times_vector
float sdf(vec3 p) { mat2 m = mat2(1.0, 2.0, 3.0, 4.0); vec2 v = m * p.xy; return v.x - v.y; }
//! vector_times_matrix
float sdf(vec3 p) { mat2 m = mat2(1.0, 2.0, 3.0, 4.0); vec2 v = p.xy * m; return v.x - v.y; }
//! matrix_in_place
float sdf(vec3 p) { float c = cos(0.5), s = sin(0.5); p.xz *= mat2(c, -s, s, c); return p.x; }
//! matrix_times_matrix
float sdf(vec3 p)
{
    mat2 a = mat2(1.0, 2.0, 3.0, 4.0) * mat2(0.0, 1.0, p.x, 1.0);
    return a[1].y + a[1][0];
}
//! matrix_with_numbers
float sdf(vec3 p)
{
    mat2 m = 2.0 * mat2(p.xy, p.zx) + mat2(1.0) / 2.0 - matrixCompMult(mat2(p.x), mat2(3.0));
    m++;
    return m[0][0] + m[0][1] * 10.0;
}
//! matrix_of_matrix
float sdf(vec3 p)
{
    mat3 m = mat3(mat2(p.x));
    mat2 n = mat2(mat4(p.y));
    return m[0][0] + m[2][2] + n[1][1];
}
//! matrix_of_whole_numbers
float sdf(vec3 p) { return mat3(int(p.x * 3.0))[1][1] + mat2(p.x > 0.0)[0][0]; }
//! matrix_columns
float sdf(vec3 p)
{
    mat3 m;
    m[1] = p;
    m[0].z = 2.0;
    return m[1].y + m[0][2] + m[2][1];
}
//! rows_of_hlsl
float sdf(vec3 p)
{
    float3x3 m = float3x3(float3(1, 2, 3), float3(4, 5, 6), float3(7, 8, 9));
    return mul(m, p).y + mul(p, m).x + m[1][2];
}
//! product_of_hlsl
float sdf(vec3 p)
{
    float2x2 a = float2x2(1, 2, 3, 4), b = float2x2(5, 6, 7, p.x);
    return mul(a, b)[0][1] + mul(a, mul(b, p.xy)).y;
}
//! spellings_of_hlsl
float sdf(float3 p)
{
    float3 q = lerp(p, float3(1, 1, 1), 0.25);
    half2 h = half2(frac(q.x), saturate(q.y));
    return h.x + h.y + rsqrt(4.0) + fmod(-5.5, 2.0) + atan2(1.0, 1.0) + mad(q.z, 2, 1);
}
//! cast_of_c
float sdf(vec3 p) { float3 v = (float3)2; return ((float2)p).y + v.z + (float)3; }
//! static_const
float sdf(vec3 p)
{
    static const float3 k[2] = {float3(1, 2, 3), p.x};
    return k[1].y + k[0].z;
}
//! initial_list
float sdf(vec3 p)
{
    float3 v = {1, p.y, 3};
    float a[] = {1, 2, 4,};
    float2 b[2] = {{1, 2}, {3, p.z}};
    return v.y + a[2] + b[1].y;
}
//! declared_lists
float sdf(vec3 p) { float a = p.x, b, c[2]; float[2] d; b = a + c[1] + d[0]; return b; }
//! zero_at_first
float sdf(vec3 p) { float a; vec3 v; int i; bool b; return a + v.y + float(i) + (b ? 1.0 : p.x); }
//! zero_again
float sdf(vec3 p)
{
    float s = 0.0;
    for (int i = 0; i < 3; i++) {
        float a;
        a += p.x;
        s += a;
    }
    return s;
}
//! array_in_and_out
float sdf(vec3 p)
{
    float a[4];
    for (int i = 0; i < 4; i++) a[i] = float(i) * p.x;
    float b[4] = a;
    return b[3] + a[1] + float[2](1.0, 2.0)[1];
}
//! array_index_kept
float sdf(vec3 p) { float a[3] = float[](1.0, 2.0, 4.0); return a[int(p.x * 100.0)]; }
//! array_of_vectors
float sdf(vec3 p)
{
    vec3 a[3];
    a[1] = p;
    a[1].yz += vec2(1.0);
    int i = int(p.x > 0.0);
    a[i].x = 7.0;
    a[i].zy = vec2(5.0, 6.0);
    return a[i].x + a[1].y * a[i].z;
}
//! index_of_vector
float sdf(vec3 p)
{
    int i = int(abs(p.x));
    float last = p.z;
    p[i] = 3.0;
    return p[i] + (i == 2 ? last : p.z);
}
//! index_of_matrix
float sdf(vec3 p)
{
    mat3 m = mat3(2.0);
    int i = int(p.x > 0.0);
    m[i][i + 1] = p.y;
    return m[i][1] + m[2][2];
}
//! index_of_value
float sdf(vec3 p) { return (p * 2.0)[1] + p.zyx[0] + vec4(p, 1.0).wz[0] + p[1u]; }
//! index_that_assigns
float sdf(vec3 p) { float a[2] = float[2](1.0, 2.0); int i; float b = a[i++];
    return b + a[i] * 10.0 + p.x; }
//! choice
float sdf(vec3 p) { return p.x > 0.0 ? p.y : p.z > 0.0 ? 1.0 : -1.0; }
//! choice_of_vectors
float sdf(vec3 p) { return (p.x < p.y ? p : p.zxy).x + (p.x < p.y ? 1 : 2.5); }
//! logic
float sdf(vec3 p)
{
    bool a = p.x > 0.0, b = p.y > 0.0;
    return float(a && b) + 2.0 * float(a || b) + 4.0 * float(a ^^ b) + 8.0 * float(!a);
}
//! logic_stops
float sdf(vec3 p)
{
    int n = 0;
    bool a = p.x > 0.0 && ++n > 0;
    bool b = p.x > 0.0 || ++n > 0;
    return float(n) + float(a) * 10.0 + float(b) * 20.0;
}
//! comparison
float sdf(vec3 p)
{
    return float(p.x <= p.y) + 2.0 * float(p.x >= p.y) + 4.0 * float(p == p.zyx) +
           8.0 * float(p.xy != p.yx) + float(1 == 1.0) * 16.0;
}
//! comparison_of_vectors
float sdf(vec3 p)
{
    bvec3 b = lessThan(p, vec3(0.0));
    return float(any(b)) + 2.0 * float(all(b)) + 4.0 * float(not(b).y);
}
//! selection
float sdf(vec3 p) { return mix(p, p.zxy, greaterThan(p, vec3(0.0))).y; }
//! if_else
float sdf(vec3 p)
{
    float d = 1.0;
    if (p.x > 0.0) {
        d = p.y;
    } else if (p.y > 0.0)
        d = p.z;
    return d;
}
//! early_return
float sdf(vec3 p) { if (p.x > 0.0) return p.x; return p.y; }
//! return_in_both
float sdf(vec3 p) { if (p.x > 0.0) { return p.x; } else { { return p.y; } } }
//! loop
float sdf(vec3 p) { float s = 0.0; for (int i = 0; i < 5; i++) { s += p.x; } return s; }
//! loop_down
float sdf(vec3 p)
{
    float s = 0.0;
    for (int i = 4; i > 0; --i) s = s * 0.5 + float(i) * p.x;
    return s;
}
//! loop_of_floats
float sdf(vec3 p)
{
    float s = 0.0;
    for (float t = 0.25; t <= 1.0; t += 0.25) s += t * p.y;
    return s;
}
//! loop_steps
float sdf(vec3 p)
{
    float s = 0.0;
    const int N = 3;
    for (int i = -N; N >= i; i = i + 2) s += float(i) + p.z;
    return s;
}
//! loop_of_uint
float sdf(vec3 p)
{
    uint s = 0u;
    for (uint i = 6u; i > 0u; i -= 2u) s += i;
    return float(s) + p.x;
}
//! loop_until
float sdf(vec3 p) { float s; for (int i = 5; i != -1; i -= 2) s += float(i) * p.x; return s; }
//! loop_never
float sdf(vec3 p) { for (int i = 0; i < 0; i++) p.x = 5.0; return p.x; }
//! loop_in_loop
float sdf(vec3 p)
{
    float s = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) s += float(i * j) * p.x;
    return s;
}
//! break_and_continue
float sdf(vec3 p)
{
    float s = 0.0;
    for (int i = 0; i < 9; i++) {
        if (i == 2) continue;
        if (float(i) > p.x + 4.5) break;
        s += float(i);
    }
    return s;
}
//! return_in_loop
float sdf(vec3 p)
{
    for (int i = 0; i < 4; i++) {
        if (float(i) > p.x) return float(i);
    }
    return 9.0;
}
//! increments
float sdf(vec3 p)
{
    int i = 3;
    int a = i++;
    a += i;
    int b = --i * 10;
    p.x++;
    --p.y;
    vec2 v = p.xy--;
    return float(a + b) + p.x + v.y;
}
//! assignments_have_values
float sdf(vec3 p) { float a, b; a = b = p.x; a += b *= 2.0; return a + b; }
//! comma
float sdf(vec3 p) { float a = 1.0, b; b = (a += p.x, a * 2.0); return b; }
//! int_division
float sdf(vec3 p) { int a = int(p.x * 10.0); return float(a / 3 + a % 3 * 100 - 7 / 2); }
//! int_division_of_vectors
float sdf(vec3 p)
{
    ivec2 a = ivec2(p.xy * 10.0);
    uvec2 b = uvec2(abs(p.xy) * 10.0) / 3u;
    a /= 2;
    a %= ivec2(3);
    return float(a.x + a.y * 10) + float(b.y) * 100.0;
}
//! int_division_by_zero
float sdf(vec3 p) { int n = int(p.x * 0.001); return float(7 / n) + float(7 % n) + p.y; }
//! int_division_of_the_least
float sdf(vec3 p)
{
    int least = -2147483647 - 1 + int(p.x * 0.001), minus = -1 + int(p.x * 0.001);
    return float(least / minus) + float(least % minus) + p.y;
}
//! int_bits
float sdf(vec3 p)
{
    int a = int(p.x * 100.0);
    return float((a & 15) | 32) + float(a ^ 5) + float(~a) + float(a << 2) + float(a >> 1);
}
//! int_wraps
float sdf(vec3 p)
{
    int a = 2147483647;
    a += int(p.x > 9.0) + 1;
    uint b = 0u;
    b -= 1u;
    return float(a) + float(b);
}
//! shift_kept
float sdf(vec3 p)
{
    int n = 33 + int(p.x * 0.001);
    ivec2 v = ivec2(1, 2) << n;
    v.y >>= n;
    return float(1 << n) + float(-8 >> n) + float(8u >> 34) + float(v.x + v.y);
}
//! hash
float sdf(vec3 p)
{
    uint h = uint(int(floor(p.x * 8.0))) * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28) + 4u)) ^ h) * 277803737u;
    return float(((h >> 22u) ^ h) & 0xffffu) / 65536.0;
}
//! outside_of_domains
float sdf(vec3 p)
{
    return sqrt(-1.0 - p.x * p.x) + acos(2.0 + abs(p.x)) + asin(-2.0 - abs(p.x)) +
           length(normalize(p * 0.0)) + atan(p.x * 0.0, p.y * 0.0);
}
//! pow_of_negative
float sdf(vec3 p) { return pow(-abs(p.x) - 0.5, 2.0) + pow(p.x * 0.0, 0.5) + pow(p.x * 0.0, 0.0); }
//! mod_of_zero
float sdf(vec3 p) { float n = p.x * 0.0; return mod(p.y, n) + fmod(p.z, n) + mod(-1.5, 1.0); }
//! smoothstep_backwards
float sdf(vec3 p) { return smoothstep(1.0, 0.0, p.x) + smoothstep(p.y, p.y, p.y); }
//! constants
float sdf(vec3 p)
{
    const float A = 2.0, B = A * A + sin(0.0);
    const vec2 V = vec2(A, B).yx;
    return V.x * p.x + B;
}
//! constant_in_function
float sdf(vec3 p)
{
    const float k = p.x * 2.0;
    const int n = 2;
    float a[n + 1];
    a[2] = k;
    return a[n];
}
//! global_constants
const float R = 0.5;
const float T[3] = float[3](1.0, 2.0, R);
static const int N = 3;
float K = R * 2.0;
const mat2 M = mat2(K, 2.0, 3.0, 4.0);
float sdf(vec3 p)
{
    float s = 0.0;
    for (int i = 0; i < N; i++) s += T[i] * p.x;
    return s + (M * p.xy).x;
}
//! functions
float ball(vec3 p, float r) { return length(p) - r; }
float sdf(vec3 p) { return min(ball(p, 0.5), ball(p - vec3(1, 0, 0), 0.25)); }
//! overloads
float f(float a) { return a; }
float f(vec2 a) { return a.x * 2.0; }
float f(int a) { return 7.0; }
float f(float a, float b) { return a - b; }
float sdf(vec3 p) { return f(p.x) + f(p.xy) + f(1) + f(1, p.z); }
//! out_and_inout
void turn(inout vec2 v, out float old, const in float by)
{
    old = v.x;
    v = vec2(-v.y, v.x) * by;
}
float sdf(vec3 p)
{
    float x = 9.0;
    turn(p.zy, x, 2.0);
    return p.y + 10.0 * p.z + 100.0 * x;
}
//! out_to_array
void set(out float a, inout float b) { a = 2.0; b += 1.0; }
float sdf(vec3 p)
{
    float a[3];
    int i = int(p.x > 0.0);
    set(a[i], a[i + 1]);
    return a[0] + 10.0 * a[1] + 100.0 * a[2];
}
//! out_is_zero_at_first
float f(out float a) { return a; }
float sdf(vec3 p) { float a = 3.0, b = f(a); return a + b + p.x; }
//! parameters_are_copies
float f(vec3 q) { q *= 2.0; return q.x; }
float sdf(vec3 p) { return f(p) + f(f(p) * p) + p.x; }
//! array_parameter
float sum(float a[3]) { a[0] += 1.0; return a[0] + a[1] + a[2]; }
float sdf(vec3 p) { float a[3] = float[3](p.x, p.y, p.z); return sum(a) + a[0]; }
//! declared_first
float g(float);
float sdf(vec3 p) { return g(p.x) * 2.0; }
float g(float a) { return a + 1.0; }
//! hides_ours
float mod(float a, int b) { return 5.0; }
float saturate(float a) { return a * 3.0; }
float sdf(vec3 p) { return mod(p.x, 2) + mod(p.x, 2.0) + saturate(p.y); }
//! hidden_names
float sdf(vec3 p)
{
    float k = p.x;
    {
        float k = p.y;
        { float p = 4.0; k += p; }
    }
    for (int k = 0; k < 2; k++) {}
    return k;
}
//! names_of_drivers
float main(float sample) { return sample; }
float sdf(vec3 p)
{
    float sin = p.x, numbers = 2.0, map = 3.0, texture2 = 1.0, N = 1.0, output = 1.0;
    return sin(sin) * numbers + map * texture2 + N + main(output);
}
//! precision_words
precision highp float; ;
highp float f(mediump vec2 v) { lowp float a = v.x; return a; }
float sdf(vec3 p) { return f(p.xy); }
//! attributes
float sdf(vec3 p)
{
    float s = 0.0;
    [unroll] for (int i = 0; i < 2; i++) s += p.x;
    [loop] for (int i = 0; i < 2; i++) { [branch] if (i > 0) s += 1.0; }
    [unroll(2)] for (int i = 0; i < 2; i++) {}
    return s;
}
//! any_name
float thing(vec3 q) { return 3.0; }
float torus(float3 q) { return length(vec2(length(q.xz) - 1.0, q.y)) - 0.25; }
//! sdf_comes_first
float sdf(vec3 p) { return p.x; }
float other(vec3 p) { return 2.0; }
//! takes_primitive
float help(Primitive3D q, int i) { return q.data[i]; }
float f(vec3 p, Primitive3D primitive)
{
    return p.x + help(primitive, 3) + primitive.data[1] + float(primitive.id);
}
//! smooth_union
float smin(float a, float b, float k)
{
    float h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0);
    return mix(b, a, h) - k * h * (1.0 - h);
}
float sdf(vec3 p) { return smin(p.y, length(p) - 1.0, 0.5); }
//! octaves
float sdf(vec3 p)
{
    float s = 0.0, w = 1.0;
    for (int i = 0; i < 5; i++) {
        float f = float(i + 1);
        s += w * sin(p.x * f + p.y) * cos(p.z * f);
        w *= 0.5;
    }
    return s;
}
//! cells
float sdf(vec3 p)
{
    return checker(p) + 2.0 * stripes(p.x) + 4.0 * step(0.0, hash(p)) * step(hash(p), 1.0);
}
//! noise_between_chances
float sdf(vec3 p) { return noise(floor(p)) + 1.0 - 2.0 * hash(p); }
//! octaves_of_noise
float sdf(vec3 p)
{
    return fbm(p, 0) + fbm(p, 1) - noise(p) + fbm(p, 99) - fbm(p, 8);
}
//! three_weights
float sdf(vec3 p)
{
    float3 w = triplanar(p);
    float even = 6.0 * triplanar(vec3(0)).z, along = triplanar(vec3(0, -9, 0)).y;
    return dot(w, float3(1, 1, 1)) + w.y / w.x + even + along;
}
