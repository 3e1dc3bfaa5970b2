/* SPDX-License-Identifier: MIT */
/* Making texts at the bound. */
#include "bound_code.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"

enum { WIDE_MAX = 8, FUNCTIONS_MAX = 3, CHOSEN_MAX = 5 };

/* A letter behind $ is a variable of a type, of those that are there; # is a number. Each statement
 * reads what earlier ones wrote. */
static const struct kind {
    const char *name, *text;
} kinds[] = {
    /* clang-format off */
    {"sum", "$f = $f + $g * 0.5;"},
    {"product", "$f = $f * $g + $t.x; $g = $g * $f + $t.y;"},
    {"quotient", "$f = $f / $g;"},
    {"quotient of vectors", "$v = $v / $x.yzwx;"},
    {"products of vectors", "$v = $v * $x.wxyz + vec4($f, $g, $t.x, #.0);"},
    {"negation", "$f = -$f; $g = -$g + $f;"},
    {"steps", "$f++; ++$g; $f = $g-- + $f;"},
    {"swizzles", "$v = $v.wzyx; $v.xy = $x.zw;"},
    {"numbers", "$v += vec4(#.1, #.2, #.3, #.4);"},
    {"matrices", "$m = $m * $o;"},
    {"small matrices", "$n = $n * $l; $t = $n * $t;"},
    {"matrix and vector", "$v = $m * $v; $m[0] = $v;"},
    {"vector and matrix", "$v = $v * $m; $m[1] = $v;"},
    {"made matrices", "$m = mat4($v, $x, $m[0], $m[1]); $v = $m[3];"},
    {"matrices of numbers", "$m = mat4($f) * $m[0][0]; $f = $m[1][1];"},
    {"matrices of matrices", "$m = mat4($n); $n = mat3($m);"},
    {"equal matrices", "$b = $m == $m * $f; $f = $b ? $g : $t.x;"},
    {"transposed", "$m = transpose($m) + $m;"},
    {"outer product", "$m = outerProduct($v, $m[0]);"},
    {"component products", "$m = matrixCompMult($m, $o);"},
    {"determinant", "$f = determinant($m); $m[0][1] = $f;"},
    {"inverse", "$m = inverse($m);"},
    {"small inverse", "$n = inverse($n);"},
    {"whole quotient", "$i = $i / ($j + #); $j = $i % ($i + $j);"},
    {"whole quotient by a constant", "$i = $i / #; $j = $j % # + $i;"},
    {"whole quotients", "$w = $w / ($w.yzwx + #);"},
    {"whole remainders", "$w = $w % ($w.yzwx + #);"},
    {"unsigned quotient", "$u = $u / ($u + #u) + uint($i);"},
    {"shifts", "$w = ($w << $w.yzwx) ^ ($w >> 2) + #;"},
    {"bits", "$i = ($i ^ $j) & ($i | #) << ($j >> 1);"},
    {"whole products", "$i = $i * $j + #; $j = $j * $i;"},
    {"into whole", "$f = float(int($f * 3.0 + $g)); $g = float(uint($g + $f) + #u);"},
    {"vectors into whole", "$v = vec4(ivec4($v * 3.0)) + #.0;"},
    {"into booleans", "$v = vec4(bvec4($w)) + $v; $w = ivec4($v);"},
    {"whole clamp", "$w = clamp($w, $w.yzwx, $w.zwxy);"},
    {"whole least", "$i = min($i + #, max($j, $i)); $j = abs($i - $j);"},
    {"branch", "if ($f < $g) $f += $g; else $g = $f * 0.5;"},
    {"branch of both", "if ($f < $g && $g < $t.x + #.0 && $t.x < $t.y) $f += $g; else $g += $f;"},
    {"early return", "if ($f < $g + #.0) return RETURN($t.x);"},
    {"returns in branches",
     "if ($f < $g) { $f += $g; } else { if ($g < $f + #.0) return RETURN($f); $g += $f; }"},
    {"logic", "$b = $b && $f < $g || $g < $f + #.0 && $t.x < $f;"},
    {"exclusive or", "$b = $b ^^ ($f < $g); $f = $b ? $g : $f + $t.x;"},
    {"choice", "$f = $f < $g ? $f + $g : $g * $f + #.0;"},
    {"choice of vectors", "$v = $f < $g ? $v + $x : $x * $f; $f = $v.x;"},
    {"tests", "$b = any(lessThan($v, $x.yzwx)); $f = $b ? $g : $f; $v.x = $f;"},
    {"no number", "$b = isnan($f / ($g + 2.0)); $f = $b ? $g : $f * $f;"},
    {"broken loop",
     "for (int k# = 0; k# < 2; k#++) { $f += $g * $f; if ($f < $g) break; $g += $f; }"},
    {"continued loop",
     "for (int k# = 0; k# < 2; k#++) { if ($f < $g) continue; $g = $g * $f + #.0; }"},
    {"loop", "for (int k# = 0; k# < 8; k#++) { $f = $f * $g + 0.5; $g = $f * 0.5 + $t.y; }"},
    {"loop of loops",
     "for (int k# = 0; k# < 4; k#++) for (int h# = 0; h# < 3; h#++) { $f = $f * $g + float(h#); }"},
    {"loop that could be written out", "for (int k# = 0; k# < 31; k#++) { $f = sin($f + $g); }"},
    {"loop of an array",
     "for (int k# = 0; k# < 8; k#++) { $r[k#] = sin($f); $f = $r[7 - k#] * $g; }"},
    {"return in a loop",
     "for (int k# = 0; k# < 4; k#++) { if ($f < $g) return RETURN($f); $f *= 0.5; }"},
    {"index", "$v[$i] = $f; $f = $x[$j] + $g;"},
    {"indices", "$m[$i][$j] = $f; $f = $m[$j][$i];"},
    {"columns", "$m[$i] = $v; $v = $m[$j];"},
    {"array", "$r[$i] = $f; $f = $r[$j] + $g;"},
    {"array read", "$f = $r[$i] + $r[$j] * $g;"},
    {"array of vectors", "$q[$i] = $v; $v = $q[$j];"},
    {"array of vectors by two", "$q[$i][$j] = $f; $f = $q[$j][$i];"},
    {"array in a loop", "for (int k# = 0; k# < 8; k#++) { $r[k#] = $f; $f = $r[7 - k#] * $g; }"},
    {"sin", "$f = sin($f);"}, {"cos of vectors", "$v = cos($v);"},
    {"tan", "$f = tan($f);"}, {"tan of vectors", "$v = tan($v);"},
    {"asin", "$f = asin($f);"}, {"acos", "$f = acos($f);"}, {"acos of vectors", "$v = acos($v);"},
    {"atan", "$f = atan($f);"}, {"atan of two", "$f = atan($f, $g);"},
    {"atan of vectors", "$v = atan($v, $x.yzwx);"},
    {"sinh", "$v = sinh($v);"}, {"cosh", "$f = cosh($f);"}, {"tanh", "$v = tanh($v);"},
    {"asinh", "$f = asinh($f);"}, {"acosh", "$v = acosh($v);"}, {"atanh", "$f = atanh($f);"},
    {"pow", "$f = pow($f, $g);"}, {"pow of vectors", "$v = pow($v, $x.yzwx);"},
    {"exp", "$f = exp($f);"}, {"exp2 of vectors", "$v = exp2($v);"},
    {"log", "$f = log($f);"}, {"log10 of vectors", "$v = log10($v);"},
    {"sqrt", "$f = sqrt($f) + $g;"}, {"inversesqrt", "$v = inversesqrt($v) + $x.yzwx;"},
    {"rcp", "$f = rcp($f) + $g;"}, {"abs", "$v = abs($v) - $x.yzwx;"},
    {"sign", "$v = sign($v) + $x.yzwx;"}, {"floor", "$v = floor($v) + $x.yzwx;"},
    {"round", "$f = round($f) + $g * 0.3;"}, {"fract", "$v = fract($v) + $x.yzwx;"},
    {"mod", "$f = mod($f, $g) + $t.x;"}, {"mod of vectors", "$v = mod($v, $x.yzwx) + $v;"},
    {"fmod", "$f = fmod($f, $g) + $t.x;"}, {"min and max", "$v = min($v, max($x.yzwx, $f));"},
    {"clamp", "$v = clamp($v, $x.yzwx, $v.zwxy);"}, {"saturate", "$f = saturate($f) + $g;"},
    {"mix", "$v = mix($v, $x.yzwx, $v.zwxy);"}, {"step", "$v = step($v, $x.yzwx) + $v;"},
    {"smoothstep", "$f = smoothstep($f, $g, $t.x); $g = $f + $t.y;"},
    {"smoothstep of vectors", "$v = smoothstep($v, $x.yzwx, $v.zwxy);"},
    {"length", "$v.x = length($v);"}, {"distance", "$f = distance($t, $s); $t.x = $f;"},
    {"dot", "$f = dot($v, $x); $v.x = $f;"}, {"cross", "$t = cross($t, $s) + $t;"},
    {"normalize",
     "$v = normalize($v) + $x.yzwx;"}, {"faceforward", "$t = faceforward($t, $s, $t.zxy);"},
    {"reflect",
     "$t = reflect($t, $s); $s.x = $t.y;"}, {"refract", "$t = refract($t, $s, $f); $f = $t.x;"},
    {"noise", "$f = noise($t); $t.x = $f;"}, {"fbm", "$f = fbm($t, 8); $t.x = $f;"},
    {"fbm of octaves", "$f = fbm($t, $i); $t.x = $f;"}, {"hash", "$f = hash($t); $t.x = $f;"},
    {"checker", "$f = checker($t); $t.x = $f + $g;"}, {"stripes", "$f = stripes($f) + $g;"},
    {"triplanar", "$t = triplanar($t) + $s;"},
    {"call", "$f = called($f) + $g;"}, {"call out of branches", "$f = branched($f) + $g;"},
    {"call that changes", "changed($v, $m, $f); $f = $v.x;"},
    {"call with an array", "$f = summed($r) + $g; $r[1] = $f;"},
    /* clang-format on */
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const char called[] =
    "float called(float x) { return x * x + 1.0; }\n"
    "float branched(float x) { if (x > 1.0) return 2.0; if (x > 0.5) return x * 3.0; return x; }\n"
    "void changed(inout vec4 x, out mat4 y, in float z) { y = mat4(z); x = x + y[1] + z; }\n"
    "float summed(float x[8]) { return x[0] + x[3] * x[7]; }\n";

struct maker {
    struct random *random;
    FILE *out;
    const struct kind *chosen[CHOSEN_MAX];
    size_t chosen_count;
    size_t wide; /* variables of each type; 1: a chain */
    bool nested;
    size_t functions;
    int number; /* counted on */
};

size_t bound_code_kinds(void)
{
    return KINDS;
}

const char *bound_code_kind(size_t kind)
{
    return kinds[kind].name;
}

/* --- statements --- */

/* The letters of a type stand for one variable each where there are few. */
static void write_variable(struct maker *maker, char letter)
{
    static const char *const letters[] = {"fg", "ts", "vx", "ij", "u", "b",
                                          "w",  "mo", "nl", "r",  "q"};

    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
        const char *found = strchr(letters[i], letter);
        if (found) {
            const size_t other = (size_t)(found - letters[i]);
            const bool few = strchr("rq", letter) != NULL;
            const size_t which =
                maker->wide > 1 && !few ? random_below(maker->random, maker->wide) : other;
            fprintf(maker->out, "%c%zu", letters[i][0], which);
            return;
        }
    }
    abort();
}

