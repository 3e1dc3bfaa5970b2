/* SPDX-License-Identifier: MIT */
/* The picture is where the surface is: depth, normal and id of small pictures against the C
 * evaluator, marched to TOLERANCE in double precision along rays that this file makes by itself.
 * Every type of the registry, as golden/nodes has it but without its floor, and compositions that
 * are thin, tiny, hollow, overlapping, turned, sheared or blended. Each is seen up close, and once
 * more from elsewhere, at another scale.
 *
 * Inner pixels are those all of whose neighbours hit the same leaf. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/compiled.h"
#include "tests/support/drawing.h"
#include "tests/support/text_file.h"

enum { WIDTH = 128, HEIGHT = 96, PIXELS = WIDTH * HEIGHT, THREADS = 2, STEPS_MAX = 20000 };
enum { CASES_MAX = 200 };

/* Lengths are for a scene of scale 1. */
#define TOLERANCE 1e-7      /* so near is on the surface */
#define DEPTH_ROOM 2e-3     /* from the true depth */
#define LEAST_OVERLAP 0.995 /* of silhouettes: hit in both, of those hit in either */
#define LEAST_ROUGH 0.985   /* the same of fractals */
#define MOST_DEPTHS 0.005   /* off by more than DEPTH_ROOM, of the inner pixels */
#define MOST_NORMALS 0.02   /* off by more than NORMAL_DEGREES, of the same */
#define NORMAL_DEGREES 5.0
#define MOST_IDS 0.01
#define GRADIENT 1e-5 /* half edge of the tetrahedron that normals are taken of */

/* Whether a ray meets something beyond so much of the greatest distance is no silhouette. */
#define END_OF_SIGHT 0.9

/* Changes the camera of a scene, which looks at what is around the origin, about 1 in radius. */
struct view {
    const char *name;
    double scale; /* of everything */
    double from[3];
    double fov;    /* degrees */
    double height; /* of an orthographic picture; 0: perspective */
};

static const struct view near_view = {"near", .scale = 1};
static const struct view views[] = {
    {"parallel 1/100", .scale = 0.01, .from = {-1.1, 0.9, 2.3}, .height = 1.9},
    {"far x100", .scale = 100, .from = {21, 17, -41}, .fov = 2.1},
    {"wide x1/10", .scale = 0.1, .from = {-1.05, 0.6, -0.95}, .fov = 72},
    {"parallel x10", .scale = 10, .from = {0.7, -1.4, 1.9}, .height = 2.2},
};
enum { VIEWS = sizeof views / sizeof views[0] };

#define CAMERA "\"camera\":{\"position\":[1.4,1.1,2.6],\"fov\":36},"
#define INSIDE "\"camera\":{\"position\":[0.2,0.1,0.3],\"target\":[-0.4,-0.1,-1],\"fov\":80},"
#define SPHERE(r, x, y, z)                                                                         \
    "{\"type\":\"sphere\",\"params\":{\"radius\":" #r "},\"transform\":{\"translation\":[" #x      \
    "," #y "," #z "]}}"
#define BOX(a, b, c, x, y, z)                                                                      \
    "{\"type\":\"box\",\"params\":{\"size\":[" #a "," #b "," #c                                    \
    "]},\"transform\":{\"translation\":[" #x "," #y "," #z "],\"rotation\":[0.3,0.4,0.1]}}"
#define BLEND(type, kernel, k)                                                                     \
    "{\"type\":\"" type "\",\"params\":{\"kernel\":\"" kernel "\",\"k\":" #k                       \
    "},\"children\":[" BOX(0.7, 0.7, 0.7, 0, 0, 0) "," SPHERE(0.4, 0.3, 0.35, 0.2) "]}"
#define TURNED "\"transform\":{\"rotation\":[0.4,0.5,0.2]}"

struct composition {
    const char *name, *head, *root;
    bool inside; /* seen from there alone */
};

