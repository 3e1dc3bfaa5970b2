/* SPDX-License-Identifier: MIT */
/* Nothing in the registry stands alone: every row has its functions in C and GLSL, its golden
 * picture, its place and picture on the reference page. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/nodes.h"
#include "protocol/reference.h"
#include "renderer/glsl/files.h"
#include "renderer/sdf/sdf.h"
#include "server/embedded.h"
#include "tests/support/text_file.h"

static size_t missing;

static void want(bool there, const struct node_type *type, const char *what)
{
    if (!there) {
        print_error("%s has no %s\n", type->record.name, what);
        missing++;
    }
}

/* A function of this name, or of one that starts with it and an underscore. */
static bool in_glsl(const char *name)
{
    for (const struct glsl_file *file = glsl_files; file->name; file++) {
        for (const char *at = file->text; (at = strstr(at, name)); at++) {
            const char before = at > file->text ? at[-1] : ' ', after = at[strlen(name)];
            if (before == ' ' && (after == '(' || after == '_')) {
                return true;
            }
        }
    }
    return false;
}

static bool has_golden(const char *type)
{
    char path[256];

    snprintf(path, sizeof path, "tests/golden/nodes/%s/expected.png", type);
    return access(path, R_OK) == 0;
}

static bool is_on_page(const char *page, const char *type)
{
    char heading[128];

    snprintf(heading, sizeof heading, "\n### %s\n", type);
    return strstr(page, heading) != NULL;
}

static void every_row_is_everywhere(void **state)
{
    (void)state;
    char *page = reference_markdown();
    const struct node_type *type;

    for (size_t i = 0; (type = node_type_at(i)); i++) {
        const bool own = type->kind != KIND_MODEL && type->kind != KIND_CODE &&
                         type->kind != KIND_EQUATION && type->kind != KIND_SURFACE;
        want(!own || sdf_find(type), type, "function in C");
        want(!own || in_glsl(type->glsl), type, "function in GLSL");
        want(has_golden(type->record.name), type, "golden picture");
        want(is_on_page(page, type->record.name), type, "place on the reference page");
        want(references_find(type->record.name) != NULL, type, "picture on the reference page");
    }
    free(page);
    assert_int_equal(missing, 0);
}

static void the_page_in_the_repository_is_up_to_date(void **state)
{
    (void)state;
    size_t length;
    char *stored = text_file_read("protocol/REFERENCE.md", &length);
    char *page = reference_markdown();

    if (strcmp(stored, page) != 0) {
        fail_msg("protocol/REFERENCE.md is not what the tables say: make docs writes it");
    }
    free(page);
    free(stored);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_everywhere),
        cmocka_unit_test(the_page_in_the_repository_is_up_to_date),
    };

    return cmocka_run_group_tests_name("reference", tests, NULL, NULL);
}
