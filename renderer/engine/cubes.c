/* SPDX-License-Identifier: MIT */
#include "cubes.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

#define KEPT_BYTES ((size_t)256 << 20) /* of all that are kept */
enum { KEPT = 4 };                     /* fields at most */

struct kept {
    struct cubes *cubes;            /* NULL: nothing is here */
    struct engine_program *program; /* counted */
    uint64_t numbers;
    size_t bytes;
};

struct engine_cubes {
    struct kept kept[KEPT]; /* the last one first */
    uint32_t pictures;      /* that began */
};

struct engine_cubes *engine_cubes_create(void)
{
    return memory_alloc(1, sizeof(struct engine_cubes));
}

static void cubes_destroy(struct cubes *cubes)
{
    for (int i = 0; cubes && i < ENGINE_THREADS; i++) {
        cells_finish(cubes->of[i]);
    }
    free(cubes);
}

static void drop(struct kept *kept)
{
    cubes_destroy(kept->cubes);
    engine_program_destroy(kept->program);
    *kept = (struct kept){0};
}

void engine_cubes_forget(struct engine_cubes *cubes)
{
    for (int i = 0; i < KEPT; i++) {
        drop(&cubes->kept[i]);
    }
}

void engine_cubes_destroy(struct engine_cubes *cubes)
{
    if (cubes) {
        engine_cubes_forget(cubes);
        free(cubes);
    }
}

/* From one vec4 of the numbers to before another. */
static uint64_t hash_span(uint64_t hash, const float *params, size_t from, size_t end)
{
    for (size_t i = 2 * from; i < 2 * end; i++) {
        uint64_t pair;
        memcpy(&pair, params + 2 * i, sizeof pair);
        hash = (hash ^ pair) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 32;
    }
    return hash;
}

/* Of the numbers of shapes and operations, and of lists of points, which lie behind the materials:
 * these change no distance. Others have another hash but for one time in 2^64. */
static uint64_t hash_of(const struct engine_program *program, const float *params)
{
    const struct field *field = program->field;
    const size_t materials = (field->material_count + 2) * field->material_stride;
    const uint64_t hash = hash_span(field->vec4_count, params, 0, field->material_base);

    return hash_span(hash, params, field->material_base + materials, field->vec4_count);
}

struct cubes *cubes_take(struct engine_cubes *kept, const struct engine_program *program,
                         const float *params, uint64_t *out_numbers, uint32_t *out_picture)
{
    *out_numbers = hash_of(program, params);
    *out_picture = ++kept->pictures;
    for (int i = 0; i < KEPT; i++) {
        struct kept *one = &kept->kept[i];
        if (one->program == program && one->numbers == *out_numbers) {
            struct cubes *cubes = one->cubes;
            one->cubes = NULL;
            drop(one);
            return cubes;
        }
    }
    return memory_alloc(1, sizeof(struct cubes));
}

static size_t bytes_of(const struct cubes *cubes)
{
    size_t bytes = 0;

    for (int i = 0; i < ENGINE_THREADS * ENGINE_SPACES; i++) {
        const struct cells *cells = &cubes->of[i / ENGINE_SPACES][i % ENGINE_SPACES];
        bytes += cells->capacity * sizeof *cells->at + cells->room * sizeof *cells->tapes +
                 cells->drops_room * sizeof *cells->drops;
    }
    return bytes;
}

void cubes_give(struct engine_cubes *kept, struct engine_program *program, uint64_t numbers,
                struct cubes *cubes)
{
    size_t bytes = 0;

    drop(&kept->kept[KEPT - 1]);
    memmove(&kept->kept[1], &kept->kept[0], (KEPT - 1) * sizeof kept->kept[0]);
    kept->kept[0] = (struct kept){cubes, engine_program_ref(program), numbers, bytes_of(cubes)};
    for (int i = 0; i < KEPT; i++) {
        bytes += kept->kept[i].bytes;
        if (bytes > KEPT_BYTES) {
            drop(&kept->kept[i]);
        }
    }
}