static const struct composition compositions[] = {
    {"quartic torus", CAMERA,
     "{\"type\":\"field\",\"params\":{\"lipschitz\":18,\"size\":[2,2,2],\"code\":\"float sdf(vec3 "
     "p){float q=dot(p,p)+0.32;return q*q-1.44*dot(p.xz,p.xz);}\"}," TURNED "}",
     false},
    {"sheet of a gyroid", CAMERA,
     "{\"type\":\"gyroid\",\"params\":{\"period\":0.7,\"thickness\":0.004,\"size\":[1,1,1]}," TURNED
     "}",
     false},
    {"slab", CAMERA, "{\"type\":\"box\",\"params\":{\"size\":[1.4,0.002,1]}," TURNED "}", false},
    {"edge-on slab", "\"camera\":{\"position\":[3,0.04,0.6],\"fov\":36},",
     "{\"type\":\"box\",\"params\":{\"size\":[1.4,0.003,1]}}", false},
    {"cut eggshell", CAMERA,
     "{\"type\":\"difference\",\"children\":[{\"type\":\"shell\",\"params\":{\"thickness\":0.002},"
     "\"children\":[" SPHERE(0.6, 0, 0, 0) "]}," BOX(0.9, 0.9, 0.9, 0.4, 0.4, 0.3) "]}",
     false},
    {"shells in shells", CAMERA,
     "{\"type\":\"difference\",\"children\":[{\"type\":\"shell\",\"params\":{\"thickness\":0.02},"
     "\"children\":[{\"type\":\"shell\",\"params\":{\"thickness\":0.08},\"children\":["
     "{\"type\":\"torus\"," TURNED "}]}]}," BOX(1, 1, 1, 0.4, 0.4, 0.3) "]}",
     false},
    {"exclusive of five", CAMERA,
     "{\"type\":\"exclusive\",\"children\":[" SPHERE(0.4, 0, 0.25, 0) "," SPHERE(
         0.4, 0.25, 0, 0.1) "," SPHERE(0.4, -0.25, 0, 0) "," SPHERE(0.4, 0, -0.25,
                                                                    0.2) "," BOX(0.5, 0.5, 0.5, 0,
                                                                                 0, 0.2) "]}",
     false},
    {"overlapping repeat", CAMERA,
     "{\"type\":\"repeat\",\"params\":{\"spacing\":[0.3,0.35,0.4],\"count\":[3,2,2]},\"children\":"
     "[" BOX(0.5, 0.3, 0.3, 0.1, 0.05, 0) "," SPHERE(0.22, 0, 0.1, 0.1) "]}",
     false},
    {"overlapping polar repeat", CAMERA,
     "{\"type\":\"repeat_polar\",\"params\":{\"count\":9,\"radius\":0.45},\"children\":[" BOX(
         0.5, 0.3, 0.5, 0.1, 0.05, 0) "]," TURNED "}",
     false},
    {"endless repeat", CAMERA,
     "{\"type\":\"intersection\",\"children\":[" SPHERE(
         0.7, 0, 0,
         0) ","
            "{\"type\":\"repeat\",\"params\":{\"spacing\":[0.2,0.2,0.2],\"count\":[-1,-1,-1]},"
            "\"children\":[" SPHERE(0.115, 0, 0, 0) "]}]}",
     false},
    {"tiny things repeated", CAMERA,
     "{\"type\":\"repeat\",\"params\":{\"spacing\":[0.2,0.2,0.2],\"count\":[6,5,5]},\"children\":"
     "[" SPHERE(0.05, 0, 0, 0) "," BOX(0.04, 0.04, 0.04, 0.06, 0.05, 0) "]}",
     false},
    {"wires", CAMERA,
     "{\"type\":\"repeat\",\"params\":{\"spacing\":[0.16,1,0.16],\"count\":[6,0,6]},\"children\":["
     "{\"type\":\"cylinder\",\"params\":{\"radius\":0.012,\"height\":1}}]," TURNED "}",
     false},
    {"turned star", CAMERA,
     "{\"type\":\"revolve\",\"params\":{\"offset\":0.45},\"children\":[{\"type\":\"star\","
     "\"params\":{\"radius\":0.3}}]," TURNED "}",
     false},
    {"turned profile over the axis", CAMERA,
     "{\"type\":\"revolve\",\"params\":{\"offset\":0.1},\"children\":[{\"type\":\"polygon\","
     "\"params\":{\"points\":[[0,-0.6],[0.5,-0.5],[0.2,-0.1],[0.45,0.2],[0.1,0.6],[-0.2,0.3]]}}],"
     "\"transform\":{\"rotation\":[0.4,0,0.2]}}",
     false},
    {"turned cross", CAMERA,
     "{\"type\":\"revolve\",\"params\":{\"offset\":0.4},\"children\":[{\"type\":\"cross\","
     "\"params\":{\"size\":0.5,\"thickness\":0.12},\"transform\":{\"rotation\":[0,0,0.4]}}]," TURNED
     "}",
     false},
    {"deep menger", CAMERA,
     "{\"type\":\"menger\",\"params\":{\"size\":1,\"iterations\":3}," TURNED "}", false},
    {"sheared", CAMERA,
     "{\"type\":\"group\",\"transform\":{\"scale\":[1.2,0.35,0.8]},\"children\":["
     "{\"type\":\"torus\",\"transform\":{\"rotation\":[0.6,0.7,0.8]}}," BOX(0.5, 0.9, 0.3, 0.2, 0.1,
                                                                            0.3) "]}",
     false},
    {"pancake", CAMERA,
     "{\"type\":\"sphere\",\"transform\":{\"scale\":[0.8,0.03,0.5],\"rotation\":[0.3,0.2,0.5]}}",
     false},
    {"screw", CAMERA,
     "{\"type\":\"twist\",\"params\":{\"rate\":4},\"children\":[" BOX(0.5, 1.2, 0.3, 0, 0, 0) "]}",
     false},
    {"bow", CAMERA,
     "{\"type\":\"bend\",\"params\":{\"rate\":1.2},\"children\":[" BOX(1.3, 0.2, 0.4, 0, 0, 0) "]}",
     false},
    {"golf ball", CAMERA,
     "{\"type\":\"displace\",\"params\":{\"amplitude\":0.05,\"frequency\":[14,14,14]},\"children\":"
     "[" SPHERE(0.6, 0, 0, 0) "]}",
     false},
    {"waves", CAMERA,
     "{\"type\":\"offset_space\",\"params\":{\"amplitude\":[0.08,0.05,0.06],\"frequency\":[6,7,5]},"
     "\"children\":[" BOX(0.8, 0.8, 0.6, 0, 0, 0) "]}",
     false},
    {"drilled block", CAMERA,
     "{\"type\":\"difference\",\"children\":[" BOX(
         1, 0.8, 0.9, 0, 0, 0) ",{\"type\":\"repeat\","
                               "\"params\":{\"spacing\":[0.22,1,0.22],\"count\":[4,0,4]},"
                               "\"children\":[{\"type\":\"cylinder\","
                               "\"params\":{\"radius\":0.08,\"height\":3}}]}," SPHERE(0.3, 0.4, 0.4,
                                                                                      0.4) "]}",
     false},
    {"lens", CAMERA,
     "{\"type\":\"intersection\",\"children\":[" SPHERE(1, 0, 0, 0.9) "," SPHERE(1, 0, 0,
                                                                                 -0.9) "]}",
     false},
    {"round frame", CAMERA,
     "{\"type\":\"round\",\"params\":{\"radius\":0.05},\"children\":[{\"type\":\"box_frame\","
     "\"params\":{\"size\":[1,0.8,0.7],\"thickness\":0.05}," TURNED "}]}",
     false},
    {"halves", CAMERA,
     "{\"type\":\"mirror\",\"params\":{\"axes\":[true,false,false]},\"children\":[" BOX(
         0.5, 0.5, 0.5, 0.3, 0.1, 0) "," SPHERE(0.3, 0.1, 0.4, 0.2) "]}",
     false},
    {"long ring", CAMERA,
     "{\"type\":\"elongate\",\"params\":{\"size\":[0.2,0.05,0.1]},\"children\":["
     "{\"type\":\"torus\",\"params\":{\"radius\":0.3,\"tube\":0.1}," TURNED "}]}",
     false},
    {"morph", CAMERA,
     "{\"type\":\"morph\",\"params\":{\"t\":0.4},\"children\":[" BOX(
         0.8, 0.8, 0.8, 0, 0, 0) "," SPHERE(0.6, 0, 0, 0) "]}",
     false},
    {"models",
     CAMERA "\"models\":{\"m\":{\"type\":\"smooth_union\",\"params\":{\"k\":0.1},\"children\":"
            "[" SPHERE(0.2, 0, 0.2,
                       0) ",{\"type\":\"cone\",\"params\":{\"radius\":0.2,\"height\":0.5}}]}},",
     "{\"type\":\"group\",\"children\":[{\"type\":\"model\",\"params\":{\"model\":\"m\"}},"
     "{\"type\":\"model\",\"params\":{\"model\":\"m\"},\"transform\":{\"translation\":[0.5,0,0],"
     "\"scale\":[0.5,1.2,0.7],\"rotation\":[0.4,0.1,0.6]}},{\"type\":\"model\",\"params\":{"
     "\"model\":\"m\"},\"transform\":{\"translation\":[-0.5,0.1,0.2],\"scale\":1.3}}]}",
     false},
    {"own waves", CAMERA,
     "{\"type\":\"field\",\"params\":{\"lipschitz\":2.2,\"code\":\"float sdf(vec3 p){return "
     "length(p)-0.5+0.05*sin(20.*p.x)*sin(20.*p.y)*sin(20.*p.z);}\"}}",
     false},
    {"own surface, steep", CAMERA,
     "{\"type\":\"field\",\"params\":{\"lipschitz\":60,\"size\":[1.4,1.4,1.4],\"code\":\"float "
     "sdf(vec3 p){vec3 q=3.*p;return q.x*q.x*q.x*q.x-3.*q.x*q.x+q.y*q.y*q.y*q.y-3.*q.y*q.y"
     "+q.z*q.z*q.z*q.z-3.*q.z*q.z+5.;}\"}," TURNED "}",
     false},
    {"two leaves on a huge ball", CAMERA,
     "{\"type\":\"group\",\"children\":[" SPHERE(1000, 0, -1000.4, 0) "," SPHERE(
         0.4, 0, 0, 0) ",{\"type\":\"box\",\"params\":{\"size\":[0.4,0.4,0.4]},\"transform\":{"
                       "\"translation\":[0.5,-0.2,0.4]}}]}",
     false},
    {"box on a plane", CAMERA,
     "{\"type\":\"group\",\"children\":[{\"type\":\"plane\",\"params\":{\"offset\":-0.3}},"
     "{\"type\":\"box\",\"params\":{\"size\":[0.6,0.6,0.6]}},{\"type\":\"box\",\"params\":{"
     "\"size\":[0.01,0.5,0.5]},\"transform\":{\"translation\":[0.6,-0.05,0.4]}}]}",
     false},
    {"inside a shell", INSIDE,
     "{\"type\":\"group\",\"children\":[{\"type\":\"shell\",\"params\":{\"thickness\":0.05},"
     "\"children\":[" SPHERE(1.3, 0, 0, 0) "]}," BOX(0.4, 0.4, 0.4, -0.3, -0.2, -0.6) "]}",
     true},
    {"inside a room", INSIDE,
     "{\"type\":\"difference\",\"children\":[{\"type\":\"box\",\"params\":{\"size\":[3,3,3]}}," BOX(
         2, 1.6, 2.4, 0, 0, 0) "," SPHERE(0.7, -0.6, 0.2, -1.2) "]}",
     true},
    {"quadratic union", CAMERA, BLEND("smooth_union", "quadratic", 0.2), false},
    {"cubic intersection", CAMERA, BLEND("smooth_intersection", "cubic", 0.2), false},
    {"quartic difference", CAMERA, BLEND("smooth_difference", "quartic", 0.2), false},
    {"circular difference", CAMERA, BLEND("smooth_difference", "circular", 0.2), false},
    {"exponential union", CAMERA, BLEND("smooth_union", "exponential", 24), false},
    {"root intersection", CAMERA, BLEND("smooth_intersection", "root", 0.01), false},
    {"power union", CAMERA, BLEND("smooth_union", "power", 8), false},
};
enum { COMPOSITIONS = sizeof compositions / sizeof compositions[0] };

