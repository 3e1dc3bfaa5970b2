/* SPDX-License-Identifier: MIT */
/* Declarations, statements, functions, and the entry. */
#include "check.h"

#include <stdio.h>
#include <string.h>

/* --- scopes --- */

void check_open(struct checker *checker)
{
    checker->scopes[++checker->scope] = NULL;
}

void check_close(struct checker *checker)
{
    for (struct variable *v = checker->scopes[checker->scope]; v; v = v->next_in_scope) {
        v->name->variable = v->hidden;
    }
    checker->scope--;
}

bool check_declare(struct checker *checker, struct variable *variable)
{
    struct name *name = variable->name;
    struct variable *old = name->variable;

    if (old && old->scope == checker->scope) {
        return old->storage == STORAGE_DECLARED
                   ? CHECK_FAIL(checker, variable->at,
                                "%.40s is a parameter, which has its value from outside",
                                name->text)
                   : CHECK_FAIL(checker, variable->at, "%.40s is declared in line %d already",
                                name->text, old->at.line);
    }
    variable->hidden = old;
    variable->scope = checker->scope;
    variable->next_in_scope = checker->scopes[checker->scope];
    checker->scopes[checker->scope] = variable;
    name->variable = variable;
    return true;
}

/* --- declarations --- */

static bool check_type(struct checker *checker, struct variable *variable)
{
    char name[TYPE_NAME_BYTES];
    const bool parameter = variable->storage == STORAGE_PARAMETER;

    if (variable->type.base == BASE_VOID || (type_is_handle(variable->type) && !parameter)) {
        return CHECK_FAIL(checker, variable->at, "%s cannot be the type of a %s",
                          type_name(variable->type, name), parameter ? "parameter" : "variable");
    }
    if ((type_is_handle(variable->type) || type_is_surface(variable->type)) &&
        (variable->length || variable->unsized)) {
        return CHECK_FAIL(checker, variable->at, "there are no arrays of %s",
                          type_name(variable->type, name));
    }
    return !variable->length || check_length(checker, variable->length, &variable->type.count);
}

static bool check_initial(struct checker *checker, struct stmt *stmt)
{
    struct variable *variable = stmt->variable;
    struct type element = variable->type;
    char what[60];

    if (stmt->expr->list) {
        if (!check_list(checker, stmt->expr, &element, variable->unsized)) {
            return false;
        }
        variable->type = element;
    } else if (!check_value(checker, stmt->expr)) {
        return false;
    }
    if (variable->unsized) {
        variable->type.count = stmt->expr->type.count;
    }
    snprintf(what, sizeof what, "%.40s", variable->name->text);
    if (stmt->expr->type.base == BASE_VOID || type_is_handle(stmt->expr->type)) {
        return CHECK_FAIL(checker, stmt->expr->at, "this is no value for %s", what);
    }
    return check_fit(checker, &stmt->expr, variable->type, what);
}

static bool check_local(struct checker *checker, struct stmt *stmt)
{
    struct variable *variable = stmt->variable;

    if (!check_type(checker, variable) || (stmt->expr && !check_initial(checker, stmt))) {
        return false;
    }
    if (!stmt->expr && (variable->read_only || variable->unsized)) {
        return CHECK_FAIL(checker, variable->at, "%.40s has no value", variable->name->text);
    }
    if (variable->read_only) {
        variable->value = stmt->expr->value;
    }
    return check_declare(checker, variable);
}

/* `float3 _Color1;` says again what the document declares. */
static bool check_again(struct checker *checker, const struct variable *variable)
{
    const struct variable *declared = variable->name->variable;
    char own[TYPE_NAME_BYTES], given[TYPE_NAME_BYTES];

    if (!declared || declared->storage != STORAGE_DECLARED) {
        return CHECK_FAIL(checker, variable->at,
                          "%.40s has no value: it is neither a constant nor a declared parameter",
                          variable->name->text);
    }
    if (!type_equal(variable->type, declared->type)) {
        return CHECK_FAIL(checker, variable->at, "%.40s is declared as %s, not %s",
                          variable->name->text, type_name(declared->type, own),
                          type_name(variable->type, given));
    }
    return true;
}

