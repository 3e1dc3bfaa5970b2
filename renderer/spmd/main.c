/* SPDX-License-Identifier: MIT */
/* spmd table:                  rows in C: what each instruction of a field does, KERNEL_ROW(type,
 *                              choices, kind, function), and what users' code calls (calls.h)
 * spmd text FILE MORE:         our GLSL that a file includes, for the C preprocessor; it may
 *                              include the second, too
 * spmd c FILE ENTRY...:        what came out of that, and all that the entries call, as C
 * spmd h FILE ENTRY...:        how our C calls it */
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "renderer/field/shader.h"
#include "renderer/glsl/include.h"
#include "spmd.h"

/* What of the field is asked for is renderer/engine's; numbers lie in memory. */
static const struct glsl_file own[] = {
    {"field_map.glsl", "float map(vec3 p);\n"},
    {"field_bound.glsl", "float field_bound(vec3 p, float distance, float enough);\n"
                         "bool field_waits(float d);\n"},
    {"field_surface.glsl", "#include \"surface.glsl\"\n"
                           "void surface(vec3 p, Shading at, out Surface s);\n"},
    {"params.glsl", "#define P(i) own_param(i)\n#define P_ANY(i) param(i)\n"
                    "#define P_FROM(i) own_param(i)\n"
                    "#define ANY_LANE(x) any_lane(x)\n#define FIRST_LANE(x) first_lane(x)\n"},
    {NULL, NULL},
};

static char *kernel_text;

/* One for each type, each combination of its choices, and each kind. */
static void write_kernel(FILE *out, const struct node_type *type, uint32_t choices,
                         enum shader_kernel kernel, bool table)
{
    static const char *const kinds[] = {
#define X(NAME) #NAME,
        SHADER_KERNELS(X)
#undef X
    };
    char name[128];

    snprintf(name, sizeof name, "kernel_%s_%s_%u", kinds[kernel], type->record.name, choices);
    if (table) {
        fprintf(out, "KERNEL_ROW(%d, %u, %s, spmd_%s)\n", type->number, choices, kinds[kernel],
                name);
    } else {
        shader_kernel(out, name, type, choices, kernel);
    }
}

static void write_choices(FILE *out, const struct node_type *type, const struct param *param,
                          uint32_t choices, bool table)
{
    for (; param->name && param->type != PARAM_ENUM; param++) {
    }
    if (!param->name) {
        for (int kernel = KERNEL_SHAPE; kernel <= KERNEL_AFTER; kernel++) {
            if (shader_has_kernel(type, (enum shader_kernel)kernel)) {
                write_kernel(out, type, choices, (enum shader_kernel)kernel, table);
            }
        }
        return;
    }
    for (uint32_t i = 0; param->choices[i]; i++) {
        write_choices(out, type, param + 1, choices << 8 | i, table);
    }
}

static void write_kernels(FILE *out, bool table)
{
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind == KIND_EQUATION || type->kind == KIND_SURFACE) {
            write_kernel(out, type, type->kind == KIND_SURFACE ? FIELD_PATCHES : FIELD_POLYNOMIAL,
                         KERNEL_SHAPE, table);
        } else if (sdf_find(type)) {
            write_choices(out, type, type->record.params, 0, table);
        }
    }
    if (!table) {
        shader_code_kernels(out);
    }
    spmd_write_calls(out, table);
}

static char *read_all(const char *path)
{
    FILE *in = fopen(path, "r");
    char *text = malloc(1 << 22);
    const size_t length = in && text ? fread(text, 1, (1 << 22) - 1, in) : 0;

    if (!in || !text) {
        fprintf(stderr, "spmd: cannot read %s\n", path);
        exit(1);
    }
    text[length] = '\0';
    fclose(in);
    return text;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? slash + 1 : path;
}

static int write_text(const char *file, const char *more)
{
    struct error err = {0};
    struct shader_text text;

    struct glsl_file files[sizeof own / sizeof own[0] + 3];
    size_t length;
    FILE *kernels = open_memstream(&kernel_text, &length);
    memcpy(files + 3, own, sizeof own);
    files[0] = (struct glsl_file){file, read_all(file)};
    files[2] = (struct glsl_file){name_of(more), read_all(more)};
    fputs("#include \"builtins.glsl\"\n#include \"field.glsl\"\n", kernels);
    write_kernels(kernels, false);
    fclose(kernels);
    files[1] = (struct glsl_file){"kernels.glsl", kernel_text};
    if (!include_resolve(&text, "", file, files, &err)) {
        error_print(&err, stderr);
        return 1;
    }
    fputs(text.text, stdout);
    include_finish(&text);
    free((char *)files[0].text);
    free((char *)files[2].text);
    return 0;
}

static int write_c(const char *file, bool header, const char *const *entries, size_t count)
{
    struct error err = {0};
    struct tree tree;
    char *text = read_all(file);

    tree_init(&tree, &err);
    tree.whole = true;
    /* "kernel_*": all functions whose names begin so. */
    bool ok = parser_read(&tree, text) && spmd_resolve(&tree, entries, count);
    if (ok) {
        spmd_vary(&tree, entries, count);
        ok = header ? spmd_emit_header(&tree, entries, count, stdout)
                    : spmd_emit(&tree, entries, count, stdout);
    }
    if (!ok) {
        error_print(&err, stderr);
    }
    tree_finish(&tree);
    free(text);
    return ok ? 0 : 1;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "table") == 0) {
        write_kernels(stdout, true);
        return 0;
    }
    if (argc == 4 && strcmp(argv[1], "text") == 0) {
        return write_text(argv[2], argv[3]);
    }
    if (argc > 3 && (strcmp(argv[1], "c") == 0 || strcmp(argv[1], "h") == 0)) {
        return write_c(argv[2], argv[1][0] == 'h', (const char *const *)argv + 3,
                       (size_t)(argc - 3));
    }
    fprintf(stderr, "usage: spmd table | spmd text FILE MORE | spmd c|h FILE ENTRY...\n");
    return 2;
}
