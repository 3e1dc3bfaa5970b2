/* SPDX-License-Identifier: MIT */
/* Drivers of OpenGL get their memory from libc where AddressSanitizer is on: to compile a shader
 * they allocate millions of times, and the sanitizer takes longer for these than the compiler for
 * all else. What happens within a driver is not ours to look at. What it writes into memory of ours
 * is looked at as before.
 *
 * Part of every program that is built with the sanitizer, and built without it. Who allocates is
 * told by the address that the call comes from. Who frees may be another: memory is asked whose it
 * is. C++ is spoken by drivers alone. */
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <link.h>
#include <malloc.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void __libc_free(void *memory);

void *__interceptor_malloc(size_t size);
void *__interceptor_calloc(size_t count, size_t size);
void *__interceptor_realloc(void *memory, size_t size);
void *__interceptor_memalign(size_t alignment, size_t size);
void __interceptor_free(void *memory);
int __sanitizer_get_ownership(const volatile void *memory);
void __lsan_disable(void);
void __lsan_enable(void);
char *__interceptor_strdup(const char *text);
char *__interceptor_strndup(const char *text, size_t size);

/* The sanitizer's. A test may have loaded a library that refuses memory: it stands in between. */
static struct {
    void *(*malloc)(size_t size);
    void *(*calloc)(size_t count, size_t size);
    void *(*realloc)(void *memory, size_t size);
    void (*free)(void *memory);
} checked = {__interceptor_malloc, __interceptor_calloc, __interceptor_realloc, __interceptor_free};
/* The sanitizer has a __libc_memalign of its own. */
static void *(*memalign_of_libc)(size_t alignment, size_t size);
static bool begun; /* before that, all memory is the sanitizer's */

__attribute__((constructor)) static void begin(void)
{
    checked.malloc = (typeof(checked.malloc))dlsym(RTLD_NEXT, "malloc");
    checked.calloc = (typeof(checked.calloc))dlsym(RTLD_NEXT, "calloc");
    checked.realloc = (typeof(checked.realloc))dlsym(RTLD_NEXT, "realloc");
    checked.free = (typeof(checked.free))dlsym(RTLD_NEXT, "free");
    __lsan_disable(); /* what the linker allocates here is not seen as its own */
    memalign_of_libc =
        (typeof(memalign_of_libc))dlsym(dlopen("libc.so.6", RTLD_NOW | RTLD_NOLOAD), "memalign");
    __lsan_enable();
    /* Memory is kept: the kernel hands it out again page by page. */
    mallopt(M_MMAP_THRESHOLD, INT_MAX);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    begun = true;
}

/* --- who calls --- */

static const char *const drivers[] = {"ld-linux", "libLLVM", "swrast_dri", "libgallium",
                                      "libEGL_mesa"};

/* Code of libraries that have called. What is here stays. */
enum { RANGES = 64 };
static struct range {
    uintptr_t first;
    size_t size;
    bool of_driver;
} ranges[RANGES];
static atomic_int range_count;

static bool is_driver(const char *file)
{
    for (size_t i = 0; i < sizeof drivers / sizeof drivers[0]; i++) {
        if (strstr(file, drivers[i])) {
            return true;
        }
    }
    return false;
}

/* One at a time: the linker's lock is held. */
static int add_range(struct dl_phdr_info *info, size_t info_size, void *at)
{
    const int n = atomic_load(&range_count);
    (void)info_size;

    for (int i = 0; i < info->dlpi_phnum && n < RANGES; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        const uintptr_t first = info->dlpi_addr + part->p_vaddr;

        if (part->p_type == PT_LOAD && (uintptr_t)at - first < part->p_memsz) {
            ranges[n] = (struct range){first, part->p_memsz, is_driver(info->dlpi_name)};
            atomic_store(&range_count, n + 1);
            return 1;
        }
    }
    return 0;
}

static const struct range *range_of(uintptr_t at)
{
    const int count = atomic_load(&range_count);

    for (int i = 0; i < count; i++) {
        if (at - ranges[i].first < ranges[i].size) {
            return &ranges[i];
        }
    }
    return NULL;
}

static bool of_driver(void *caller)
{
    extern const char __executable_start[], etext[];
    const uintptr_t at = (uintptr_t)caller;

    if (!begun || at - (uintptr_t)__executable_start < (size_t)(etext - __executable_start)) {
        return false;
    }
    const struct range *range = range_of(at);
    if (!range) {
        dl_iterate_phdr(add_range, caller);
        range = range_of(at);
    }
    return range && range->of_driver;
}
#define DRIVER_CALLS of_driver(__builtin_return_address(0))

/* --- whose memory --- */

/* The sanitizer has its small blocks in one place (kAllocatorSpace of its sources). */
static bool is_small(const void *memory)
{
    const uintptr_t first = 0x600000000000;
    const size_t size = 0x40000000000;

    return (uintptr_t)memory - first < size;
}

