/* SPDX-License-Identifier: MIT */
/* The table of options, and the check of one value against its row. */
#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "command.h"
#include "protocol/codec.h"
#include "protocol/ideal.h"
#include "protocol/memory.h"
#include "protocol/surface.h"
#include "renderer/renderer.h"
#include "renderer/worker/worker.h"

#define FOR(command) (1U << COMMAND_##command)

enum { DRAWING = FOR(SERVE) | FOR(RENDER) | FOR(DOCTOR) | FOR(BENCH) | FOR(WORKER) };

static const char *word_of(const char *const *words, size_t count, size_t index)
{
    return index < count ? words[index] : NULL;
}

static const char *aov_choice(size_t index)
{
    return index < AOV_COUNT ? aov_name((enum aov)index) : NULL;
}

static const char *level_choice(size_t index)
{
    return word_of(quality_names, QUALITY_COUNT, index);
}

static const char *device_choice(size_t index)
{
    return word_of(device_kind_names, DEVICE_KINDS, index);
}

static const char *confine_choice(size_t index)
{
    static const char *const words[] = {
        [CONFINE_AUTO] = "auto", [CONFINE_STRICT] = "strict", [CONFINE_OFF] = "off"};

    return word_of(words, 3, index);
}

static const char *stage_choice(size_t index)
{
    return word_of(render_stage_names, RENDER_STAGES, index);
}

static const char *program_choice(size_t index)
{
    return word_of(render_program_names, RENDER_PROGRAMS, index);
}

static const char *switch_choice(size_t index)
{
    return word_of(switch_words, 4, index);
}

static const char *log_level_choice(size_t index)
{
    static const char *const words[] = {"error", "warning", "info", "debug"};

    return word_of(words, 4, index);
}

/* Of a member of a record. */
static const char *choice_of(const struct record_type *type, const char *member, size_t index)
{
    const struct param *param = &type->params[record_type_find(type, member)];
    size_t count = 0;

    while (param->choices[count]) {
        count++;
    }
    return word_of(param->choices, count, index);
}

static const char *camera_choice(size_t index)
{
    return choice_of(&camera_type, "type", index);
}

static const char *order_choice(size_t index)
{
    return choice_of(&ideal_type, "order", index);
}

static const char *strategy_choice(size_t index)
{
    return choice_of(&ideal_type, "strategy", index);
}

static const char *criteria_choice(size_t index)
{
    return choice_of(&ideal_type, "criteria", index);
}

static const char *method_choice(size_t index)
{
    return word_of(surface_methods, SURFACE_METHODS, index);
}

#define COORDINATE .min = -LIMIT_COORDINATE, .max = LIMIT_COORDINATE