static bool check_global(struct checker *checker, struct stmt *stmt)
{
    struct variable *variable = stmt->variable;

    variable->storage = STORAGE_GLOBAL;
    if (!check_type(checker, variable)) {
        return false;
    }
    if (!stmt->expr) {
        return check_again(checker, variable);
    }
    if (!check_initial(checker, stmt)) {
        return false;
    }
    if (!stmt->expr->value) {
        return CHECK_FAIL(checker, stmt->expr->at,
                          "%.40s stands outside of functions, so its value must be constant",
                          variable->name->text);
    }
    variable->read_only = true;
    variable->value = stmt->expr->value;
    return check_declare(checker, variable);
}

/* --- statements --- */

static bool check_return(struct checker *checker, struct stmt *stmt)
{
    const struct function *function = checker->function;
    char name[TYPE_NAME_BYTES];
    const bool nothing = function->result.base == BASE_VOID;

    if (!stmt->expr) {
        return nothing || CHECK_FAIL(checker, stmt->at, "%.40s returns %s, not nothing",
                                     function->name->text, type_name(function->result, name));
    }
    if (nothing) {
        return CHECK_FAIL(checker, stmt->expr->at, "%.40s is void, so it returns no value",
                          function->name->text);
    }
    return check_value(checker, stmt->expr) &&
           check_fit(checker, &stmt->expr, function->result, "the value returned");
}

static bool check_if(struct checker *checker, struct stmt *stmt)
{
    char name[TYPE_NAME_BYTES];

    if (!check_value(checker, stmt->expr)) {
        return false;
    }
    if (!type_is(stmt->expr->type, BASE_BOOL)) {
        return CHECK_FAIL(checker, stmt->expr->at, "the condition is %s, not bool",
                          type_name(stmt->expr->type, name));
    }
    check_open(checker);
    bool ok = check_statement(checker, stmt->body);
    check_close(checker);
    check_open(checker);
    ok = ok && (!stmt->other || check_statement(checker, stmt->other));
    check_close(checker);
    return ok;
}

static bool check_statements(struct checker *checker, struct stmt *list)
{
    for (; list; list = list->next) {
        if (!check_statement(checker, list)) {
            return false;
        }
    }
    return true;
}

bool check_statement(struct checker *checker, struct stmt *stmt)
{
    bool ok = true;

    switch (stmt->kind) {
    case STMT_BLOCK:
        check_open(checker);
        ok = check_statements(checker, stmt->body);
        check_close(checker);
        return ok;
    case STMT_DECLARE:
        return stmt->variable ? check_local(checker, stmt) : check_statements(checker, stmt->body);
    case STMT_EXPR:
        return check_value(checker, stmt->expr);
    case STMT_IF:
        return check_if(checker, stmt);
    case STMT_FOR:
        check_open(checker);
        ok = check_for(checker, stmt);
        check_close(checker);
        return ok;
    case STMT_RETURN:
        return check_return(checker, stmt);
    case STMT_BREAK:
    case STMT_CONTINUE:
        return checker->loops > 0 || CHECK_FAIL(checker, stmt->at, "%s stands in no loop",
                                                stmt->kind == STMT_BREAK ? "break" : "continue");
    default:
        return true;
    }
}

/* Whether every way through ends with a return. */
static bool returns(const struct stmt *stmt)
{
    if (stmt->kind == STMT_BLOCK) {
        for (const struct stmt *s = stmt->body; s; s = s->next) {
            if (returns(s)) {
                return true;
            }
        }
    }
    return stmt->kind == STMT_RETURN ||
           (stmt->kind == STMT_IF && stmt->other && returns(stmt->body) && returns(stmt->other));
}

/* --- functions --- */

