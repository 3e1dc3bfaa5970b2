/* SPDX-License-Identifier: MIT */
/* Looks up embedded files. */
#include "embedded.h"

#include <string.h>

static const struct embedded *find(const struct embedded *table, size_t count, const char *path)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(table[i].path, path) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

const struct embedded *page_find(const char *path)
{
    return find(page_table, page_count, path);
}

const struct embedded *examples_find(const char *id)
{
    return find(examples_table, examples_count, id);
}

const struct embedded *example_files_find(const char *id)
{
    return find(example_files_table, example_files_count, id);
}

const struct embedded *cards_find(const char *id)
{
    return find(cards_table, cards_count, id);
}

const struct embedded *templates_find(const char *name)
{
    return find(templates_table, templates_count, name);
}

const struct embedded *references_find(const char *type)
{
    return find(references_table, references_count, type);
}
