/* SPDX-License-Identifier: MIT */
/* Objects of which all members are known. */
#include <string.h>

#include "json.h"
#include "suggest.h"

static bool fail_member(const char *name, const char *const *names, const char *place,
                        struct error *err)
{
    struct suggestion suggestion = {.text = name};
    char path[ERROR_PLACE_BYTES], hint[64];

    for (int i = 0; names[i]; i++) {
        suggest_consider(&suggestion, names[i]);
    }
    return error_set(err, ERROR_INVALID, error_place(path, place, name),
                     "there is no member \"%.64s\" here%s", name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

bool json_sort_members(const cJSON *object, const char *const *names, const cJSON **found,
                       const char *place, struct error *err)
{
    if (!cJSON_IsObject(object)) {
        return error_set(err, ERROR_INVALID, place, "expected an object");
    }
    for (int i = 0; names[i]; i++) {
        found[i] = NULL;
    }
    for (const cJSON *member = object->child; member; member = member->next) {
        int i = 0;
        while (names[i] && strcmp(names[i], member->string) != 0) {
            i++;
        }
        if (!names[i]) {
            return fail_member(member->string, names, place, err);
        }
        found[i] = member;
    }
    return true;
}

bool json_read_text(const cJSON *json, const char **out, const char *place, const char *member,
                    struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, member);
    if (!json) {
        return error_set(err, ERROR_INVALID, path, "is missing");
    }
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, path, "expected a text");
    }
    *out = json->valuestring;
    return true;
}
