/* SPDX-License-Identifier: MIT */
/* What the environment's GLSL and the maps made for it say of the light, against closed forms and
 * sums taken here. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/draw/asset.h"
#include "renderer/draw/environment.h"
#include "renderer/gl/egl.h"
#include "renderer/gl/pass.h"
#include "renderer/image/decode.h"

enum { ASKED_MAX = 512, WIDTH = 64, HEIGHT = 32 };

/* A question about a direction or a ray: what is asked, and up to seven numbers. */
enum { ASK_SKY, ASK_MATT, ASK_MIRROR, ASK_FOG };
struct question {
    float what, number, unused[2], origin[4], direction[4];
};

static const char questions_glsl[] =
    "#include \"fog.glsl\"\n#include \"sky.glsl\"\n"
    "layout(local_size_x = 64) in;\n"
    "struct Question { vec4 what, origin, direction; };\n"
    "layout(std430, binding = 3) readonly buffer Questions { Question questions[]; };\n"
    "layout(std430, binding = 4) writeonly buffer Answers { vec4 answers[]; };\n"
    "void main()\n"
    "{\n"
    "    Question q = questions[gl_GlobalInvocationID.x];\n"
    "    vec3 d = normalize(q.direction.xyz);\n"
    "    int what = int(q.what.x);\n"
    "    Ray ray = Ray(q.origin.xyz, d, 0.0, false, 0.0);\n"
    "    answers[gl_GlobalInvocationID.x] =\n"
    "        what == 0 ? vec4(sky(d, eye_spread()), 0.0)\n"
    "        : what == 1 ? vec4(sky_irradiance(d), 0.0)\n"
    "        : what == 2 ? vec4(sky_specular(d, q.what.y, 0.0), 0.0) : fog(ray, q.what.y);\n"
    "}\n";

static struct egl egl;
static struct gl gl;
static struct pass asking;
static struct environments *environments;
static GLuint buffers[3];

static int set_up(void **state)
{
    const struct glsl_file own[] = {{"questions.glsl", questions_glsl}, {NULL, NULL}};
    const struct device_params params = {.index = -1};
    const struct pass_source source = {.compute = true, .file = "questions.glsl", .own = own};
    struct error err = {0};

    (void)state;
    if (!egl_init(&egl, &params, &err) || !gl_load(&gl, &err) ||
        !pass_init(&asking, &gl, &source, &err) || !(environments = environments_create(&gl))) {
        error_print(&err, stderr);
        return -1;
    }
    gl.GenBuffers(3, buffers);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    gl.DeleteBuffers(3, buffers);
    environments_destroy(environments);
    pass_finish(&asking, &gl);
    egl_finish(&egl);
    return 0;
}

/* --- asking --- */

static void ask(const struct frame_uniforms *block, struct environment *environment,
                const struct question *questions, size_t count, float (*answers)[4])
{
    environment_bind(environment, &gl);
    gl.BindBuffer(GL_UNIFORM_BUFFER, buffers[0]);
    gl.BufferData(GL_UNIFORM_BUFFER, sizeof *block, block, GL_STREAM_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, buffers[0]);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, buffers[1]);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, ASKED_MAX * sizeof *questions, NULL, GL_STREAM_DRAW);
    gl.BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)(count * sizeof *questions),
                     questions);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, buffers[2]);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, ASKED_MAX * 16, NULL, GL_STREAM_READ);
    gl.UseProgram(asking.program);
    gl.DispatchCompute(ASKED_MAX / 64, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)(count * 16), answers);
    assert_int_equal(gl.GetError(), GL_NO_ERROR);
}

static struct question question(int what, double number, double x, double y, double z)
{
    return (struct question){
        .what = (float)what, .number = (float)number, .direction = {(float)x, (float)y, (float)z}};
}