/* Fractals have creases within every pixel: depth and normal are those of a place that floats do
 * not tell, and rays between their threads do not always find one. */
static const char *const rough[] = {"julia", "mandelbulb"};

static struct renderer *renderer;
static bool wordy;

/* --- scenes --- */

struct seen_case {
    char name[80];
    const struct node_type *type; /* of golden/nodes; NULL: a composition */
    const struct composition *composition;
    const struct view *second;
};

static cJSON *read_golden(const struct node_type *type)
{
    char path[200];
    snprintf(path, sizeof path, "tests/golden/nodes/%s/scene.json", type->record.name);
    char *text = text_file_read(path, NULL);
    cJSON *document = cJSON_Parse(text);
    cJSON *children = cJSON_GetObjectItem(cJSON_GetObjectItem(document, "root"), "children");

    free(text);
    assert_non_null(children);
    for (int i = cJSON_GetArraySize(children); i > 1; i--) {
        const cJSON *last = cJSON_GetArrayItem(children, i - 1);
        if (strcmp(cJSON_GetStringValue(cJSON_GetObjectItem(last, "id")), "floor") == 0) {
            cJSON_DeleteItemFromArray(children, i - 1);
        }
    }
    return document;
}

static cJSON *read_composition(const struct composition *composition)
{
    char *text;
    assert_true(asprintf(&text,
                         "{\"format\":\"fieldcast/1\",%s\"root\":{\"type\":\"group\","
                         "\"children\":[%s]}}",
                         composition->head, composition->root) > 0);
    cJSON *document = cJSON_Parse(text);

    if (!document) {
        fail_msg("%s: is no JSON: %s", composition->name, text);
    }
    free(text);
    return document;
}

