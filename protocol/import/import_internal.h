/* SPDX-License-Identifier: MIT */
/* Declarations that the files of this folder share; no other file includes them. */
#ifndef PROTOCOL_IMPORT_INTERNAL_H
#define PROTOCOL_IMPORT_INTERNAL_H

#include "import.h"
#include "protocol/limits.h"
#include "text.h"

enum { IMPORT_DATA_MAX = 8 }; /* numbers in the buffer of a primitive */

enum import_role {
    IMPORT_SCENE,
    IMPORT_MODEL,
    IMPORT_MATERIAL,
    IMPORT_SHADER,
    IMPORT_PRIMITIVE,
    IMPORT_ROLES
};

/* One file. */
struct import_item {
    const char *path;
    enum import_role role;
    struct import_value *value;
    char *stem;       /* of the file's name */
    const char *name; /* that it gives itself; "": none */
    char id[LIMIT_ID_BYTES + 1];
    const char **materials; /* of a scene or model: ids in order */
    size_t material_count;
    int numbers; /* of a primitive: how many of `data` it reads or is given */
};

/* What others may call a file by. */
struct import_name {
    enum import_role role;
    const char *text;
    int rank; /* 2: the one that others of its role are called by; 1: the other one */
    struct import_item *item;
};

/* Where something of the document comes from. */
struct import_mark {
    char place[LIMIT_ID_BYTES * 2 + 32]; /* "/nodes/sphere-1" */
    const struct import_item *item;
    int line, column;
};

struct importing {
    struct import_item *items;
    size_t count;
    struct import_name *names; /* sorted; two of each item */
    struct import_mark *marks;
    size_t mark_count, mark_room;
    size_t *numbers; /* by the index of the node type: the last given to a node */
    size_t nodes;    /* of the document so far */
    struct error *err;
};

/* --- files.c --- */

/* Reads, recognises and names all files. */
bool import_read_files(struct importing *importing, const struct import_source *source,
                       cJSON *notes);
void import_finish_files(struct importing *importing);
/* The member of a document that holds what such files are; NULL: none. */
const char *import_role_list(enum import_role role);

/* Fills importing->err with the place of `value`; false. */
bool import_fail(const struct importing *importing, const struct import_item *item,
                 const struct import_value *value, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The same of more `what` than may be. */
bool import_fail_limit(const struct importing *importing, const struct import_item *item,
                       const struct import_value *value, size_t count, const char *what,
                       size_t most);
/* Refuses members that are not among `names`. */
bool import_check_members(const struct importing *importing, const struct import_item *item,
                          const struct import_value *object, const char *const *names);
/* The member in `*out`, NULL where it is absent; false where it is of another kind. */
bool import_take(const struct importing *importing, const struct import_item *item,
                 const struct import_value *object, const char *name, enum import_kind kind,
                 const struct import_value **out);
/* The file that `name` means, said at `value`; NULL and err: none, or several. */
struct import_item *import_find(const struct importing *importing, const struct import_item *item,
                                const struct import_value *value, enum import_role role,
                                const char *name);
void import_mark(struct importing *importing, const char *list, const char *name,
                 const struct import_item *item, const struct import_value *value);

/* Whether any file has this name. */
bool import_has(const struct importing *importing, enum import_role role, const char *name);

/* --- built_in.c --- */

struct import_built_in {
    const struct node_type *type;
    const struct import_own *own; /* NULL: named and given as in the registry */
};

/* What "Primitives/Torus" means; false: nothing that is built in, or a file has the name. */
bool import_find_built_in(const struct importing *importing, const char *name,
                          struct import_built_in *out);
/* Says that there is no such type, and what was probably meant; false. */
bool import_fail_type(const struct importing *importing, const struct import_item *item,
                      const struct import_value *type);
/* The node's `params` out of its data; `name` is what messages call it. */
bool import_add_data(const struct importing *importing, const struct import_item *item,
                     const struct import_built_in *built_in, const char *name,
                     const struct import_value *list, cJSON *node);

/* --- nodes.c --- */

/* What stands behind "GROUP/"; NULL: another group. */
const char *import_name_in(const char *type, const char *group);
/* At most `most` numbers of a list. */
bool import_read_data(const struct importing *importing, const struct import_item *item,
                      const struct import_value *list, size_t most, double *out);

/* A node of the document with all below it; NULL and err on failure. */
cJSON *import_node(struct importing *importing, const struct import_item *item,
                   const struct import_value *value);
/* {id, type}; `value` is where it comes from. NULL and err where these are too many nodes. */
cJSON *import_bare_node(struct importing *importing, const char *type,
                        const struct import_item *item, const struct import_value *value);
/* Finds how many numbers of its `data` each primitive is given. */
bool import_count_data(struct importing *importing);

/* --- resources.c: members of the document's objects --- */

cJSON *import_primitive(struct importing *importing, const struct import_item *item);
cJSON *import_shader(struct importing *importing, const struct import_item *item);
cJSON *import_material(struct importing *importing, const struct import_item *item);
/* How many numbers of `data` the code of a primitive reads. */
int import_data_read(const char *code);

/* --- frame.c --- */

/* Puts the children of the root side by side. */
void import_lay_out(struct scene *scene);
/* Points the camera at all of the scene. */
void import_frame(struct scene *scene);

#endif