/* clang-format off */
static const struct option_row table[OPTION_COUNT] = {
    [OPTION_HOST] = {"host", 0, "ADDRESS", OPTION_TEXT, .fallback = "127.0.0.1",
        .commands = FOR(SERVE) | FOR(DOCTOR), .stored = true,
        .doc = "Address to listen on. Any but a loopback address needs --token-file."},
    [OPTION_PORT] = {"port", 0, "PORT", OPTION_INT, .fallback = "8080", .min = 0, .max = 65535,
        .commands = FOR(SERVE) | FOR(DOCTOR), .stored = true,
        .doc = "Port to listen on; 0 takes a free one."},
    [OPTION_DATA] = {"data", 0, "DIR", OPTION_PATH, .base = BASE_DATA, .fallback = "fieldcast",
        .commands = FOR(SERVE) | FOR(DOCTOR) | FOR(BENCH), .stored = true,
        .doc = "Where scenes and their edits are kept."},
    [OPTION_TOKEN_FILE] = {"token-file", 0, "FILE", OPTION_PATH,
        .commands = FOR(SERVE), .stored = true,
        .doc = "File whose first line every request must carry as its bearer token."},
    [OPTION_ALLOW_ORIGIN] = {"allow-origin", 0, "ORIGINS", OPTION_LIST,
        .commands = FOR(SERVE), .stored = true,
        .doc = "Origins of pages that may speak with the server besides its own, as "
               "https://example.org, with commas between them."},
    [OPTION_ALLOW_HOST] = {"allow-host", 0, "HOSTS", OPTION_LIST,
        .commands = FOR(SERVE), .stored = true,
        .doc = "Host names under which the server may be addressed besides localhost, with "
               "commas between them."},
    [OPTION_WEB] = {"web", 0, "DIR", OPTION_PATH,
        .commands = FOR(SERVE), .stored = true,
        .doc = "Serve the page from this directory instead of the one built in."},
    [OPTION_CODE] = {"code", 0, "WORD", OPTION_CHOICE, .choice = switch_choice, .fallback = "on",
        .commands = FOR(SERVE), .stored = true,
        .doc = "Whether scenes may hold GLSL. With `off` none is taken, and none compiled of what "
               "is stored."},
    [OPTION_LOG_LEVEL] = {"log-level", 0, "LEVEL", OPTION_CHOICE, .choice = log_level_choice,
        .fallback = "info", .commands = FOR(SERVE), .stored = true,
        .doc = "What is written to stderr."},
    [OPTION_CODE_TIME] = {"code-time", 0, "MS", OPTION_INT, .fallback = "2000",
        .min = 100, .max = 600000, .commands = FOR(SERVE) | FOR(WORKER), .stored = true,
        .doc = "Time of the processors that compiling a scene with GLSL of its own may take, at "
               "least; it may take more where the same without it does."},
    [OPTION_TILE_TIME] = {"tile-time", 0, "MS", OPTION_INT, .fallback = "10000",
        .min = 10, .max = 600000, .commands = FOR(SERVE) | FOR(WORKER), .stored = true,
        .doc = "Time of the processors that the smallest part of a picture may take; a scene that "
               "needs more is not drawn."},
    [OPTION_WORKER_SILENCE] = {"worker-silence", 0, "MS", OPTION_INT, .fallback = "5000",
        .min = 100, .max = 600000, .commands = FOR(SERVE), .stored = true,
        .doc = "A render process that has been silent for this many milliseconds, and neither used "
               "a processor nor waited for one, is replaced."},
    [OPTION_WORKER_BUSY] = {"worker-busy", 0, "MS", OPTION_INT, .fallback = "60000",
        .min = 100, .max = 3600000, .commands = FOR(SERVE), .stored = true,
        .doc = "One that used so much time of the processors without a sign of life is replaced "
               "too."},
    [OPTION_WORKER_MEMORY] = {"worker-memory", 0, "MIB", OPTION_INT, .fallback = "0",
        .min = 0, .max = 1048576, .commands = FOR(SERVE) | FOR(WORKER), .stored = true,
        .doc = "Memory that the render process may take besides the driver's; 0 sets no limit."},
    [OPTION_CONFINE] = {"confine", 0, "WORD", OPTION_CHOICE, .choice = confine_choice,
        .fallback = "auto", .commands = FOR(SERVE) | FOR(DOCTOR) | FOR(WORKER), .stored = true,
        .doc = "Whether the kernel keeps the render process to its work: it writes only beneath "
               "--cache, reads only there and where drivers are, opens no socket, starts no "
               "program and reaches no other process. `auto` goes on where the kernel can do only "
               "a part of that; `strict` does not; `off` is for drivers that need more."},
    [OPTION_DEVICE] = {"device", 0, "KIND", OPTION_CHOICE, .choice = device_choice,
        .fallback = "auto", .commands = DRAWING, .stored = true,
        .doc = "What draws. `auto` prefers a GPU, which is used from OpenGL 3.3 on; below that, "
               "and where none can be opened, the engine draws; `gpu` fails where there is none; "
               "`none` opens no device: the engine draws."},
    [OPTION_DEVICE_INDEX] = {"device-index", 0, "N", OPTION_INT, .fallback = "-1",
        .min = -1, .max = 255, .commands = DRAWING, .stored = true,
        .doc = "Which device, counted as `fieldcast doctor` lists them; -1 takes the best."},
    [OPTION_STAGE] = {"stage", 0, "WORD", OPTION_CHOICE, .choice = stage_choice,
        .fallback = "auto", .commands = DRAWING, .stored = true,
        .doc = "What computes pictures: `compute` or `fragment`, shaders of the device of that "
               "kind, from OpenGL 4.3 or 3.3 on; `engine`, vectors of the processors; `auto` takes "
               "the faster shaders of a GPU, tried once and kept in --cache, else the engine. "
               "Scenes with too much code for compilers of shaders are drawn by the engine in any "
               "case."},
    [OPTION_PROGRAMS] = {"programs", 0, "WORD", OPTION_CHOICE, .choice = program_choice,
        .fallback = "auto", .commands = DRAWING | FOR(SHADER), .stored = true,
        .doc = "By which programs shaders draw a scene: `compiled` for it alone; `interpreted`, "
               "which read it as data, so that edits compile nothing; `either` begins with the "
               "second and takes the faster one when both are there; `auto` is that on a GPU, else "
               "`compiled`."},
    [OPTION_CACHE] = {"cache", 0, "DIR", OPTION_PATH, .base = BASE_CACHE, .fallback = "fieldcast",
        .commands = DRAWING, .stored = true,
        .doc = "Where compiled shaders are kept, and which stage is the faster one."},
    [OPTION_OUTPUT] = {"output", 'o', "FILE", OPTION_PATH,
        .commands = FOR(RENDER) | FOR(IMPORT),
        .doc = "The file to write; `-` is stdout. Needed."},
    [OPTION_SCENE] = {"scene", 0, "NAME", OPTION_TEXT, .commands = FOR(IMPORT),
        .doc = "Name or file of the scene to import, where there are several."},
    [OPTION_WIDTH] = {"width", 0, "PIXELS", OPTION_INT, .fallback = "1280",
        .min = 1, .max = LIMIT_IMAGE_SIDE, .commands = FOR(RENDER),
        .doc = "Width of the picture."},
    [OPTION_HEIGHT] = {"height", 0, "PIXELS", OPTION_INT, .fallback = "720",
        .min = 1, .max = LIMIT_IMAGE_SIDE, .commands = FOR(RENDER),
        .doc = "Height of the picture."},
    [OPTION_AOV] = {"aov", 0, "WHAT", OPTION_CHOICES, .choice = aov_choice, .fallback = "color",
        .commands = FOR(RENDER),
        .doc = "What the picture shows. Several, with commas between them, go into a .zip or "
               ".npz."},
    [OPTION_FORMAT] = {"format", 0, "FORMAT", OPTION_CHOICE, .choice = codec_choice,
        .commands = FOR(RENDER),
        .doc = "Format of the picture. By default the output's extension says it: also .zip "
               "(png) and .npz (npy)."},
    [OPTION_LEVEL] = {"level", 0, "LEVEL", OPTION_CHOICE, .choice = level_choice,
        .commands = FOR(RENDER) | FOR(SHADER),
        .doc = "Quality level; by default the scene's."},
    [OPTION_ASSET] = {"asset", 0, "FILE", OPTION_FILES, .commands = FOR(RENDER),
        .doc = "A file that the scene names by its SHA-256; may be given several times."},
    [OPTION_SAMPLES] = {"samples", 0, "N", OPTION_INT, .min = 1, .max = 4,
        .commands = FOR(RENDER),
        .doc = "Samples per pixel along each axis; by default the level's or the scene's."},
    [OPTION_TRANSPARENT] = {"transparent", 0, "WORD", OPTION_CHOICE, .choice = switch_choice,
        .commands = FOR(RENDER),
        .doc = "Whether the background is left out; by default as the scene says."},
    [OPTION_REGION] = {"region", 0, "X,Y,W,H", OPTION_PIXELS, .min = 0, .max = LIMIT_IMAGE_SIDE,
        .commands = FOR(RENDER),
        .doc = "The pixels of the picture that are wanted; by default all."},
    [OPTION_QUALITY] = {"quality", 0, "N", OPTION_INT, .fallback = "90", .min = 1, .max = 100,
        .commands = FOR(RENDER),
        .doc = "Quality of a JPEG."},
    [OPTION_CAMERA_TYPE] = {"camera-type", 0, "KIND", OPTION_CHOICE, .choice = camera_choice,
        .commands = FOR(RENDER),
        .doc = "Kind of projection; by default the scene's, as all that --camera-... leaves out."},
    [OPTION_CAMERA_POSITION] = {"camera-position", 0, "X,Y,Z", OPTION_VECTOR, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "Where the camera stands."},
    [OPTION_CAMERA_TARGET] = {"camera-target", 0, "X,Y,Z", OPTION_VECTOR, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "What the camera looks at."},
    [OPTION_CAMERA_UP] = {"camera-up", 0, "X,Y,Z", OPTION_VECTOR, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "Direction that is up in the picture."},
    [OPTION_CAMERA_FOV] = {"camera-fov", 0, "DEGREES", OPTION_NUMBER, .min = 0, .max = 180,
        .commands = FOR(RENDER),
        .doc = "Vertical angle of a perspective picture."},
    [OPTION_CAMERA_HEIGHT] = {"camera-height", 0, "LENGTH", OPTION_NUMBER, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "Height of what an orthographic picture shows."},
    [OPTION_CAMERA_APERTURE] = {"camera-aperture", 0, "LENGTH", OPTION_NUMBER, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "Radius of the lens."},
    [OPTION_CAMERA_FOCUS] = {"camera-focus", 0, "LENGTH", OPTION_NUMBER, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "Distance that is in focus; 0: the target's."},
    [OPTION_SECTION_NORMAL] = {"section-normal", 0, "X,Y,Z", OPTION_VECTOR, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "A plane cuts the scene, and what is on the side that this points to is left out; "
               "by default nothing is cut, or, with an offset, 0,1,0."},
    [OPTION_SECTION_OFFSET] = {"section-offset", 0, "LENGTH", OPTION_NUMBER, COORDINATE,
        .commands = FOR(RENDER),
        .doc = "How far from the origin that plane is, along its normal; by default 0."},
    [OPTION_METHOD] = {"method", 0, "WORD", OPTION_CHOICE, .choice = method_choice,
        .fallback = "nullspace", .commands = FOR(IMPLICITIZE),
        .doc = SURFACE_METHOD_DOC},
    [OPTION_RANGE_S] = {"range-s", 's', "LOW,HIGH", OPTION_PAIR, COORDINATE,
        .commands = FOR(IMPLICITIZE),
        .doc = "From where to where s goes. With the ranges of both letters the answer tells how "
               "much of the implicit surface the patch covers, and has the patch alone as a node."},
    [OPTION_RANGE_T] = {"range-t", 't', "LOW,HIGH", OPTION_PAIR, COORDINATE,
        .commands = FOR(IMPLICITIZE),
        .doc = "The same of t."},
    [OPTION_RANGE_U] = {"range-u", 'u', "LOW,HIGH", OPTION_PAIR, COORDINATE,
        .commands = FOR(IMPLICITIZE),
        .doc = "The same of u."},
    [OPTION_RANGE_V] = {"range-v", 'v', "LOW,HIGH", OPTION_PAIR, COORDINATE,
        .commands = FOR(IMPLICITIZE),
        .doc = "The same of v."},
    [OPTION_SIZE] = {"size", 0, "X,Y,Z", OPTION_VECTOR, .min = 0, .max = LIMIT_COORDINATE,
        .commands = FOR(IMPLICITIZE),
        .doc = "Full lengths of the box about the origin that cuts the implicit surface; by "
               "default, and where one is 0, the box goes around the patch."},
    [OPTION_LETTERS] = {"letters", 0, "NAMES", OPTION_TEXT, .commands = FOR(GROEBNER),
        .doc = "The variables, the greatest first, with spaces between them; by default in the "
               "order of the alphabet, with x, y and z last."},
    [OPTION_ORDER] = {"order", 0, "WORD", OPTION_CHOICE, .choice = order_choice,
        .commands = FOR(GROEBNER),
        .doc = "How monomials are compared; by default grevlex."},
    [OPTION_WEIGHTS] = {"weights", 0, "NUMBERS", OPTION_TEXT, .commands = FOR(GROEBNER),
        .doc = "A whole number for each letter, the sums of which are compared first."},
    [OPTION_ELIMINATE] = {"eliminate", 0, "N", OPTION_INT, .min = 0,
        .max = LIMIT_GROEBNER_LETTERS, .commands = FOR(GROEBNER),
        .doc = "The first N letters are to be eliminated."},
    [OPTION_PRIME] = {"prime", 0, "P", OPTION_INT, .min = 0, .max = 2147483647,
        .commands = FOR(GROEBNER),
        .doc = "Coefficients modulo this prime; by default rational numbers."},
    [OPTION_STRATEGY] = {"strategy", 0, "WORD", OPTION_CHOICE, .choice = strategy_choice,
        .commands = FOR(GROEBNER),
        .doc = "Which pair comes next; by default the least common multiple."},
    [OPTION_CRITERIA] = {"criteria", 0, "WORD", OPTION_CHOICE, .choice = criteria_choice,
        .commands = FOR(GROEBNER),
        .doc = "Which pairs are left out; by default those of both criteria."},
    [OPTION_DIVIDE] = {"divide", 0, "POLYNOMIAL", OPTION_TEXT, .commands = FOR(GROEBNER),
        .doc = "Divide it by the basis, with quotients."},
    [OPTION_STEPS] = {"steps", 0, NULL, OPTION_FLAG,
        .commands = FOR(GROEBNER) | FOR(IMPLICITIZE),
        .doc = "Print each step on stderr: a pair as JSON, a step to an equation as text with the "
               "time. The latter are printed on a terminal in any case."},
    [OPTION_ROUNDS] = {"rounds", 0, "N", OPTION_INT, .fallback = "5", .min = 1, .max = 1000,
        .commands = FOR(BENCH),
        .doc = "How often each thing is measured; the median counts."},
    [OPTION_SCALE_DOWN] = {"scale-down", 0, "N", OPTION_INT, .fallback = "1", .min = 1, .max = 16,
        .commands = FOR(BENCH),
        .doc = "Divides the sides of pictures, 640x360 and 1280x720, where drawing is slow."},
    [OPTION_ONLY] = {"only", 0, "EXAMPLE", OPTION_TEXT, .commands = FOR(BENCH),
        .doc = "Measure this example scene alone."},
    [OPTION_PART] = {"part", 0, "WORD", OPTION_CHOICE, .choice = bench_part_name,
        .fallback = "all", .commands = FOR(BENCH),
        .doc = "What is measured: drawing of the examples, growth with the number of shapes, "
               "pictures after changes, pictures of all stages side by side, pictures by each kind "
               "of program, documents, edits."},
    [OPTION_REFERENCE] = {"reference", 0, NULL, OPTION_FLAG, .commands = FOR(SCHEMA),
        .doc = "Print the reference page, in Markdown, instead."},
    [OPTION_PASS] = {"pass", 0, "NAME", OPTION_CHOICE, .choice = renderer_pass_name,
        .fallback = "march", .commands = FOR(SHADER),
        .doc = "Which pass: where rays meet the scene, its materials, its shadows, its volumes; of "
               "`--stage fragment`: where rays start, a whole sample."},
    [OPTION_WEBGL] = {"webgl", 0, NULL, OPTION_FLAG, .commands = FOR(SHADER),
        .doc = "Print the whole picture as one fragment shader of WebGL 2 instead, which needs "
               "nothing but its uniforms `resolution`, in pixels, and `orbit`, which may stay 0."},
    [OPTION_PAGE] = {"page", 0, NULL, OPTION_FLAG, .commands = FOR(SHADER),
        .doc = "Print a page with that shader, to be opened by a browser: drag to orbit."},
    [OPTION_CONFIG] = {"config", 0, "FILE", OPTION_PATH, .base = BASE_CONFIG,
        .fallback = "fieldcast/fieldcast.conf", .commands = DRAWING,
        .doc = "The config file; the default one may be absent."},
    [OPTION_HELP] = {"help", 'h', NULL, OPTION_FLAG, .commands = ~0U,
        .doc = "Say what the command does and takes."},
};
/* clang-format on */