static struct environment *get(const struct frame_uniforms *block, const struct asset *image,
                               uint32_t *out_us)
{
    const char *id = image ? image->id : "";
    const bool read = block->sky_kind == SKY_IMAGE && !environments_have(environments, block, id);
    struct engine_map maps[ENGINE_MAPS] = {0};
    struct environment *environment;

    if (read) {
        struct decoded decoded = {0};

        assert_true(image_decode(image->bytes, image->length, NULL, &decoded, NULL));
        engine_maps_make(block, decoded.rgba, decoded.width, decoded.height, maps);
    }
    environment = environments_get(environments, block, id, read ? maps : NULL, out_us);
    assert_non_null(environment);
    return environment;
}

/* One answer about one direction. */
static void ask_one(struct frame_uniforms *block, struct asset *image, struct question question,
                    float answer[4])
{
    uint32_t us;
    struct environment *environment = get(block, image, &us);

    ask(block, environment, &question, 1, (float(*)[4])answer);
    environment_unref(environments, environment);
}

static struct frame_uniforms plain_block(int kind)
{
    return (struct frame_uniforms){.ambient = 1,
                                   .sky_rotation = {1, 0},
                                   .sky_brightness = 1,
                                   .max_distance = 200,
                                   .sky_kind = kind};
}

static void set3(float *out, float r, float g, float b)
{
    out[0] = r;
    out[1] = g;
    out[2] = b;
}

static void assert_near(double actual, double expected, double tolerance, const char *what)
{
    if (!(fabs(actual - expected) <= tolerance)) {
        fail_msg("%s: %.6g, not %.6g", what, actual, expected);
    }
}

/* --- pictures, as files --- */

static uint32_t seed = 1;

static double random_one(void)
{
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) / 16777216.0;
}

static void random_direction(double out[3])
{
    const double z = 2 * random_one() - 1, angle = 6.283185307 * random_one(), r = sqrt(1 - z * z);

    out[0] = r * cos(angle);
    out[1] = z;
    out[2] = r * sin(angle);
}

/* The direction in the middle of a pixel, by the words of glsl/sky.glsl. */
static void pixel_direction(int x, int y, double out[3])
{
    const double longitude = ((x + 0.5) / WIDTH - 0.5) * 2 * M_PI,
                 latitude = (y + 0.5) / HEIGHT * M_PI;

    out[0] = sin(latitude) * sin(longitude);
    out[1] = cos(latitude);
    out[2] = -sin(latitude) * cos(longitude);
}

