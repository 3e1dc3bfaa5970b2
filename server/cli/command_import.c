/* SPDX-License-Identifier: MIT */
/* fieldcast import: a folder in the format of protocol/import.h becomes a document. */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command.h"
#include "files.h"
#include "protocol/import/import.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

enum { FOLDERS_DEEP = 16 }; /* ends a circle of links, too */

struct folder {
    struct import_file *files;
    size_t count, room, bytes;
    struct error *err;
};

static bool add_file(struct folder *folder, char *path)
{
    size_t length = 0;
    char *text = folder->count < LIMIT_JSON_KEYS
                     ? file_read(path, LIMIT_DOCUMENT_BYTES, &length, folder->err)
                     : NULL;

    if (!text) {
        if (folder->count == LIMIT_JSON_KEYS) {
            error_set(folder->err, ERROR_LIMIT, path, "more files than the maximum %d",
                      LIMIT_JSON_KEYS);
        }
        free(path);
        return false;
    }
    if (folder->count == folder->room) {
        folder->room = folder->room ? 2 * folder->room : 64;
        folder->files = memory_resize(folder->files, folder->room, sizeof *folder->files);
    }
    folder->files[folder->count++] = (struct import_file){path, text, length};
    folder->bytes += length;
    return folder->bytes <= LIMIT_DOCUMENT_BYTES ||
           error_set(folder->err, ERROR_TOO_LARGE, path,
                     "the files are larger than the maximum of %d bytes", LIMIT_DOCUMENT_BYTES);
}

static bool add_folder(struct folder *folder, const char *path, int depth);

static bool add_entry(struct folder *folder, const char *path, const char *name, int depth)
{
    struct stat about;
    char *whole = NULL;
    bool ok = true;

    if (name[0] == '.') {
        return true;
    }
    if (asprintf(&whole, "%s/%s", path, name) < 0) {
        abort();
    }
    if (stat(whole, &about) != 0) {
        ok = error_set(folder->err, ERROR_INVALID, whole, "%s", strerror(errno));
    } else if (S_ISDIR(about.st_mode)) {
        ok = add_folder(folder, whole, depth + 1);
    } else if (S_ISREG(about.st_mode) && import_reads(name)) {
        return add_file(folder, whole);
    }
    free(whole);
    return ok;
}

static bool add_folder(struct folder *folder, const char *path, int depth)
{
    DIR *directory = opendir(path);
    const struct dirent *entry;
    bool ok = true;

    if (!directory) {
        return error_set(folder->err, ERROR_INVALID, path, "%s", strerror(errno));
    }
    if (depth > FOLDERS_DEEP) {
        ok = error_set(folder->err, ERROR_LIMIT, path, "more than %d folders deep", FOLDERS_DEEP);
    }
    while (ok && (entry = readdir(directory))) {
        ok = add_entry(folder, path, entry->d_name, depth);
    }
    closedir(directory);
    return ok;
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const struct import_file *)a)->path, ((const struct import_file *)b)->path);
}

static void folder_finish(struct folder *folder)
{
    for (size_t i = 0; i < folder->count; i++) {
        free((char *)folder->files[i].path);
        free((char *)folder->files[i].text);
    }
    free(folder->files);
}

static bool import(const struct options *options, struct error *err)
{
    struct folder folder = {.err = err};
    struct scene *scene = NULL;
    cJSON *notes = NULL;
    const cJSON *note;
    bool ok = false;

    if (add_folder(&folder, options->operands[0], 1)) {
        qsort(folder.files, folder.count, sizeof *folder.files, compare);
        scene = import_scene(&(struct import_source){.files = folder.files,
                                                     .count = folder.count,
                                                     .scene = option_text(options, OPTION_SCENE)},
                             &notes, err);
    }
    folder_finish(&folder);
    cJSON_ArrayForEach(note, notes)
    {
        fprintf(stderr, "%s\n", note->valuestring);
    }
    if (scene) {
        char *text = scene_print(scene, true);
        ok = file_replace(option_text(options, OPTION_OUTPUT), text, strlen(text), err);
        free(text);
    }
    cJSON_Delete(notes);
    scene_destroy(scene);
    return ok;
}

int command_import(const struct options *options)
{
    struct error err = {0};
    int status = EXIT_USAGE;

    if (!option_text(options, OPTION_OUTPUT)) {
        error_set(&err, ERROR_INVALID, "--output", "is needed: the document to write");
    } else if (import(options, &err)) {
        return EXIT_OK;
    } else {
        status = EXIT_FAILED;
    }
    fputs("fieldcast: ", stderr);
    error_print(&err, stderr);
    return status;
}
