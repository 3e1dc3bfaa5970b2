/* SPDX-License-Identifier: MIT */
#include "golden_page.h"

#include <stdlib.h>

#include "protocol/json.h"
#include "text_file.h"

enum { PATH_BYTES = 2048 };

FILE *golden_page_begin(const char *folder)
{
    char path[PATH_BYTES];
    size_t length;
    char *page = text_file_read("tests/golden/page.html", &length);
    FILE *file;

    snprintf(path, sizeof path, "%s/index.html", folder);
    file = fopen(path, "w");
    if (file) {
        fwrite(page, 1, length, file);
        fclose(file);
        snprintf(path, sizeof path, "%s/cases.js", folder);
        file = fopen(path, "w");
    }
    free(page);
    if (file) {
        fprintf(file, "begin({steps: %d, pixels: %g, mean: %g});\n", PICTURE_STEPS,
                1.0 / PICTURE_PIXELS, PICTURE_MEAN);
    }
    return file;
}

/* Flushed, so that the page of a run that died shows what was drawn until then. */
void golden_page_add(FILE *cases, const char *name, const struct golden_verdict *verdict)
{
    const struct picture_difference *difference = &verdict->difference;
    cJSON *row = cJSON_CreateObject();
    char *text;

    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddBoolToObject(row, "same", verdict->same);
    cJSON_AddStringToObject(row, "message", verdict->message);
    if (verdict->compared) {
        cJSON_AddNumberToObject(row, "pixels", (double)difference->pixels / difference->of);
        cJSON_AddNumberToObject(row, "greatest", difference->greatest);
        cJSON_AddNumberToObject(row, "mean", difference->mean);
    }
    text = json_print(row, false);
    fprintf(cases, "add(%s);\n", text);
    fflush(cases);
    free(text);
    cJSON_Delete(row);
}

void golden_page_end(FILE *cases)
{
    fprintf(cases, "end();\n");
    fclose(cases);
}