/* A Radiance file in flat rows out of radiances that are k/128 * 2^e. */
static struct asset *make_file(void (*color)(const double d[3], double rgb[3]), const char *name)
{
    struct asset *asset = NULL;
    static uint8_t bytes[128 + 4 * WIDTH * HEIGHT];
    size_t length = (size_t)sprintf(
        (char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", HEIGHT, WIDTH);

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double d[3], rgb[3];
        int exponent = 0;

        pixel_direction(i % WIDTH, i / WIDTH, d);
        color(d, rgb);
        frexp(fmax(rgb[0], fmax(rgb[1], rgb[2])), &exponent);
        for (int k = 0; k < 3; k++) {
            bytes[length++] = (uint8_t)fmin(255, round(ldexp(rgb[k], 8 - exponent)));
        }
        bytes[length++] = (uint8_t)(exponent + 128);
    }
    asset = calloc(1, sizeof *asset);
    snprintf(asset->id, sizeof asset->id, "%s", name);
    asset->bytes = bytes;
    asset->length = length;
    return asset;
}

static void uniform_color(const double d[3], double rgb[3])
{
    (void)d;
    rgb[0] = rgb[1] = rgb[2] = 1;
}

/* --- tests --- */

/* An environment of 1 gives 1, however it is made. */
static void uniform_sky_gives_one(void **state)
{
    struct asset *file = make_file(uniform_color, "uniform");

    (void)state;
    for (int kind = SKY_GRADIENT; kind <= SKY_IMAGE; kind++) {
        struct frame_uniforms block = plain_block(kind);

        set3(block.zenith, 1, 1, 1);
        set3(block.horizon, 1, 1, 1);
        set3(block.ground, 1, 1, 1);
        for (int i = 0; i < 100; i++) {
            double d[3];
            float answer[4];
            const double roughness = i % 10 / 9.0;
            random_direction(d);
            for (int what = ASK_SKY; what <= ASK_MIRROR; what++) {
                ask_one(&block, kind == SKY_IMAGE ? file : NULL,
                        question(what, roughness, d[0], d[1], d[2]), answer);
                assert_near(answer[i % 3], 1, 0.002, "light in an environment of 1");
            }
        }
    }
    free(file);
}

static void half_white(const double d[3], double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = d[0] > 0 ? 2 : 1e-6;
}

/* Half of the sky white: on a surface at angle a to its axis falls (1 + cos a) / 2 of all. */
static void half_a_sky_lights_by_its_angle(void **state)
{
    struct asset *file = make_file(half_white, "half");

    (void)state;
    for (int i = 0; i < 200; i++) {
        struct frame_uniforms block = plain_block(SKY_IMAGE);
        double d[3];
        float answer[4];

        random_direction(d);
        block.ambient = 0.5;
        ask_one(&block, file, question(ASK_MATT, 0, d[0], d[1], d[2]), answer);
        assert_near(answer[0], (1 + d[0]) / 2, 0.01, "irradiance of a half white sky");
    }
    free(file);
}

static double lobe(double roughness, const double n[3], const double towards[3])
{
    double a2 = pow(roughness, 4), h[3], length = 0, c = 0, l = 0;

    for (int i = 0; i < 3; i++) {
        h[i] = n[i] + towards[i];
        length += h[i] * h[i];
        l += n[i] * towards[i];
    }
    if (l <= 0) {
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        c += n[i] * h[i] / sqrt(length);
    }
    const double peak = c * c * (a2 - 1) + 1;
    return l * a2 / (peak * peak);
}

static void smooth_color(const double d[3], double rgb[3])
{
    rgb[0] = 1 + 0.9 * d[0];
    rgb[1] = 0.5 + 0.4 * d[1] * d[2];
    rgb[2] = 0.2 + 1.5 * exp(6 * (0.6 * d[1] - 0.8 * d[2] - 1));
}

/* What rough surfaces mirror is the mean over the lobe. */
static void rough_reflections_are_means_of_the_lobe(void **state)
{
    struct asset *file = make_file(smooth_color, "smooth");
    struct frame_uniforms block = plain_block(SKY_IMAGE);

    (void)state;
    for (int i = 0; i < 60; i++) {
        const double roughness = (1 + i % 4) / 4.0;
        double n[3], sum[3] = {0}, weights = 0;
        float answer[4];

        random_direction(n);
        for (int k = 0; k < 40 * WIDTH * HEIGHT; k++) {
            double d[3], rgb[3], weight;
            random_direction(d);
            smooth_color(d, rgb);
            weight = lobe(roughness, n, d);
            weights += weight;
            for (int c = 0; c < 3; c++) {
                sum[c] += weight * rgb[c];
            }
        }
        ask_one(&block, file, question(ASK_MIRROR, roughness, n[0], n[1], n[2]), answer);
        for (int c = 0; c < 3; c++) {
            assert_near(answer[c], sum[c] / weights, 0.05, "mirrored light");
        }
    }
    free(file);
}

/* Where a picture shows what; its turn is about +Y, by the right hand. */
static void sides_color(const double d[3], double rgb[3])
{
    rgb[0] = d[0] > 0 ? 1 : 0;
    rgb[1] = d[1] > 0 ? 1 : 0;
    rgb[2] = d[2] > 0 ? 1 : 0.25;
}

static void sides_lie_where_rays_look(void **state)
{
    struct asset *file = make_file(sides_color, "sides");

    (void)state;
    for (int i = 0; i < 300; i++) {
        struct frame_uniforms block = plain_block(SKY_IMAGE);
        const double turn = i % 5 * 1.3;
        double d[3], rgb[3];
        float answer[4];

        random_direction(d);
        if (fabs(d[0]) < 0.15 || fabs(d[1]) < 0.15 || fabs(d[2]) < 0.15) {
            continue; /* between two colours */
        }
        block.sky_rotation[0] = (float)cos(turn);
        block.sky_rotation[1] = (float)sin(turn);
        block.sky_brightness = 3;
        sides_color(d, rgb);
        ask_one(&block, file,
                question(ASK_SKY, 0, cos(turn) * d[0] + sin(turn) * d[2], d[1],
                         cos(turn) * d[2] - sin(turn) * d[0]),
                answer);
        for (int c = 0; c < 3; c++) {
            assert_near(answer[c], 3 * rgb[c], 0.02, "the picture's colour in a direction");
        }
    }
    free(file);
}

/* Neither where longitudes meet nor at the poles does anything jump. */
static void nothing_jumps_at_seams_and_poles(void **state)
{
    struct asset *file = make_file(smooth_color, "smooth");
    struct frame_uniforms block = plain_block(SKY_IMAGE);

    (void)state;
    for (int i = 0; i < 100; i++) {
        const double height = i < 50 ? i / 26.0 - 0.96 : i % 2 ? 400 : -400;
        const double angle = i * 0.7, e = 1e-3;
        const bool pole = i >= 50;
        float a[4], b[4];

        for (int what = ASK_SKY; what <= ASK_MIRROR; what++) {
            if (pole && what == ASK_SKY) {
                continue; /* a picture's own first row is as it is */
            }
            ask_one(&block, file,
                    question(what, 0.5, pole ? cos(angle) : e, height, pole ? sin(angle) : 1), a);
            ask_one(&block, file,
                    question(what, 0.5, pole ? -cos(angle) : -e, height, pole ? -sin(angle) : 1),
                    b);
            for (int c = 0; c < 3; c++) {
                assert_near(a[c], b[c], pole ? 0.05 : 0.01, "light on both sides of a seam");
            }
        }
    }
    free(file);
}

/* The sun's disc is seen, and gives no light besides the directional light's own. */
static void disc_of_the_sun_gives_no_light(void **state)
{
    struct frame_uniforms block = plain_block(SKY_GRADIENT);
    const struct frame_light sun = {.position = {0, 0.6f, -0.8f}, .color = {1000, 1000, 1000}};
    float seen[4], mirrored[4], without[4];

    (void)state;
    block.light_count = 1;
    block.lights[0] = sun;
    block.effects = EFFECT_SUN;
    ask_one(&block, NULL, question(ASK_SKY, 0, 0, 0.6, -0.8), seen);
    ask_one(&block, NULL, question(ASK_MIRROR, 0, 0, 0.6, -0.8), mirrored);
    assert_near(seen[0], 4180, 10, "the sun");
    assert_near(mirrored[0], 180, 1, "its glow, mirrored");
    block.effects = 0;
    ask_one(&block, NULL, question(ASK_SKY, 0, 0, 0.6, -0.8), without);
    assert_near(without[0], 0, 1e-6, "without the sun");
}

/* The same surroundings are made once; a turn or a camera makes nothing anew. */
static void equal_environments_are_made_once(void **state)
{
    struct asset *file = make_file(smooth_color, "smooth");
    struct frame_uniforms block = plain_block(SKY_IMAGE);
    struct environment *first, *second;
    uint32_t us;

    (void)state;
    first = get(&block, file, &us);
    block.sky_rotation[1] = 0.5f;
    block.camera.eye[0] = 7;
    second = get(&block, file, &us);
    assert_ptr_equal(first, second);
    assert_int_equal(us, 0);
    environment_unref(environments, first);
    environment_unref(environments, second);
    free(file);
}

/* What `fieldcast shader --webgl` writes of a sky. */
static void columns_are_the_first_of_whole_maps(void **state)
{
    struct frame_uniforms block = plain_block(SKY_GRADIENT);
    struct engine_map whole[ENGINE_MAPS], columns[ENGINE_MAPS];

    (void)state;
    set3(block.zenith, 0.1F, 0.3F, 0.9F);
    set3(block.horizon, 0.9F, 0.8F, 0.7F);
    engine_maps_make(&block, NULL, 0, 0, whole);
    engine_maps_make_columns(&block, columns);
    for (int i = 1; i < ENGINE_MAPS; i++) {
        for (int level = 0; level < whole[i].levels; level++) {
            const int row = 4 * engine_map_side(whole[i].width, level);
            for (int y = 0; y < engine_map_side(whole[i].height, level); y++) {
                assert_memory_equal(columns[i].texels[level] + row * y,
                                    whole[i].texels[level] + row * y, 4 * sizeof(uint16_t));
            }
        }
    }
    engine_maps_finish(whole);
    engine_maps_finish(columns);
}

/* --- fog --- */

/* Sums up the density in small steps. */
static double let_through(double density, double thinning, double base, double y, double slope,
                          double way)
{
    enum { STEPS = 200000 };
    double sum = 0;

    for (int i = 0; i < STEPS; i++) {
        const double height = y + slope * way * (i + 0.5) / STEPS - base;
        sum += density * exp(-thinning * height) * way / STEPS;
    }
    return exp(-sum);
}

static void fog_adds_up_along_a_ray(void **state)
{
    struct frame_uniforms block = plain_block(SKY_SOLID);

    (void)state;
    set3(block.fog_color, 0.5f, 0.25f, 1);
    for (int i = 0; i < 60; i++) {
        const double density = 0.02 * (1 + i % 5), thinning = i % 3 * 0.4, base = i % 4 - 2.0;
        const double way = i % 7 == 0 ? INFINITY : 0.1 * exp(6 * random_one());
        struct question q = question(ASK_FOG, way, 0, 0, 0);
        double d[3], expected;
        float answer[4];

        random_direction(d);
        d[1] *= i % 6 == 5 ? 1e-5 : 0.2;
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        set3(q.direction, (float)d[0], (float)d[1], (float)d[2]);
        q.origin[1] = (float)(4 * random_one() - 1);
        block.fog_density = (float)density;
        block.fog_thinning = (float)thinning;
        block.fog_base = (float)base;
        ask_one(&block, NULL, q, answer);
        expected = let_through(density, thinning, base, q.origin[1], d[1] / length,
                               fmin(way, block.max_distance));
        assert_near(answer[3], expected, 1e-3, "light through fog");
        assert_near(answer[0], 0.5 * (1 - answer[3]), 1e-5, "light of fog");
    }
}

/* Whatever is asked, the answer is a number. */
static void fog_far(void **state)
{
    static const float heights[] = {-1e6f, -1, 0, 1, 1e6f}, slopes[] = {-1, -1e-7f, 0, 1e-7f, 1};

    (void)state;
    for (int i = 0; i < 50; i++) {
        struct frame_uniforms block = plain_block(SKY_SOLID);
        struct question q = question(ASK_FOG, INFINITY, 1, slopes[i / 5 % 5], 0);
        float answer[4];

        block.fog_density = 1000;
        block.fog_thinning = i < 25 ? 1e6f : 0.5f;
        block.max_distance = 1e6f;
        q.origin[1] = heights[i % 5];
        ask_one(&block, NULL, q, answer);
        assert_true(answer[3] >= 0 && answer[3] <= 1);
        /* Deep in it nothing is seen, high above it and looking up all is. */
        if (i % 5 == 0) {
            assert_near(answer[3], 0, 1e-6, "light out of the depth");
        }
        if (i % 5 == 4 && i / 5 % 5 == 4) {
            assert_near(answer[3], 1, 1e-6, "light from above");
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_sky_gives_one),
        cmocka_unit_test(half_a_sky_lights_by_its_angle),
        cmocka_unit_test(rough_reflections_are_means_of_the_lobe),
        cmocka_unit_test(sides_lie_where_rays_look),
        cmocka_unit_test(nothing_jumps_at_seams_and_poles),
        cmocka_unit_test(disc_of_the_sun_gives_no_light),
        cmocka_unit_test(equal_environments_are_made_once),
        cmocka_unit_test(columns_are_the_first_of_whole_maps),
        cmocka_unit_test(fog_adds_up_along_a_ray),
        cmocka_unit_test(fog_far),
    };

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
