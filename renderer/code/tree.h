/* SPDX-License-Identifier: MIT */
/* Users' code as a tree: what parser.h reads, check.h fills in, lower.h and writer.h read.
 *
 * All of it lies in the tree's arena. No path down an expression is longer than TREE_DEPTH, no path
 * down statements longer than LIMIT_CODE_DEPTH, so that functions over it may recurse. */
#ifndef RENDERER_CODE_TREE_H
#define RENDERER_CODE_TREE_H

#include <stdint.h>

#include "lexer.h"
#include "protocol/limits.h"

enum { TREE_DEPTH = 4 * LIMIT_CODE_DEPTH, TREE_PARAMETERS = 16 /* of one function */ };

/* X(NAME, "text") */
#define TREE_OPS(X)                                                                                \
    X(NONE, "")                                                                                    \
    X(ADD, "+")                                                                                    \
    X(SUBTRACT, "-")                                                                               \
    X(MULTIPLY, "*")                                                                               \
    X(DIVIDE, "/")                                                                                 \
    X(REMAINDER, "%")                                                                              \
    X(SHIFT_LEFT, "<<")                                                                            \
    X(SHIFT_RIGHT, ">>")                                                                           \
    X(BIT_AND, "&")                                                                                \
    X(BIT_OR, "|")                                                                                 \
    X(BIT_XOR, "^")                                                                                \
    X(LESS, "<")                                                                                   \
    X(GREATER, ">")                                                                                \
    X(LESS_EQUAL, "<=")                                                                            \
    X(GREATER_EQUAL, ">=")                                                                         \
    X(EQUAL, "==")                                                                                 \
    X(UNEQUAL, "!=")                                                                               \
    X(AND, "&&")                                                                                   \
    X(OR, "||")                                                                                    \
    X(XOR, "^^")                                                                                   \
    X(PLUS, "+")                                                                                   \
    X(MINUS, "-")                                                                                  \
    X(NOT, "!")                                                                                    \
    X(INVERT, "~")

enum op {
#define X(NAME, text) OP_##NAME,
    TREE_OPS(X)
#undef X
};

/* A word that the author made up; the same word is the same struct. */
struct name {
    const char *text;
    struct name *next;          /* in its bucket */
    struct variable *variable;  /* that it means now, while checking */
    struct function *functions; /* all of this name, the newest first */
};

enum storage {
    STORAGE_LOCAL,
    STORAGE_PARAMETER,
    STORAGE_GLOBAL,   /* a constant */
    STORAGE_DECLARED, /* a parameter of the document */
    STORAGE_UNIFORM,  /* of a block or a texture; only in the whole language */
};

enum direction { DIRECTION_IN, DIRECTION_OUT, DIRECTION_INOUT };

struct variable {
    struct name *name; /* NULL: a parameter without one */
    struct at at;
    struct type type;
    enum storage storage;
    enum direction direction;
    bool read_only, counter; /* const; the variable of a for */
    bool used;
    struct expr *length; /* of an array, until it is checked */
    bool unsized;        /* an array whose length comes from its initial value */
    const double *value; /* of a constant */
    int number;          /* distinct in its tree; of a declared parameter, its place among them */
    int first;           /* STORAGE_DECLARED: its first number */
    uint16_t at_frame;   /* lower.h: where it lies in the frame, */
    bool placed;         /* if it has a place yet */
    bool varying;        /* renderer/spmd: its lanes may differ */
    int scope;           /* how deep the scope is that it was declared in */
    struct variable *hidden;        /* what its name meant before */
    struct variable *next;          /* among parameters */
    struct variable *next_in_scope; /* what was declared before it */
};

enum expr_kind {
    EXPR_LITERAL,
    EXPR_VARIABLE,
    EXPR_UNARY,     /* op a */
    EXPR_STEP,      /* ++a, a--: op is ADD or SUBTRACT */
    EXPR_BINARY,    /* a op b */
    EXPR_ASSIGN,    /* a = b, or a op= b */
    EXPR_CHOICE,    /* a ? b : c */
    EXPR_COMMA,     /* a, b */
    EXPR_CALL,      /* name(args): of a function of the author's, once checked */
    EXPR_BUILTIN,   /* of one of builtins.h */
    EXPR_CONSTRUCT, /* type(args) */
    EXPR_INDEX,     /* a[b] */
    EXPR_MEMBER,    /* a.name; of vectors, once checked: */
    EXPR_SWIZZLE,   /* the components `swizzle` of a */
    EXPR_FIELD,     /* member `field` of FragmentProperties */
    EXPR_PART,      /* member `field` of a, a Surface */
    EXPR_DATA,      /* primitive.data */
};