/* What the sanitizer gave before it was ready, which it does not own to. */
enum { EARLY = 64 };
static void *early[EARLY];
static int early_count;

static void *noted(void *memory)
{
    if (!begun && !is_small(memory) && early_count < EARLY) {
        early[early_count++] = memory;
    }
    return memory;
}

static bool is_early(const void *memory)
{
    for (int i = 0; i < early_count; i++) {
        if (early[i] == memory) {
            return true;
        }
    }
    return false;
}

/* Its large blocks begin a red zone after a page does (its kMaxRedzone). It is not asked about
 * other places: it would search them under a lock. */
static bool may_be_large(const void *memory)
{
    const uintptr_t red_zone = 2048;

    return (uintptr_t)memory % red_zone == 0;
}

static bool is_of_libc(const void *memory)
{
    return begun && !is_small(memory) && !is_early(memory) &&
           !(may_be_large(memory) && __sanitizer_get_ownership(memory));
}

/* --- the functions --- */

void *malloc(size_t size)
{
    return DRIVER_CALLS ? __libc_malloc(size) : noted(checked.malloc(size));
}

void *calloc(size_t count, size_t size)
{
    return DRIVER_CALLS ? __libc_calloc(count, size) : noted(checked.calloc(count, size));
}

void *realloc(void *memory, size_t size)
{
    const bool of_libc = memory ? is_of_libc(memory) : DRIVER_CALLS;

    return of_libc ? __libc_realloc(memory, size) : noted(checked.realloc(memory, size));
}

void *reallocarray(void *memory, size_t count, size_t size)
{
    if (size > 0 && count > SIZE_MAX / size) {
        errno = ENOMEM;
        return NULL;
    }
    const bool of_libc = memory ? is_of_libc(memory) : DRIVER_CALLS;
    return of_libc ? __libc_realloc(memory, count * size) : checked.realloc(memory, count * size);
}

void free(void *memory)
{
    if (memory && is_of_libc(memory)) {
        __libc_free(memory);
    } else {
        checked.free(memory);
    }
}

static void *aligned(bool of_libc, size_t alignment, size_t size)
{
    return of_libc ? memalign_of_libc(alignment, size) : __interceptor_memalign(alignment, size);
}

void *memalign(size_t alignment, size_t size)
{
    return aligned(DRIVER_CALLS, alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return aligned(DRIVER_CALLS, alignment, size);
}

int posix_memalign(void **out, size_t alignment, size_t size)
{
    *out = aligned(DRIVER_CALLS, alignment, size);
    return *out ? 0 : ENOMEM;
}

static char *copied(const char *text, size_t length)
{
    char *copy = __libc_malloc(length + 1);

    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

char *strdup(const char *text)
{
    return DRIVER_CALLS ? copied(text, strlen(text)) : __interceptor_strdup(text);
}

char *strndup(const char *text, size_t size)
{
    return DRIVER_CALLS ? copied(text, strnlen(text, size)) : __interceptor_strndup(text, size);
}

/* --- those of C++ --- */

typedef struct nothrow nothrow; /* std::nothrow_t */

void *new_object(size_t size) __asm__("_Znwm");
void *new_array(size_t size) __asm__("_Znam");
void *new_object_or_none(size_t size, const nothrow *) __asm__("_ZnwmRKSt9nothrow_t");
void *new_array_or_none(size_t size, const nothrow *) __asm__("_ZnamRKSt9nothrow_t");
void delete_object(void *memory) __asm__("_ZdlPv");
void delete_array(void *memory) __asm__("_ZdaPv");
void delete_object_of_size(void *memory, size_t size) __asm__("_ZdlPvm");
void delete_array_of_size(void *memory, size_t size) __asm__("_ZdaPvm");
void delete_object_or_none(void *memory, const nothrow *) __asm__("_ZdlPvRKSt9nothrow_t");
void delete_array_or_none(void *memory, const nothrow *) __asm__("_ZdaPvRKSt9nothrow_t");

void *new_object(size_t size)
{
    void *memory = __libc_malloc(size);

    if (!memory) {
        abort();
    }
    return memory;
}

void *new_array(size_t size)
{
    return new_object(size);
}

void *new_object_or_none(size_t size, const nothrow *)
{
    return __libc_malloc(size);
}

void *new_array_or_none(size_t size, const nothrow *)
{
    return __libc_malloc(size);
}

void delete_object(void *memory)
{
    free(memory);
}

void delete_array(void *memory)
{
    free(memory);
}

void delete_object_of_size(void *memory, size_t)
{
    free(memory);
}

void delete_array_of_size(void *memory, size_t)
{
    free(memory);
}

void delete_object_or_none(void *memory, const nothrow *)
{
    free(memory);
}

void delete_array_or_none(void *memory, const nothrow *)
{
    free(memory);
}