const struct option_row *option_row(enum option option)
{
    return &table[option];
}

enum option option_find(const char *name)
{
    int i = 0;

    while (i < OPTION_COUNT && strcmp(table[i].name, name) != 0) {
        i++;
    }
    return (enum option)i;
}

void option_variable(const struct option_row *row, char *out, size_t size)
{
    snprintf(out, size, "FIELDCAST_%s", row->name);
    for (char *c = out; *c; c++) {
        *c = *c == '-' ? '_' : (char)toupper((unsigned char)*c);
    }
}

static char *joined(const char *directory, const char *rest)
{
    char *path = NULL;

    if (asprintf(&path, "%s/%s", directory, rest) < 0) {
        abort();
    }
    return path;
}

static const char *home(void)
{
    const char *directory = getenv("HOME");

    return directory && *directory ? directory : "/";
}

/* XDG Base Directory Specification: a variable, and a place below the home directory without it. */
char *option_default(const struct option_row *row)
{
    static const struct {
        const char *variable, *below_home;
    } bases[] = {[BASE_DATA] = {"XDG_DATA_HOME", ".local/share"},
                 [BASE_CONFIG] = {"XDG_CONFIG_HOME", ".config"},
                 [BASE_CACHE] = {"XDG_CACHE_HOME", ".cache"}};
    if (!row->fallback || row->base == BASE_NONE) {
        return row->fallback ? memory_text(row->fallback) : NULL;
    }
    const char *directory = getenv(bases[row->base].variable);
    if (directory && directory[0] == '/') {
        return joined(directory, row->fallback);
    }
    char *base = joined(home(), bases[row->base].below_home);
    char *path = joined(base, row->fallback);
    free(base);
    return path;
}

