/* SPDX-License-Identifier: MIT */
#include "power.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "tests/support/drivers/disk_driver.h"

enum { SECTOR = 512, PATH = 400 };

/* --- the record --- */

static void *read_whole(const char *file, size_t *out_length)
{
    struct stat status;
    const int fd = open(file, O_RDONLY);
    char *bytes = NULL;

    if (fd >= 0 && fstat(fd, &status) == 0) {
        bytes = memory_alloc((size_t)status.st_size + 1, 1);
        *out_length = 0;
        for (ssize_t got;
             (got = read(fd, bytes + *out_length, (size_t)status.st_size - *out_length)) > 0;) {
            *out_length += (size_t)got;
        }
    }
    close(fd);
    return bytes;
}

/* A file that was removed and made again is another one. */
static void number_inodes(struct power_record *record)
{
    for (size_t i = 0; i < record->count; i++) {
        for (size_t made = i + 1; made-- > 0;) {
            const struct power_event *before = &record->events[made];
            if (before->call == DISK_MADE && strcmp(before->path, record->events[i].path) == 0) {
                record->events[i].inode = made;
                break;
            }
        }
    }
}

bool power_record_read(struct power_record *record, const char *file)
{
    size_t length = 0, at = 0;
    const char *text = read_whole(file, &length);

    *record = (struct power_record){.text = (void *)text};
    while (text && at + sizeof(struct disk_entry) <= length) {
        struct disk_entry entry;
        memcpy(&entry, text + at, sizeof entry);
        at += sizeof entry;
        record->events = memory_resize(record->events, record->count + 1, sizeof *record->events);
        record->events[record->count++] = (struct power_event){
            .call = entry.call,
            .at = entry.at,
            .path = strndup(text + at, entry.path_length),
            .bytes = (const uint8_t *)text + at + entry.path_length,
            .length = entry.length,
        };
        at += entry.path_length + entry.length;
    }
    number_inodes(record);
    return record->count > 0 && at == length;
}

void power_record_finish(struct power_record *record)
{
    for (size_t i = 0; i < record->count; i++) {
        free((char *)record->events[i].path);
    }
    free(record->events);
    free(record->text);
    *record = (struct power_record){0};
}

/* --- images --- */

struct image {
    const struct power_record *record;
    size_t end; /* nothing of this event and later ones */
    int luck;
    uint64_t random;
};

static uint64_t next_random(struct image *image)
{
    image->random = image->random * 6364136223846793005ULL + 1442695040888963407ULL;
    return image->random >> 33;
}

/* The event behind which nothing of this path is synced. */
static size_t synced_until(const struct image *image, const char *path, size_t inode)
{
    for (size_t i = image->end; i-- > 0;) {
        const struct power_event *event = &image->record->events[i];
        if (event->call == DISK_SYNC && strcmp(event->path, path) == 0 &&
            (inode == SIZE_MAX || event->inode == inode)) {
            return i;
        }
    }
    return 0;
}

static size_t parent_length(const char *path)
{
    return (size_t)(strrchr(path, '/') - path);
}

static bool is_entry(const struct power_event *event)
{
    return event->call == DISK_MADE || event->call == DISK_REMOVE;
}

/* How much of what was done to a directory is there: the events before this one. */
static size_t entries_until(struct image *image, const char *directory)
{
    const size_t synced = synced_until(image, directory, SIZE_MAX);
    size_t until = synced;

    for (size_t i = synced; i < image->end; i++) {
        const struct power_event *event = &image->record->events[i];
        if (!is_entry(event) || parent_length(event->path) != strlen(directory) ||
            strncmp(event->path, directory, strlen(directory)) != 0) {
            continue;
        }
        if (image->luck == POWER_NOTHING || (image->luck >= POWER_ANY && next_random(image) % 2)) {
            break;
        }
        until = i + 1;
    }
    return until;
}

/* Whether the entry that was made by this event is in the directory. */
static bool is_there(const struct image *image, size_t made, size_t until)
{
    const char *path = image->record->events[made].path;

    for (size_t i = made + 1; i < until; i++) {
        const struct power_event *event = &image->record->events[i];
        if (is_entry(event) && strcmp(event->path, path) == 0) {
            return false;
        }
    }
    return made < until;
}

static void write_part(int fd, const struct power_event *event, size_t from, size_t length)
{
    if (pwrite(fd, event->bytes + from, length, event->at + (off_t)from) != (ssize_t)length) {
        abort();
    }
}

/* A disk writes sectors, in any order. */
static void write_torn(struct image *image, int fd, const struct power_event *event)
{
    const size_t half = event->length / 2 / SECTOR * SECTOR;

    if (image->luck == POWER_LAST_TORN) {
        write_part(fd, event, 0, half);
        return;
    }
    for (size_t from = 0; from < event->length; from += SECTOR) {
        if (next_random(image) % 2) {
            write_part(fd, event, from,
                       event->length - from < SECTOR ? event->length - from : SECTOR);
        }
    }
}

static bool is_change(const struct power_event *event, size_t inode)
{
    return event->inode == inode && (event->call == DISK_WRITE || event->call == DISK_CUT);
}

static void write_file(struct image *image, size_t made, const char *to)
{
    const struct power_event *events = image->record->events;
    const size_t synced = synced_until(image, events[made].path, made);
    const int fd = open(to, O_RDWR | O_CREAT | O_TRUNC, 0600);
    size_t last = 0;

    for (size_t i = synced; i < image->end; i++) {
        last = is_change(&events[i], made) ? i : last;
    }
    for (size_t i = made; i < image->end; i++) {
        if (!is_change(&events[i], made)) {
            continue;
        }
        const bool sure = i < synced, any = image->luck >= POWER_ANY;
        if (!sure && (image->luck == POWER_NOTHING || (any && next_random(image) % 3 == 0))) {
            continue;
        }
        const bool torn = !sure && ((image->luck == POWER_LAST_TORN && i == last) ||
                                    (any && next_random(image) % 2));
        if (events[i].call == DISK_CUT && ftruncate(fd, events[i].at) != 0) {
            abort();
        } else if (events[i].call == DISK_WRITE && torn) {
            write_torn(image, fd, &events[i]);
        } else if (events[i].call == DISK_WRITE) {
            write_part(fd, &events[i], 0, events[i].length);
        }
    }
    close(fd);
}

static void write_directory(struct image *image, const char *from, const char *to)
{
    const size_t until = entries_until(image, from);

    for (size_t i = 0; i < until; i++) {
        const struct power_event *event = &image->record->events[i];
        char path[PATH];
        if (event->call != DISK_MADE || parent_length(event->path) != strlen(from) ||
            strncmp(event->path, from, strlen(from)) != 0 || !is_there(image, i, until)) {
            continue;
        }
        snprintf(path, sizeof path, "%s%s", to, event->path + strlen(from));
        if (event->at == 0) {
            write_file(image, i, path);
        } else if (mkdir(path, 0700) == 0) {
            write_directory(image, event->path, path);
        }
    }
}

void power_image(const struct power_record *record, size_t event, int luck, const char *from,
                 const char *to)
{
    struct image image = {record, event, luck, event * 131 + (size_t)luck};

    write_directory(&image, from, to);
}