static void scale_vector(cJSON *camera, const char *name, double scale)
{
    cJSON *item;

    cJSON_ArrayForEach(item, cJSON_GetObjectItem(camera, name))
    {
        cJSON_SetNumberValue(item, item->valuedouble * scale);
    }
}

static void set_camera(cJSON *document, const struct view *view)
{
    cJSON *camera = cJSON_CreateObject();

    if (view->height > 0) {
        cJSON_AddStringToObject(camera, "type", "orthographic");
        cJSON_AddNumberToObject(camera, "height", view->height * view->scale);
    } else {
        cJSON_AddNumberToObject(camera, "fov", view->fov);
    }
    cJSON_AddItemToObject(camera, "position", cJSON_CreateDoubleArray(view->from, 3));
    cJSON_ReplaceItemInObject(document, "camera", camera);
}

/* The document as it is seen: its camera set, everything scaled. */
static struct scene *scene_of(const struct seen_case *it, const struct view *view)
{
    cJSON *document = it->type ? read_golden(it->type) : read_composition(it->composition);
    cJSON *transform = cJSON_CreateObject(), *render = cJSON_CreateObject();
    struct error err = {0};

    if (view->fov > 0 || view->height > 0) {
        set_camera(document, view);
    }
    scale_vector(cJSON_GetObjectItem(document, "camera"), "position", view->scale);
    scale_vector(cJSON_GetObjectItem(document, "camera"), "target", view->scale);
    cJSON_AddNumberToObject(transform, "scale", view->scale);
    cJSON_AddItemToObject(cJSON_GetObjectItem(document, "root"), "transform", transform);
    cJSON_AddNumberToObject(render, "max_distance", 120 * view->scale);
    cJSON_AddItemToObject(document, "render", render);
    struct scene *scene = scene_read(document, &err);
    if (!scene) {
        fail_msg("%s: %s: %s", it->name, err.place, err.message);
    }
    cJSON_Delete(document);
    return scene;
}