static void write_text(struct maker *maker, const char *text)
{
    maker->number = maker->number % 90 + 1;
    for (; *text; text++) {
        if (*text == '$') {
            write_variable(maker, *++text);
        } else if (*text == '#') {
            fprintf(maker->out, "%d", maker->number + 9);
        } else {
            fputc(*text, maker->out);
        }
    }
}

static void write_plain(struct maker *maker)
{
    write_text(maker, maker->chosen[random_below(maker->random, maker->chosen_count)]->text);
}

static void write_several(struct maker *maker, size_t most)
{
    for (size_t i = 1 + random_below(maker->random, most); i > 0; i--) {
        write_plain(maker);
    }
}

static void write_nested(struct maker *maker, int depth)
{
    static const char *const heads[] = {
        "if ($f < $g) {", "for (int L# = 0; L# < 4; L#++) {", "{",
        "for (float L# = 0.0; L# < 2.5; L# += 1.0) { if ($f < $g + L#) break;"};

    enum { HEADS = sizeof heads / sizeof heads[0] };
    const size_t which = random_below(maker->random, HEADS);

    write_text(maker, heads[which]);
    write_several(maker, 4);
    if (depth > 0 && random_below(maker->random, 2) == 0) {
        write_nested(maker, depth - 1);
    }
    fputs(which == 0 ? "} else {" : "", maker->out);
    if (which == 0) {
        write_several(maker, 2);
    }
    fputs("}\n", maker->out);
}

