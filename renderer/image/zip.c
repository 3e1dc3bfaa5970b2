/* SPDX-License-Identifier: MIT */
/* ZIP by libarchive. What is in it is compressed already, or is to be mapped by NumPy: it is
 * stored as it is, and dated alike, so that the same pictures make the same file. */
#include <archive.h>
#include <archive_entry.h>

#include "encode.h"

enum { COPY_BYTES = 65536 };

static la_ssize_t on_write(struct archive *archive, void *out, const void *bytes, size_t length)
{
    (void)archive;
    return fwrite(bytes, 1, length, out) == length ? (la_ssize_t)length : -1;
}

static bool write_part(struct archive *archive, struct archive_entry *entry,
                       const struct zip_part *part)
{
    char bytes[COPY_BYTES];
    size_t length;
    bool ok;

    fseeko(part->file, 0, SEEK_END);
    archive_entry_clear(entry);
    archive_entry_set_pathname(entry, part->name);
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, ftello(part->file));
    rewind(part->file);
    ok = archive_write_header(archive, entry) == ARCHIVE_OK;
    while (ok && (length = fread(bytes, 1, sizeof bytes, part->file)) > 0) {
        ok = archive_write_data(archive, bytes, length) == (la_ssize_t)length;
    }
    return ok && !ferror(part->file);
}

bool zip_write(const struct zip_part *parts, size_t count, FILE *out, struct error *err)
{
    struct archive *archive = archive_write_new();
    struct archive_entry *entry = archive_entry_new();
    bool ok = archive && entry && archive_write_set_format_zip(archive) == ARCHIVE_OK &&
              archive_write_zip_set_compression_store(archive) == ARCHIVE_OK &&
              archive_write_set_bytes_in_last_block(archive, 1) == ARCHIVE_OK &&
              archive_write_open(archive, out, NULL, on_write, NULL) == ARCHIVE_OK;

    for (size_t i = 0; ok && i < count; i++) {
        ok = write_part(archive, entry, &parts[i]);
    }
    ok = ok && archive_write_close(archive) == ARCHIVE_OK;
    if (!ok) {
        const char *why = archive ? archive_error_string(archive) : NULL;
        error_set(err, ERROR_INTERNAL, "zip", "%s", why ? why : "cannot be written");
    }
    archive_entry_free(entry);
    archive_write_free(archive);
    return ok;
}
