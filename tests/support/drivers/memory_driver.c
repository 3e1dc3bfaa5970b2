/* SPDX-License-Identifier: MIT */
/* Memory that runs out: loaded in front of libc (LD_PRELOAD), one allocation of the process answers
 * NULL. A test finds memory_fail and memory_count by dlsym. */
#include <dlfcn.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void memory_fail(long nth);
long memory_count(void);

static void *(*real_malloc)(size_t size);
static void *(*real_calloc)(size_t count, size_t size);
static void *(*real_realloc)(void *block, size_t size);
static char first[65536]; /* for what dlsym itself asks for */
static size_t first_used;
static long count, failing;

/* From here on: the allocation that comes as number `nth` fails; 0: none does. */
void memory_fail(long nth)
{
    __atomic_store_n(&count, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&failing, nth, __ATOMIC_SEQ_CST);
}

long memory_count(void)
{
    return __atomic_load_n(&count, __ATOMIC_SEQ_CST);
}

static bool fails(void)
{
    const bool result = __atomic_add_fetch(&count, 1, __ATOMIC_RELAXED) == failing;

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