static void write_statement(struct maker *maker)
{
    const size_t kind = maker->nested ? random_below(maker->random, 6) : 0;

    if (kind == 4) {
        write_nested(maker, 2);
    } else if (kind == 5 && maker->functions > 0) {
        fprintf(maker->out, "fun%zu", random_below(maker->random, maker->functions));
        write_text(maker, "($f, $v, $i);\n");
    } else {
        write_plain(maker);
        fputc('\n', maker->out);
    }
}

/* --- texts --- */

static void write_variables(struct maker *maker)
{
    const size_t count = maker->wide > 1 ? maker->wide : 2;

    for (size_t i = 0; i < count; i++) {
        fprintf(maker->out,
                "float f%zu = p.x + %zu.5; vec3 t%zu = p * %zu.5; vec4 v%zu = vec4(p, %zu);"
                "int i%zu = int(p.y * %zu.5); uint u%zu = uint(i%zu); bool b%zu = p.z > %zu.0;"
                "ivec4 w%zu = ivec4(1, i%zu, 2, 3); mat4 m%zu = mat4(v%zu, v%zu, v%zu, v%zu);"
                "mat3 n%zu = mat3(t%zu, t%zu, t%zu);\n",
                i, i, i, i, i, i, i, i + 1, i, i, i, i, i, i, i, i, i, i, i, i, i, i, i);
    }
    fputs("float r0[8]; vec4 q0[8];\n", maker->out);
}

