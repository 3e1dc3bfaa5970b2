/* SPDX-License-Identifier: MIT */
/* The text is a list of items: each a line that begins with #, or a declaration, with the comments
 * before it. An item is kept where its name is reached; what it mentions is reached then. */
#include "reach.h"

#include <ctype.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct piece {
    const char *begin, *end;
};

struct item {
    struct piece whole, text; /* with and without the comments before it */
    struct piece name;        /* empty: it is kept in any case */
    bool kept;
};

/* A word by which an item is reached. */
struct entry {
    struct piece word;
    size_t item;
};

/* In the order of their words. */
struct entries {
    struct entry *at;
    size_t count;
};

struct items {
    struct item *at;
    size_t count;
    struct entries names, declared; /* the latter: by a macro that has TYPE WORD( in it */
};

static bool is_letter(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Behind the next `mark`, or the end. strstr() under a sanitizer would measure the whole rest. */
static const char *after(const char *at, char mark)
{
    at = strchrnul(at, mark);
    return *at == mark ? at + 1 : at;
}

static const char *after_comment(const char *at)
{
    for (at = after(at, '*'); *at != '/' && *at != '\0';) {
        at = after(at, '*');
    }
    return *at == '/' ? at + 1 : at;
}

static const char *skip_blanks(const char *at)
{
    for (;;) {
        at += strspn(at, " \t\n");
        if (strncmp(at, "/*", 2) == 0) {
            at = after_comment(at + 2);
        } else if (strncmp(at, "//", 2) == 0) {
            at = after(at, '\n');
        } else {
            return at;
        }
    }
}

/* Behind a comment on the same line, and its end. */
static const char *skip_line(const char *at)
{
    at += strspn(at, " ");
    if (strncmp(at, "/*", 2) == 0) {
        at = after_comment(at + 2);
    }
    return at + (*at == '\n');
}

/* A word, a number, or a character. */
static struct piece next_token(const char *at)
{
    struct piece token = {at, at + (*at != '\0')};

    while (is_letter(*at) && is_letter(*token.end)) {
        token.end++;
    }
    return token;
}

static bool is(struct piece a, const char *text)
{
    const size_t length = strlen(text);

    return (size_t)(a.end - a.begin) == length && memcmp(a.begin, text, length) == 0;
}

static int compare(struct piece a, struct piece b)
{
    const ptrdiff_t longer = (a.end - a.begin) - (b.end - b.begin);

    return longer != 0 ? (longer > 0 ? 1 : -1)
                       : memcmp(a.begin, b.begin, (size_t)(a.end - a.begin));
}

static bool same(struct piece a, struct piece b)
{
    return compare(a, b) == 0;
}

/* Lines that end with a backslash go on. */
static void read_directive(struct item *item)
{
    const struct piece kind = next_token(skip_blanks(item->text.begin + 1));
    const char *end = item->text.begin;

    do {
        end = after(end, '\n');
    } while (end[-1] == '\n' && end[-2] == '\\');
    item->text.end = end;
    if (is(kind, "define")) {
        item->name = next_token(skip_blanks(kind.end));
    }
}

/* Up to its semicolon, or the end of a function. Its name is the last word before what comes first
 * of ( [ { = ; it has none where it declares several things at once. */
static void read_declaration(struct item *item)
{
    const char *at = item->text.begin;
    const bool function_like = !is(next_token(at), "struct");
    bool headed = false;
    int depth = 0;

    for (; *at != '\0'; at = skip_blanks(at)) {
        const struct piece token = next_token(at);

        at = token.end;
        if (!headed && strchr("([{=;", *token.begin)) {
            headed = true;
        } else if (!headed && is_letter(*token.begin)) {
            item->name = token;
        } else if (depth == 0 && *token.begin == ',') {
            headed = true;
            item->name = (struct piece){0};
        }
        depth += strchr("([{", *token.begin) ? 1 : strchr(")]}", *token.begin) ? -1 : 0;
        if (depth == 0 && (*token.begin == ';' || (*token.begin == '}' && function_like))) {
            break;
        }
    }
    item->text.end = at;
}

/* A macro that declares something: its name is the macro's. */
static bool read_invocation(struct item *item)
{
    const struct piece name = next_token(item->text.begin);
    const char *at = name.begin;

    while (isupper((unsigned char)*at) || *at == '_') {
        at++;
    }
    if (at != name.end || *at != '(') {
        return false;
    }
    item->name = name;
    item->text.end = after(at, ')');
    return true;
}

static struct items read_items(const char *text)
{
    struct items items = {0};

    while (*skip_blanks(text) != '\0') {
        struct item item = {.whole.begin = text, .text.begin = skip_blanks(text)};

        if (*item.text.begin == '#') {
            read_directive(&item);
        } else if (!read_invocation(&item)) {
            read_declaration(&item);
        }
        text = item.whole.end = *item.text.begin == '#' ? item.text.end : skip_line(item.text.end);
        items.at = memory_one_more(items.at, items.count, sizeof *items.at);
        items.at[items.count++] = item;
    }
    return items;
}

static void add(struct entries *entries, struct piece word, size_t item)
{
    entries->at = memory_one_more(entries->at, entries->count, sizeof *entries->at);
    entries->at[entries->count++] = (struct entry){word, item};
}

static void add_declared(struct items *items, size_t number)
{
    const struct item *item = &items->at[number];
    bool typed = false;

    for (const char *at = item->name.end; at < item->text.end;) {
        const struct piece token = next_token(at);

        if (typed && *token.end == '(') {
            add(&items->declared, token, number);
        }
        typed = is_letter(*token.begin) || (typed && *token.begin == ' ');
        at = token.end;
    }
}

static int by_word(const void *a, const void *b)
{
    const struct entry *x = a, *y = b;
    const int order = compare(x->word, y->word);

    return order != 0 ? order : (x->item > y->item) - (x->item < y->item);
}

static void sort(struct entries *entries)
{
    if (entries->count > 0) {
        qsort(entries->at, entries->count, sizeof *entries->at, by_word);
    }
}

static void index_items(struct items *items)
{
    for (size_t i = 0; i < items->count; i++) {
        if (items->at[i].name.begin) {
            add(&items->names, items->at[i].name, i);
        }
        if (items->at[i].name.begin && *items->at[i].text.begin == '#') {
            add_declared(items, i);
        }
    }
    sort(&items->names);
    sort(&items->declared);
}

/* The first with a word that does not come before this one. */
static const struct entry *find(const struct entries *entries, struct piece word)
{
    size_t first = 0, last = entries->count;

    while (first < last) {
        const size_t middle = (first + last) / 2;

        if (compare(entries->at[middle].word, word) < 0) {
            first = middle + 1;
        } else {
            last = middle;
        }
    }
    return entries->at + first;
}

static bool is_of(const struct entries *entries, const struct entry *entry, struct piece word)
{
    return entry < entries->at + entries->count && same(entry->word, word);
}

static void keep(struct items *items, struct item *item);

static void reach(struct items *items, struct piece word)
{
    const struct entry *entry = find(&items->names, word);
    const bool found = is_of(&items->names, entry, word);

    for (; is_of(&items->names, entry, word); entry++) {
        if (!items->at[entry->item].kept) {
            keep(items, &items->at[entry->item]);
        }
    }
    if (found || *word.end != '(') {
        return;
    }
    for (entry = find(&items->declared, word); is_of(&items->declared, entry, word); entry++) {
        if (!items->at[entry->item].kept) {
            reach(items, items->at[entry->item].name);
        }
    }
}

static void keep(struct items *items, struct item *item)
{
    item->kept = true;
    for (const char *at = item->text.begin; at < item->text.end; at = skip_blanks(at)) {
        const struct piece token = next_token(at);

        at = token.end;
        if (isalpha((unsigned char)*token.begin)) {
            reach(items, token);
        }
    }
}

static bool is_mark(const struct item *item)
{
    return strncmp(item->text.begin, "#line", 5) == 0;
}

/* With its comments, but for licences. No more than one line is blank, and one before comments. */
static void put(FILE *out, const struct item *item)
{
    static const char licence[] = "/* SPDX-License-Identifier: MIT */";
    bool blank = *item->whole.begin == '/';

    for (const char *at = item->whole.begin, *end; at < item->whole.end; at = end) {
        end = memchr(at, '\n', (size_t)(item->whole.end - at));
        end = end ? end + 1 : item->whole.end;
        if (*at == '\n') {
            blank = true;
        } else if (strncmp(at, licence, sizeof licence - 1) != 0) {
            fputs(blank ? "\n" : "", out);
            fwrite(at, 1, (size_t)(end - at), out);
            blank = false;
        }
    }
}

/* --- conditions --- */

enum { DEPTH = 16 };

/* Of #ifdef and #ifndef around a place. */
struct conditions {
    bool active[DEPTH]; /* [0]: always */
    int depth;
};

static bool is_defined(const char *text, const char *until, struct piece name)
{
    static const char define[] = "#define ";
    const size_t length = sizeof define - 1;

    for (const char *at = text; (at = memmem(at, (size_t)(until - at), define, length));) {
        at += length;
        if (same(next_token(at), name)) {
            return true;
        }
    }
    return false;
}

/* False: the line is no condition. */
static bool read_condition(struct conditions *c, const char *text, const char *until,
                           const char *line)
{
    const struct piece kind = next_token(line + 1);
    const bool outer = c->active[c->depth];

    if (*line != '#') {
        return false;
    }
    if (is(kind, "ifdef") || is(kind, "ifndef")) {
        const bool defined = is_defined(text, until, next_token(skip_blanks(kind.end)));
        c->active[++c->depth] = outer && defined == is(kind, "ifdef");
    } else if (is(kind, "else")) {
        c->active[c->depth] = c->active[c->depth - 1] && !outer;
    } else if (is(kind, "endif")) {
        c->depth--;
    } else {
        return false;
    }
    return true;
}

/* Leaves out lines that a compiler would skip. */
static void drop_inactive(char *text)
{
    struct conditions c = {.active = {true}};
    char *to = text;

    for (const char *line = text; *line != '\0';) {
        const char *end = after(line, '\n');
        const size_t length = (size_t)(end - line);

        if (!read_condition(&c, text, to, line) && c.active[c.depth]) {
            memmove(to, line, length);
            to += length;
        }
        line = end;
    }
    *to = '\0';
}

void glsl_write_reached(FILE *out, char *text)
{
    drop_inactive(text);

    struct items items = read_items(text);

    index_items(&items);
    for (size_t i = 0; i < items.count; i++) {
        struct item *item = &items.at[i];

        if (!item->kept && !is_mark(item) && (!item->name.begin || is(item->name, "main"))) {
            keep(&items, item);
        }
    }
    for (size_t i = 0; i < items.count; i++) {
        if (items.at[i].kept) {
            put(out, &items.at[i]);
        }
    }
    free(items.names.at);
    free(items.declared.at);
    free(items.at);
}