static bool same_parameters(const struct function *a, const struct function *b)
{
    const struct variable *p = a->parameters, *q = b->parameters;

    for (; p && q; p = p->next, q = q->next) {
        if (!type_equal(p->type, q->type)) {
            return false;
        }
    }
    return !p && !q;
}

static bool check_parameters(struct checker *checker, struct function *function)
{
    if (function->parameter_count > TREE_PARAMETERS) {
        return tree_fail_limit(checker->tree, function->at, "parameters of a function",
                               TREE_PARAMETERS, "pass vectors or arrays");
    }
    for (struct variable *p = function->parameters; p; p = p->next) {
        if (!check_type(checker, p)) {
            return false;
        }
        if (p->unsized) {
            return CHECK_FAIL(checker, p->at, "the array has no length");
        }
        if (p->direction != DIRECTION_IN && type_is_handle(p->type)) {
            return CHECK_FAIL(checker, p->at, "this parameter can only be read");
        }
        if (p->direction != DIRECTION_IN && p->read_only) {
            return CHECK_FAIL(checker, p->at, "an out parameter cannot be const");
        }
    }
    return !type_is_handle(function->result) ||
           CHECK_FAIL(checker, function->at, "a function cannot return this type");
}

/* The one of this name and these parameters: a declaration and a definition are one function. */
static struct function *find_or_add(struct checker *checker, struct function *function)
{
    struct name *name = function->name;
    struct tree *tree = checker->tree;

    for (struct function *f = name->functions; f; f = f->overload) {
        if (same_parameters(f, function)) {
            return f;
        }
    }
    function->overload = name->functions;
    name->functions = function;
    function->number = tree->function_count++;
    *tree->last_function = function;
    tree->last_function = &function->next;
    return function;
}

static bool merge(struct checker *checker, struct function *old, struct function *now)
{
    if (old->body && now->body) {
        return CHECK_FAIL(checker, now->at, "%.40s is defined in line %d already", now->name->text,
                          old->at.line);
    }
    const struct variable *p = old->parameters, *q = now->parameters;
    bool same = type_equal(old->result, now->result);
    for (; p; p = p->next, q = q->next) {
        same = same && p->direction == q->direction;
    }
    if (!same) {
        return CHECK_FAIL(checker, now->at, "%.40s is declared in another way in line %d",
                          now->name->text, old->at.line);
    }
    if (now->body) {
        old->body = now->body;
        old->parameters = now->parameters;
        old->at = now->at;
    }
    return true;
}

static bool check_body(struct checker *checker, struct function *function)
{
    bool ok = true;

    checker->function = function;
    check_open(checker);
    for (struct variable *p = function->parameters; p && ok; p = p->next) {
        ok = !p->name || check_declare(checker, p);
    }
    /* The body shares the scope of the parameters. */
    ok = ok && check_statements(checker, function->body->body);
    check_close(checker);
    checker->function = NULL;
    if (ok && function->result.base != BASE_VOID && !returns(function->body)) {
        return CHECK_FAIL(checker, function->at, "%.40s can end without a return",
                          function->name->text);
    }
    return ok;
}

static bool check_function(struct checker *checker, struct stmt *stmt)
{
    struct function *function = stmt->function;

    if (!check_parameters(checker, function)) {
        return false;
    }
    struct function *known = find_or_add(checker, function);
    if (known != function && !merge(checker, known, function)) {
        return false;
    }
    return !function->body || check_body(checker, known);
}

static bool check_top(struct checker *checker)
{
    for (struct stmt *stmt = checker->tree->top; stmt; stmt = stmt->next) {
        if (stmt->kind == STMT_FUNCTION && !check_function(checker, stmt)) {
            return false;
        }
        for (struct stmt *one = stmt->body; one && stmt->kind == STMT_DECLARE; one = one->next) {
            if (!check_global(checker, one)) {
                return false;
            }
        }
    }
    return true;
}

/* --- what is around the code --- */