static void write_result(struct maker *maker)
{
    const size_t count = maker->wide > 1 ? maker->wide : 2;

    fputs("return RETURN(p.x", maker->out);
    for (size_t i = 0; i < count; i++) {
        fprintf(maker->out,
                " + f%zu + t%zu.x + v%zu.y + float(i%zu) + float(u%zu) + float(b%zu) + "
                "float(w%zu.x) + m%zu[1][2] + n%zu[0][1]",
                i, i, i, i, i, i, i, i, i);
    }
    fputs(" + r0[1] + q0[2].x);\n}\n", maker->out);
}

/* RETURN(x) as the type of the function that is called has it. */
static char *replace_returns(char *text, enum code_use use)
{
    char *out = NULL;
    size_t length;
    FILE *file = open_memstream(&out, &length);
    const char *from = text, *found;

    while ((found = strstr(from, "RETURN"))) {
        fwrite(from, 1, (size_t)(found - from), file);
        fputs(use == CODE_SHADE ? "vec3" : "float", file);
        from = found + strlen("RETURN");
    }
    fputs(from, file);
    fclose(file);
    free(text);
    return out;
}

static char *make_text(struct maker maker, enum code_use use, size_t statements)
{
    struct random random = *maker.random;
    char *text = NULL;
    size_t length;

    maker.random = &random;
    maker.out = open_memstream(&text, &length);
    fputs(called, maker.out);
    for (size_t i = 0; i < maker.functions; i++) {
        fprintf(maker.out,
                "void fun%zu(inout float f0, inout vec4 v0, in int i0) {\n"
                "float f1 = v0.x; vec4 v1 = v0.yzwx; int i1 = i0 + 1;"
                "for (int k = 0; k < 3; k++) { f0 = f0 * f1 + v1.x; }"
                "v0 = v0 * f0 + sin(v1); f0 = float(i1) * 0.5 + v0.z; }\n",
                i);
    }
    fputs(use == CODE_SHADE ? "vec3 shade(FragmentProperties properties) {\n"
                              "vec3 p = properties.object_position;\n"
                            : "float sdf(vec3 p) {\n",
          maker.out);
    write_variables(&maker);
    for (size_t i = 0; i < statements; i++) {
        write_statement(&maker);
    }
    write_result(&maker);
    fclose(maker.out);
    return replace_returns(text, use);
}

static bool is_accepted(const struct maker *maker, enum code_use use, size_t statements)
{
    static const struct param nothing[] = {{.name = NULL}};
    char *text = make_text(*maker, use, statements);
    struct code *code = code_compile(&(struct code_source){use, text, nothing, false}, NULL);
    const bool accepted = code != NULL;

    code_destroy(code);
    free(text);
    return accepted;
}

static size_t most_statements(const struct maker *maker, enum code_use use)
{
    size_t low = 0, high = LIMIT_CODE_BYTES / 8;

    while (low < high) {
        const size_t middle = (low + high + 1) / 2;
        if (is_accepted(maker, use, middle)) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

char *bound_code_make(struct random *random, enum code_use use, int kind, double share)
{
    static const size_t wides[] = {1, 2, 3, WIDE_MAX};
    struct maker maker = {.random = random, .chosen_count = 1, .wide = 1};

    if (kind >= 0) {
        maker.chosen[0] = &kinds[kind];
    } else {
        maker.wide = wides[random_below(random, sizeof wides / sizeof wides[0])];
        maker.chosen_count = 1 + random_below(random, CHOSEN_MAX);
        maker.nested = random_below(random, 3) > 0;
        maker.functions = random_below(random, FUNCTIONS_MAX + 1);
        for (size_t i = 0; i < maker.chosen_count; i++) {
            maker.chosen[i] = &kinds[random_below(random, KINDS)];
        }
    }
    char *text = make_text(maker, use, (size_t)(share * (double)most_statements(&maker, use)));
    random_below(random, 2); /* another one next time */
    return text;
}