struct expr {
    enum expr_kind kind;
    enum op op;
    struct at at; /* of the operator, of the name, of the first token */
    struct type type;
    bool effects;  /* assigns to something */
    bool varying;  /* renderer/spmd: its lanes may differ */
    bool postfix;  /* EXPR_STEP */
    bool list;     /* EXPR_CONSTRUCT: {a, b}, whose type comes from what it initialises */
    bool array;    /* EXPR_CONSTRUCT: type[a](args), or type[](args) */
    uint8_t depth; /* of the longest path down, at most TREE_DEPTH - 1 */
    uint8_t field;
    uint8_t swizzle[4], swizzle_count;
    const double *value; /* of a constant: all components */
    struct expr *a, *b, *c;
    struct expr *args, *next; /* arguments, a list */
    int arg_count;
    struct name *name;
    struct variable *variable;
    struct function *function;
    const struct builtin *builtin;
};

enum stmt_kind {
    STMT_EMPTY,
    STMT_BLOCK,   /* body: a list */
    STMT_DECLARE, /* variable, perhaps expr; several variables: a list in `body` */
    STMT_EXPR,
    STMT_IF,  /* expr, body, perhaps other */
    STMT_FOR, /* variable = start + i step, i = 0 ... trips - 1 */
    STMT_RETURN,
    STMT_BREAK,
    STMT_CONTINUE,
    STMT_FUNCTION, /* at the top alone */
};

struct stmt {
    enum stmt_kind kind;
    struct at at;
    struct stmt *next; /* in its list */
    struct variable *variable;
    struct expr *expr;         /* condition, value or initial value */
    struct stmt *body, *other; /* of a for: `other` declares the variable */
    struct expr *advance;      /* of a for */
    int trips;
    double start, step;
    struct function *function;
    /* renderer/spmd: of if and for, lanes take it differently; of what leaves, not all lanes do. */
    bool varying;
    int scope;       /* renderer/spmd: of what is inside of a for, an if, */
    int other_scope; /* of an else */
};

struct call {
    struct function *to;
    struct call *next;
};

struct function {
    struct name *name;
    struct at at;
    struct type result;
    struct variable *parameters; /* a list */
    int parameter_count;
    struct stmt *body;         /* NULL: declared, not defined */
    struct function *overload; /* the next of this name */
    struct function *next;     /* in the order of the text */
    int number;
    /* limits.h: */
    enum { FUNCTION_NEW, FUNCTION_OPEN, FUNCTION_DONE } state;
    struct function *caller; /* while open */
    long size, work; /* operations with calls written out; the same, as often as loops run them */
    long trips;      /* iterations of all loops */
    long bytes;      /* of arrays */
    int height;      /* of the calls below it */
    struct call *calls;           /* what it calls, once for each call */
    bool reachable;               /* from the entry */
    struct function *next_called; /* in tree->called */
    /* lower.h: */
    uint16_t result_at, entry; /* in the frame; the first step */
    bool varying;              /* renderer/spmd: its result's lanes may differ */
    bool leaves;               /* renderer/spmd: some lanes return before others */
    int scope;                 /* renderer/spmd: of the body */
};

/* A struct of the whole language. */
struct tree_struct {
    struct name *name;
    struct variable *members; /* a list */
};

enum { TREE_STRUCTS = 64 };

struct tree_chunk;

struct tree {
    struct tree_chunk *chunks;
    struct name *names[256];
    struct stmt *top; /* functions and constants, in the order of the text */
    struct function *functions, **last_function; /* in the order of the text */
    struct function *called, **last_called;      /* those before others that call them */
    struct variable *declared, **last_declared;  /* parameters of the document */
    int variable_count, function_count;
    int number_count; /* of the declared parameters */
    int data_count;   /* elements of primitive.data */
    bool data_used, shading_used;
    bool transmissive; /* it says how much light a surface lets through */
    /* GLSL as we write it ourselves, not users' code: with structs, blocks, while and variables
     * outside of functions. parser_whole.c reads what is more; check.h knows nothing of it. */
    bool whole;
    bool ours; /* as in struct code_source */
    struct tree_struct structs[TREE_STRUCTS];
    int struct_count;
    struct function *entry;
    struct error *err;
};

void tree_init(struct tree *tree, struct error *err);
void tree_finish(struct tree *tree);
void *tree_alloc(struct tree *tree, size_t size); /* zeroed */
struct name *tree_name(struct tree *tree, const char *text, int length);
struct expr *tree_expr(struct tree *tree, enum expr_kind kind, struct at at);
struct variable *tree_variable(struct tree *tree, struct name *name, struct type type,
                               struct at at);
const char *tree_op_text(enum op op);

/* Sets the tree's error to ERROR_COMPILE at this place of the text; false. */
bool tree_fail(struct tree *tree, struct at at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* ERROR_LIMIT: "... above the maximum N (code_depth)". */
bool tree_fail_limit(struct tree *tree, struct at at, const char *what, long limit,
                     const char *name);

#endif