/* --- one value --- */

static bool read_number(const struct option_row *row, const char *text, const char *end,
                        double *out, const char *place, struct error *err)
{
    const bool whole = row->type == OPTION_INT || row->type == OPTION_PIXELS;
    char *stop;

    errno = 0;
    const double number = strtod(text, &stop);
    const int length = (int)(end - text);
    if (stop != end || length == 0 || isspace((unsigned char)*text) || !isfinite(number)) {
        return error_set(err, ERROR_INVALID, place, "'%.*s' is not a number", length, text);
    }
    if (whole && number != floor(number)) {
        return error_set(err, ERROR_INVALID, place, "%.*s is not a whole number", length, text);
    }
    if (number < row->min) {
        return error_set(err, ERROR_INVALID, place, "%.*s is below the minimum %g", length, text,
                         row->min);
    }
    if (number > row->max) {
        return error_set(err, ERROR_INVALID, place, "%.*s is above the maximum %g", length, text,
                         row->max);
    }
    *out = number;
    return true;
}

static bool read_numbers(const struct option_row *row, const char *text, int count,
                         const char *expected, double *out, const char *place, struct error *err)
{
    for (int i = 0; i < count; i++) {
        const char *end = text + strcspn(text, ",");
        if ((*end == ',') != (i + 1 < count)) {
            return error_set(err, ERROR_INVALID, place, "needs %s", expected);
        }
        if (!read_number(row, text, end, &out[i], place, err)) {
            return false;
        }
        text = end + 1;
    }
    return true;
}