static bool declare_parameters(struct checker *checker, const struct param *params)
{
    static const struct type types[] = {
        [PARAM_FLOAT] = {BASE_FLOAT, 1, 1, 0}, [PARAM_INT] = {BASE_INT, 1, 1, 0},
        [PARAM_BOOL] = {BASE_BOOL, 1, 1, 0},   [PARAM_VEC2] = {BASE_FLOAT, 2, 1, 0},
        [PARAM_VEC3] = {BASE_FLOAT, 3, 1, 0},  [PARAM_VEC4] = {BASE_FLOAT, 4, 1, 0},
        [PARAM_IVEC2] = {BASE_INT, 2, 1, 0},   [PARAM_IVEC3] = {BASE_INT, 3, 1, 0},
        [PARAM_IVEC4] = {BASE_INT, 4, 1, 0},   [PARAM_COLOR] = {BASE_FLOAT, 3, 1, 0},
    };

    enum { DATA_MIN = 8 };
    struct tree *tree = checker->tree;
    for (; params && params->name; params++) {
        struct name *name = tree_name(tree, params->name, (int)strlen(params->name));
        struct variable *variable =
            tree_variable(tree, name, types[params->type], (struct at){0, 0});
        variable->storage = STORAGE_DECLARED;
        variable->first = tree->number_count;
        tree->number_count += type_components(variable->type);
        *tree->last_declared = variable;
        tree->last_declared = &variable->next;
        if (!check_declare(checker, variable)) {
            return false;
        }
    }
    tree->data_count = tree->number_count > DATA_MIN ? tree->number_count : DATA_MIN;
    return true;
}

static bool is_entry(const struct function *f, enum code_use use)
{
    const struct variable *p = f->parameters, *q = p ? p->next : NULL;

    for (const struct variable *v = p; v; v = v->next) {
        if (v->direction != DIRECTION_IN) {
            return false;
        }
    }
    if (use == CODE_SHADE) {
        const bool color =
            f->result.base == BASE_FLOAT && f->result.rows >= 3 && f->result.columns == 1;
        return (color || type_is_surface(f->result)) && strcmp(f->name->text, "shade") == 0 &&
               (!p || (p->type.base == BASE_FRAGMENT && !q));
    }
    return type_is(f->result, BASE_FLOAT) && p && type_equal(p->type, type_vector(BASE_FLOAT, 3)) &&
           (!q || (q->type.base == BASE_PRIMITIVE && !q->next));
}

/* The one with the wrong signature that was probably meant. */
static const struct function *find_meant(const struct tree *tree, enum code_use use)
{
    const char *name = use == CODE_SHADE ? "shade" : "sdf";

    for (const struct function *f = tree->functions; f; f = f->next) {
        if (strcmp(f->name->text, name) == 0) {
            return f;
        }
    }
    return NULL;
}

static bool find_entry(struct checker *checker, enum code_use use)
{
    struct tree *tree = checker->tree;
    bool named = false;
    const char *form =
        use == CODE_SHADE ? "vec3 shade(FragmentProperties properties)" : "float sdf(vec3 p)";
    const struct function *meant = find_meant(tree, use);

    for (struct function *f = tree->functions; f; f = f->next) {
        const bool sdf = strcmp(f->name->text, "sdf") == 0;
        if (is_entry(f, use) && f->body && (!named || sdf)) {
            tree->entry = f;
            named = sdf;
        }
    }
    if (meant && (!tree->entry || (use == CODE_DISTANCE && !named))) {
        return CHECK_FAIL(checker, meant->at, "%s does not have the form %s", meant->name->text,
                          form);
    }
    return tree->entry || CHECK_FAIL(checker, ((struct at){1, 1}), "there is no function %s", form);
}

bool check_tree(struct tree *tree, const struct code_source *source)
{
    struct checker checker = {.tree = tree};
    const bool ok = declare_parameters(&checker, source->params) && check_top(&checker) &&
                    check_bounds(tree) && find_entry(&checker, source->use);

    if (ok) {
        check_reach(tree->entry);
    }
    machine_code_finish(&checker.scratch);
    return ok;
}
