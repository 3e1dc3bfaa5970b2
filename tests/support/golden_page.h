/* SPDX-License-Identifier: MIT */
/* The page that a run of golden pictures leaves: index.html, which is tests/golden/page.html as it
 * is, and cases.js beside it, which calls the page once for each case. The page shows
 * NAME-expected.png, NAME-actual.png and NAME-difference.png of the same folder, '/' in names being
 * '-'. */
#ifndef TESTS_SUPPORT_GOLDEN_PAGE_H
#define TESTS_SUPPORT_GOLDEN_PAGE_H

#include <stdio.h>

#include "picture.h"

struct golden_verdict {
    bool same, compared; /* compared: both pictures are there, of one size */
    struct picture_difference difference;
    char message[300]; /* what is wrong; empty where nothing is */
};

/* NULL, with errno, where `folder` cannot be written to. */
FILE *golden_page_begin(const char *folder);
void golden_page_add(FILE *cases, const char *name, const struct golden_verdict *verdict);
void golden_page_end(FILE *cases);

#endif