/* One word out of `length` characters; its index. */
static bool read_word(const struct option_row *row, const char *text, size_t length, size_t *out,
                      const char *place, struct error *err)
{
    char list[128] = "";

    for (size_t i = 0; row->choice(i); i++) {
        if (strlen(row->choice(i)) == length && memcmp(row->choice(i), text, length) == 0) {
            *out = i;
            return true;
        }
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", row->choice(i));
    }
    return error_set(err, ERROR_INVALID, place, "'%.*s' is none of %s", (int)length, text, list);
}

static bool read_choice(const struct option_row *row, const char *text, double *out,
                        const char *place, struct error *err)
{
    size_t index;
    const bool ok = read_word(row, text, strlen(text), &index, place, err);

    *out = ok ? (double)index : 0;
    return ok;
}

static bool read_choices(const struct option_row *row, const char *text, double *out,
                         const char *place, struct error *err)
{
    unsigned bits = 0;
    size_t index, length;

    for (const char *word = text;; word += length + 1) {
        length = strcspn(word, ",");
        if (!read_word(row, word, length, &index, place, err)) {
            return false;
        }
        bits |= 1U << index;
        if (word[length] == '\0') {
            break;
        }
    }
    *out = bits;
    return true;
}

static bool read_flag(const char *text, double *out, const char *place, struct error *err)
{
    const bool yes = strcmp(text, "yes") == 0;

    if (!yes && strcmp(text, "no") != 0) {
        return error_set(err, ERROR_INVALID, place, "'%s' is neither yes nor no", text);
    }
    *out = yes;
    return true;
}