/* --- rays --- */

struct eye {
    double place[3], forward[3], right[3], up[3]; /* of length 1 */
    double half;                                  /* of the picture's height, at distance 1 */
    bool parallel;
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void to_unit(double v[3])
{
    const double length = sqrt(dot(v, v));

    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

static struct eye eye_of(const struct record *camera)
{
    struct eye eye = {.parallel = record_is(camera, "type", "orthographic")};
    const double *target = record_vector(camera, "target");

    memcpy(eye.place, record_vector(camera, "position"), sizeof eye.place);
    for (int i = 0; i < 3; i++) {
        eye.forward[i] = target[i] - eye.place[i];
    }
    to_unit(eye.forward);
    cross(eye.forward, record_vector(camera, "up"), eye.right);
    to_unit(eye.right);
    cross(eye.right, eye.forward, eye.up);
    eye.half = eye.parallel ? record_number(camera, "height") / 2
                            : tan(record_number(camera, "fov") / 2 * M_PI / 180);
    return eye;
}

/* Through the centre of a pixel. */
static void ray_of(const struct eye *eye, int pixel, double origin[3], double direction[3])
{
    const double side = 2 * eye->half / HEIGHT;
    const double x = side * (pixel % WIDTH + 0.5 - WIDTH / 2.0);
    const double y = side * (HEIGHT / 2.0 - pixel / WIDTH - 0.5);

    for (int i = 0; i < 3; i++) {
        const double aside = x * eye->right[i] + y * eye->up[i];
        origin[i] = eye->place[i] + (eye->parallel ? aside : 0);
        direction[i] = eye->forward[i] + (eye->parallel ? 0 : aside);
    }
    to_unit(direction);
}

/* --- what the evaluator says --- */

struct found {
    double t; /* -1: nothing */
    double normal[3];
    uint32_t id; /* 0: nothing */
};

struct oracle {
    struct field *field;
    struct eye eye;
    double scale, reach;
    struct found found[PIXELS];
    atomic_int row; /* the next to be taken */
};

/* Sphere tracing (Hart 1996). */
static double march(const struct oracle *oracle, const double origin[3], const double direction[3],
                    double p[3])
{
    double t = 0;

    for (int step = 0; step < STEPS_MAX && t < oracle->reach; step++) {
        for (int i = 0; i < 3; i++) {
            p[i] = origin[i] + t * direction[i];
        }
        const double d = field_distance(oracle->field, p);
        if (d < TOLERANCE * oracle->scale) {
            return t;
        }
        t += d;
    }
    return -1;
}

static void march_pixel(struct oracle *oracle, int pixel)
{
    struct found *found = &oracle->found[pixel];
    double origin[3], direction[3], p[3];

    ray_of(&oracle->eye, pixel, origin, direction);
    found->t = march(oracle, origin, direction, p);
    if (found->t >= 0) {
        field_normal(oracle->field, p, GRADIENT * oracle->scale, found->normal);
        found->id = field_surface(oracle->field, p, NULL).number;
    }
}

static void *march_rows(void *data)
{
    struct oracle *oracle = data;

    for (int row; (row = atomic_fetch_add(&oracle->row, 1)) < HEIGHT;) {
        for (int x = 0; x < WIDTH; x++) {
            march_pixel(oracle, row * WIDTH + x);
        }
    }
    return NULL;
}

/* Caller frees. */
static struct oracle *ask_oracle(const struct scene *scene, double scale)
{
    struct oracle *oracle = calloc(1, sizeof *oracle);
    pthread_t threads[THREADS];

    assert_non_null(oracle);
    oracle->field = compile_field(scene);
    oracle->eye = eye_of(&scene->camera);
    oracle->scale = scale;
    oracle->reach = record_number(&scene->render, "max_distance");
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, march_rows, oracle), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
    }
    field_unref(oracle->field);
    return oracle;
}

