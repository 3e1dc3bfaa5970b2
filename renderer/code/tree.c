/* SPDX-License-Identifier: MIT */
/* Memory, names and errors of a tree. */
#include "tree.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum { CHUNK_BYTES = 16384 };

struct tree_chunk {
    struct tree_chunk *next;
    size_t used, size;
    _Alignas(max_align_t) char bytes[];
};

void tree_init(struct tree *tree, struct error *err)
{
    *tree = (struct tree){.err = err};
    tree->last_function = &tree->functions;
    tree->last_called = &tree->called;
    tree->last_declared = &tree->declared;
}

void tree_finish(struct tree *tree)
{
    for (struct tree_chunk *chunk = tree->chunks, *next; chunk; chunk = next) {
        next = chunk->next;
        free(chunk);
    }
    tree->chunks = NULL;
}

void *tree_alloc(struct tree *tree, size_t size)
{
    const size_t align = _Alignof(max_align_t);
    struct tree_chunk *chunk = tree->chunks;

    size = (size + align - 1) / align * align;
    if (!chunk || chunk->size - chunk->used < size) {
        const size_t bytes = size > CHUNK_BYTES ? size : CHUNK_BYTES;
        chunk = memory_alloc(1, sizeof *chunk + bytes);
        chunk->size = bytes;
        chunk->next = tree->chunks;
        tree->chunks = chunk;
    }
    void *block = chunk->bytes + chunk->used;
    chunk->used += size;
    return block;
}

struct name *tree_name(struct tree *tree, const char *text, int length)
{
    uint32_t hash = 2166136261u; /* FNV-1a */

    for (int i = 0; i < length; i++) {
        hash = (hash ^ (unsigned char)text[i]) * 16777619u;
    }
    struct name **bucket = &tree->names[hash % 256];
    for (struct name *name = *bucket; name; name = name->next) {
        if (strncmp(name->text, text, (size_t)length) == 0 && name->text[length] == '\0') {
            return name;
        }
    }
    struct name *name = tree_alloc(tree, sizeof *name);
    char *copy = tree_alloc(tree, (size_t)length + 1);
    memcpy(copy, text, (size_t)length);
    name->text = copy;
    name->next = *bucket;
    *bucket = name;
    return name;
}

struct expr *tree_expr(struct tree *tree, enum expr_kind kind, struct at at)
{
    struct expr *expr = tree_alloc(tree, sizeof *expr);

    expr->kind = kind;
    expr->at = at;
    return expr;
}

struct variable *tree_variable(struct tree *tree, struct name *name, struct type type, struct at at)
{
    struct variable *variable = tree_alloc(tree, sizeof *variable);

    variable->name = name;
    variable->type = type;
    variable->at = at;
    variable->number = tree->variable_count++;
    return variable;
}

const char *tree_op_text(enum op op)
{
    static const char *const texts[] = {
#define X(NAME, text) text,
        TREE_OPS(X)
#undef X
    };

    return texts[op];
}

bool tree_fail(struct tree *tree, struct at at, const char *format, ...)
{
    char text[sizeof tree->err->message];
    va_list args;

    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return error_set_at(tree->err, ERROR_COMPILE, "", at.line, at.column, "%s", text);
}

bool tree_fail_limit(struct tree *tree, struct at at, const char *what, long limit,
                     const char *name)
{
    return error_set_at(tree->err, ERROR_LIMIT, "", at.line, at.column,
                        "%s above the maximum %ld (%s)", what, limit, name);
}
