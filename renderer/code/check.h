/* SPDX-License-Identifier: MIT */
/* What a tree means: names and types resolved, implicit conversions written out as constructors,
 * constants computed, loops counted, and everything refused that no driver should see. */
#ifndef RENDERER_CODE_CHECK_H
#define RENDERER_CODE_CHECK_H

#include "machine.h"

/* The whole tree, and tree->entry. False: the tree's error says why. */
bool check_tree(struct tree *tree, const struct code_source *source);

/* --- between the files of check --- */

struct checker {
    struct tree *tree;
    struct function *function;                     /* that is being checked; NULL: none */
    struct variable *scopes[LIMIT_CODE_DEPTH + 4]; /* variables of each open scope, newest first */
    int scope;
    int loops; /* around the statement */
    struct machine_code scratch;
};

#define CHECK_FAIL(checker, at, ...) tree_fail((checker)->tree, at, __VA_ARGS__)

/* Sets type, value and effects of the expression and of what is in it. */
bool check_value(struct checker *checker, struct expr *expr);
/* Converts to a type where that goes without saying: int to float, one number to a vector. False
 * and no error: it does not. */
bool check_convert(struct checker *checker, struct expr **expr, struct type to);
/* The same, with an error, "float x cannot be made of vec3", where it does not. */
bool check_fit(struct checker *checker, struct expr **expr, struct type to, const char *what);
/* Computes the value of an expression whose parts are constants. */
bool check_fold(struct checker *checker, struct expr *expr);
bool check_call(struct checker *checker, struct expr *expr);
bool check_construct(struct checker *checker, struct expr *expr);
/* a op b, whose types are known. `keep`: the result must have the type of a. */
bool check_operator(struct checker *checker, struct expr *expr, bool keep);
/* Whether no part of it, whose parts have been checked, assigns to what another part uses. */
bool check_order(struct checker *checker, const struct expr *expr);
/* Whether it can be assigned to. */
bool check_place(struct checker *checker, const struct expr *expr);
/* {a, b} or [] take their type from what they are for. */
bool check_list(struct checker *checker, struct expr *list, struct type *type, bool unsized);
/* A length: a constant from 1 to LIMIT_CODE_ARRAY. */
bool check_length(struct checker *checker, struct expr *length, uint8_t *out);
bool check_for(struct checker *checker, struct stmt *stmt);
bool check_statement(struct checker *checker, struct stmt *stmt);
bool check_declare(struct checker *checker, struct variable *variable);
void check_open(struct checker *checker);
void check_close(struct checker *checker);
/* That no function calls itself, and none is larger than the limits, once all have been checked. */
bool check_bounds(struct tree *tree);
/* Marks what is reachable from the entry. */
void check_reach(struct function *entry);

#endif
