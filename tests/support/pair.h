/* SPDX-License-Identifier: MIT */
/* A scene and its field, of a root given as text, and texts of small roots to begin with. */
#ifndef TESTS_SUPPORT_PAIR_H
#define TESTS_SUPPORT_PAIR_H

#include "renderer/field/field.h"

#define BALL(more) "{'type':'sphere','params':{'radius':1}" more "}"
#define BOX "{'type':'box','params':{'size':[2,2,2]}}"
#define HIDDEN BALL(",'visible':false")
#define NOTHING "{'type':'group'}"

struct pair {
    struct scene *scene;
    struct field *field;
};

/* `more`: members of the document besides, each followed by a comma. The test fails where the
 * scene does not compile. */
struct pair pair_of(const char *root, const char *more);
void pair_finish(struct pair *pair);

#endif