/* --- comparison --- */

struct tally {
    int either, both, inner;  /* pixels */
    int depths, normals, ids; /* off, of the inner */
};

/* Whether all around this pixel have its id. */
static bool is_inner(const struct oracle *oracle, int pixel)
{
    for (int i = 0; i < 9; i++) {
        const int x = pixel % WIDTH + i % 3 - 1, y = pixel / WIDTH + i / 3 - 1;
        if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT &&
            oracle->found[y * WIDTH + x].id != oracle->found[pixel].id) {
            return false;
        }
    }
    return oracle->found[pixel].id > 0;
}

static void compare(struct tally *tally, const struct oracle *oracle, int pixel, float depth,
                    const float normal[3], uint32_t id)
{
    const struct found *found = &oracle->found[pixel];
    const bool hit = found->t >= 0, drawn = depth < INFINITY;
    const double n[3] = {normal[0], normal[1], normal[2]};
    const double far = END_OF_SIGHT * oracle->reach;

    if (found->t > far || (drawn && depth > far)) {
        return;
    }
    tally->either += hit || drawn;
    tally->both += hit && drawn;
    if (is_inner(oracle, pixel)) {
        tally->inner++;
        tally->depths += !(fabs(depth - found->t) <= DEPTH_ROOM * oracle->scale);
        tally->normals += !(dot(n, found->normal) >= cos(NORMAL_DEGREES * M_PI / 180));
        tally->ids += id != found->id;
    }
}

