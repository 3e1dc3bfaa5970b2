/* SPDX-License-Identifier: MIT */
/* Memory that runs out: loaded in front of libc (LD_PRELOAD), one allocation of the process answers
 * NULL. A test finds memory_fail and memory_count by dlsym, or shares the file MEMORY_FILE: three
 * numbers of eight bytes, the process that is meant, how many allocations it has made, and which
 * of them fails. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void memory_fail(long nth);
long memory_count(void);

static void *(*real_malloc)(size_t size);
static void *(*real_calloc)(size_t count, size_t size);
static void *(*real_realloc)(void *block, size_t size);
static char first[65536]; /* for what dlsym itself asks for */
static size_t first_used;
static long numbers[3]; /* where there is no file */
static long *shared = numbers;

enum { PROCESS, COUNT, FAILING };

__attribute__((constructor)) static void open_file(void)
{
    const char *path = getenv("MEMORY_FILE");
    const int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *bytes =
        fd < 0 ? MAP_FAILED : mmap(NULL, sizeof numbers, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

    if (bytes != MAP_FAILED) {
        shared = bytes;
    }
    if (fd >= 0) {
        close(fd);
    }
}

/* From here on: the allocation that comes as number `nth` fails; 0: none does. */
void memory_fail(long nth)
{
    __atomic_store_n(&shared[COUNT], 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&shared[FAILING], nth, __ATOMIC_SEQ_CST);
}

long memory_count(void)
{
    return __atomic_load_n(&shared[COUNT], __ATOMIC_SEQ_CST);
}

static bool fails(void)
{
    if (shared != numbers && shared[PROCESS] != getpid()) {
        return false;
    }
    const bool result = __atomic_add_fetch(&shared[COUNT], 1, __ATOMIC_RELAXED) == shared[FAILING];

    if (result) {
        errno = ENOMEM;
    }
    return result;
}

static void find_real(void)
{
    static bool finding;

    if (!real_realloc && !finding) {
        finding = true;
        real_malloc = (typeof(real_malloc))dlsym(RTLD_NEXT, "malloc");
        real_calloc = (typeof(real_calloc))dlsym(RTLD_NEXT, "calloc");
        real_realloc = (typeof(real_realloc))dlsym(RTLD_NEXT, "realloc");
        finding = false;
    }
}

static void *early(size_t size)
{
    void *block = first + first_used;

    first_used += (size + 15) / 16 * 16;
    if (first_used > sizeof first) {
        abort();
    }
    return block;
}

void *malloc(size_t size)
{
    find_real();
    return !real_malloc ? early(size) : fails() ? NULL : real_malloc(size);
}

void *calloc(size_t number, size_t size)
{
    find_real();
    return !real_calloc ? early(number * size) : fails() ? NULL : real_calloc(number, size);
}

void *realloc(void *block, size_t size)
{
    find_real();
    return fails() ? NULL : real_realloc(block, size);
}
