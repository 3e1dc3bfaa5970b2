/* SPDX-License-Identifier: MIT */
#include "id_set.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "memory.h"
#include "record.h"

void id_set_finish(struct id_set *set)
{
    for (size_t i = 0; i < set->count; i++) {
        free(set->ids[i]);
    }
    free(set->ids);
    *set = (struct id_set){0};
}

void id_set_copy(struct id_set *to, const struct id_set *from)
{
    *to = (struct id_set){.count = from->count};
    if (from->count > 0) {
        to->ids = memory_alloc(from->count, sizeof *to->ids);
    }
    for (size_t i = 0; i < from->count; i++) {
        to->ids[i] = memory_text(from->ids[i]);
    }
}

bool id_set_equal(const struct id_set *a, const struct id_set *b)
{
    size_t i = 0;

    while (i < a->count && i < b->count && strcmp(a->ids[i], b->ids[i]) == 0) {
        i++;
    }
    return i == a->count && i == b->count;
}

static bool check(const cJSON *list, int most, const char *place, struct error *err)
{
    const cJSON *id;
    int index = 0;

    if (!cJSON_IsArray(list)) {
        return error_set(err, ERROR_SYNTAX, place, "expected a list of ids");
    }
    cJSON_ArrayForEach(id, list)
    {
        if (index == most) {
            return error_set(err, ERROR_LIMIT, place, "%d ids are above the maximum %d",
                             cJSON_GetArraySize(list), most);
        }
        if (!cJSON_IsString(id) || !record_name_valid(id->valuestring)) {
            char item[ERROR_PLACE_BYTES], number[16];
            snprintf(number, sizeof number, "%d", index);
            error_place(item, place, number);
            return error_set(err, ERROR_INVALID, item, "expected the id of a node");
        }
        index++;
    }
    return true;
}

static int compare_ids(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

bool id_set_read(struct id_set *out, const cJSON *list, int most, const char *place,
                 struct error *err)
{
    const char *ids[LIMIT_ISOLATED];
    struct id_set all = {.ids = (char **)ids}, once = {.ids = (char **)ids};
    const cJSON *id;

    if (!check(list, most, place, err)) {
        return false;
    }
    cJSON_ArrayForEach(id, list)
    {
        ids[all.count++] = id->valuestring;
    }
    qsort(ids, all.count, sizeof *ids, compare_ids);
    for (size_t i = 0; i < all.count; i++) {
        if (i == 0 || strcmp(ids[i], ids[once.count - 1]) != 0) {
            ids[once.count++] = ids[i];
        }
    }
    id_set_finish(out);
    id_set_copy(out, &once);
    return true;
}

cJSON *id_set_print(const struct id_set *set)
{
    cJSON *list = cJSON_CreateArray();

    for (size_t i = 0; i < set->count; i++) {
        cJSON_AddItemToArray(list, cJSON_CreateString(set->ids[i]));
    }
    return list;
}