/* Takes the scene. */
static struct tally tally_picture(struct scene *scene, const struct oracle *oracle)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct resident *resident = resident_create(renderer, scene, 1);
    desc.as_floats = true;
    desc.aovs[AOV_DEPTH] = desc.aovs[AOV_NORMAL] = desc.aovs[AOV_ID] = true;
    struct drawing drawing = drawing_outputs(renderer, resident, &desc);
    const float *depths = drawing.of[AOV_DEPTH].pixels, *normals = drawing.of[AOV_NORMAL].pixels;
    const uint32_t *ids = drawing.of[AOV_ID].pixels;
    struct tally tally = {0};

    for (int i = 0; i < PIXELS; i++) {
        compare(&tally, oracle, i, depths[i], normals + 3L * i, ids[i]);
    }
    drawing_finish(&drawing);
    resident_destroy(resident);
    return tally;
}

static double percent(int part, int whole)
{
    return 100.0 * part / (whole > 0 ? whole : 1);
}

/* False, with a message, where more is off than may be. */
static bool agrees(const char *name, const struct view *view, const struct tally *tally,
                   bool is_rough)
{
    const bool good = tally->both >= (is_rough ? LEAST_ROUGH : LEAST_OVERLAP) * tally->either &&
                      tally->ids <= MOST_IDS * tally->inner &&
                      (is_rough || (tally->depths <= MOST_DEPTHS * tally->inner &&
                                    tally->normals <= MOST_NORMALS * tally->inner));

    if (!good || wordy) {
        print_message("# %-28s %-14s overlap %.4f, off of %5d inner: depth %6.2f %%, normal %6.2f "
                      "%%, id %5.2f %%%s\n",
                      name, view->name, tally->both / fmax(tally->either, 1), tally->inner,
                      percent(tally->depths, tally->inner), percent(tally->normals, tally->inner),
                      percent(tally->ids, tally->inner), good ? "" : " BAD");
    }
    return good;
}