static bool read_value(const struct option_row *row, const char *text, double *number,
                       const char *place, struct error *err)
{
    switch (row->type) {
    case OPTION_FLAG:
        return read_flag(text, number, place, err);
    case OPTION_INT:
    case OPTION_NUMBER:
        return read_number(row, text, text + strlen(text), number, place, err);
    case OPTION_PAIR:
        return read_numbers(row, text, 2, "two numbers, as -1,1", number, place, err);
    case OPTION_VECTOR:
        return read_numbers(row, text, 3, "three numbers, as 0,1.5,6", number, place, err);
    case OPTION_PIXELS:
        return read_numbers(row, text, 4, "x,y,width,height", number, place, err);
    case OPTION_CHOICE:
        return read_choice(row, text, number, place, err);
    case OPTION_CHOICES:
        return read_choices(row, text, number, place, err);
    case OPTION_TEXT:
    case OPTION_LIST:
    case OPTION_FILES:
    case OPTION_PATH:
        break;
    }
    if (*text == '\0') {
        return error_set(err, ERROR_INVALID, place, "is empty");
    }
    return true;
}

/* Of an option that may be named again: behind what was given before. */
static char *appended(const struct option_value *before, enum option_source source, char *text)
{
    char *both = NULL;

    if (!before->text || before->source != source) {
        return text;
    }
    if (asprintf(&both, "%s\n%s", before->text, text) < 0) {
        abort();
    }
    free(text);
    return both;
}

bool option_set(struct options *options, enum option option, const char *text,
                enum option_source source, const char *place, struct error *err)
{
    const struct option_row *row = &table[option];
    struct option_value value = {.source = source};

    if (!read_value(row, text, value.number, place, err)) {
        return false;
    }
    const bool is_path = row->type == OPTION_PATH || row->type == OPTION_FILES;
    const bool at_home = is_path && text[0] == '~' && text[1] == '/';
    value.text = at_home ? joined(home(), text + 2) : memory_text(text);
    if (row->type == OPTION_FILES) {
        value.text = appended(&options->values[option], source, value.text);
    }
    free(options->values[option].text);
    options->values[option] = value;
    return true;
}

const char *option_text(const struct options *options, enum option option)
{
    return options->values[option].text;
}

double option_number(const struct options *options, enum option option)
{
    return options->values[option].number[0];
}

int option_int(const struct options *options, enum option option)
{
    return (int)options->values[option].number[0];
}

bool option_flag(const struct options *options, enum option option)
{
    return options->values[option].number[0] != 0;
}

const double *option_vector(const struct options *options, enum option option)
{
    const struct option_value *value = &options->values[option];

    return value->source == SOURCE_NONE ? NULL : value->number;
}