static bool is_rough(const struct seen_case *it)
{
    for (size_t i = 0; it->type && i < sizeof rough / sizeof rough[0]; i++) {
        if (strcmp(it->name, rough[i]) == 0) {
            return true;
        }
    }
    return false;
}

static bool view_agrees(const struct seen_case *it, const struct view *view)
{
    struct scene *scene = scene_of(it, view);
    struct oracle *oracle = ask_oracle(scene, view->scale);
    const struct tally tally = tally_picture(scene, oracle);

    free(oracle);
    if (tally.either < PIXELS / 400) {
        fail_msg("%s, %s: only %d pixels are covered", it->name, view->name, tally.either);
    }
    return agrees(it->name, view, &tally, is_rough(it));
}

static void test_case(void **state)
{
    const struct seen_case *it = *state;
    bool good = view_agrees(it, &near_view);

    if (it->second) {
        good = view_agrees(it, it->second) && good;
    }
    assert_true(good);
}

/* A function whose bound holds in its box alone is the torus that its formula means. */
static void a_quartic_is_a_torus(void **state)
{
    const struct composition torus = {.name = "torus",
                                      .head = CAMERA,
                                      .root = "{\"type\":\"torus\",\"params\":{\"radius\":0.6,"
                                              "\"tube\":0.2}," TURNED "}"};
    const struct seen_case it = {.name = "torus", .composition = &torus};
    const struct seen_case quartic = {.name = "quartic torus", .composition = &compositions[0]};
    struct scene *scene = scene_of(&it, &near_view);
    struct oracle *oracle = ask_oracle(scene, 1);
    const struct tally tally = tally_picture(scene_of(&quartic, &near_view), oracle);

    (void)state;
    scene_destroy(scene);
    free(oracle);
    assert_true(agrees("quartic for torus", &near_view, &tally, false));
}

static void another_scene_is_noticed(void **state)
{
    const struct seen_case sphere = {.name = "sphere", .type = node_type_find("sphere")};
    const struct seen_case other = {.name = "ellipsoid", .type = node_type_find("ellipsoid")};
    struct scene *scene = scene_of(&sphere, &near_view);
    struct oracle *oracle = ask_oracle(scene, 1);
    const struct tally tally = tally_picture(scene_of(&other, &near_view), oracle);

    (void)state;
    scene_destroy(scene);
    free(oracle);
    assert_false(agrees("another scene", &near_view, &tally, false));
}

/* --- */

static struct seen_case cases[CASES_MAX];

static size_t list_cases(void)
{
    size_t n = 0;

    for (size_t i = 0; i < node_type_count() && n < CASES_MAX; i++, n++) {
        cases[n].type = node_type_at(i);
        snprintf(cases[n].name, sizeof cases[n].name, "%s", cases[n].type->record.name);
    }
    for (size_t i = 0; i < COMPOSITIONS && n < CASES_MAX; i++, n++) {
        cases[n].composition = &compositions[i];
        snprintf(cases[n].name, sizeof cases[n].name, "%s", compositions[i].name);
    }
    for (size_t i = 0; i < n; i++) {
        const struct composition *composition = cases[i].composition;
        cases[i].second = composition && composition->inside ? NULL : &views[i % VIEWS];
    }
    return n;
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* An argument, as "*torus*", chooses cases, and all figures are printed. */
int main(int argc, char **argv)
{
    static struct CMUnitTest tests[CASES_MAX + 2];
    const size_t count = list_cases();
    size_t n = 0;

    tests[n++] = (struct CMUnitTest)cmocka_unit_test(another_scene_is_noticed);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(a_quartic_is_a_torus);
    for (size_t i = 0; i < count; i++) {
        tests[n++] = (struct CMUnitTest){cases[i].name, test_case, NULL, NULL, &cases[i]};
    }
    if (argc > 1) {
        cmocka_set_test_filter(argv[1]);
        wordy = true;
    }
    return _cmocka_run_group_tests("seen", tests, n, start, stop);
}
