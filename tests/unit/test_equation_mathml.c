/* SPDX-License-Identifier: MIT */
/* Equations as MathML: well-formed, of known elements with as many children as each takes, and set
 * as mathematics is. Cases are compared in one line: a^{2}, {x}/{y}, a_{1}, √{x}, 3√{x}; what is
 * invisible is nothing, and ' is a place where a line may be broken. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/equation_mathml.h"
#include "protocol/typeset.h"
#include "tests/support/random_scene.h"

static const char *const letters[] = {"a", "b", "c", "d", NULL};

/* --- MathML in one line --- */

enum { ATTRIBUTE_BYTES = 128 };

static const struct element {
    const char *name;
    int children;         /* -1: any number */
    const char *parts[3]; /* what stands before, between and behind its children */
} elements[] = {
    {"math", -1, {"", "'", ""}},     {"mrow", -1, {"", "", ""}},   {"mfrac", 2, {"{", "}/{", "}"}},
    {"msup", 2, {"", "^{", "}"}},    {"msub", 2, {"", "_{", "}"}}, {"msqrt", -1, {"√{", "", "}"}},
    {"mroot", 2, {"{", "}√{", "}"}}, {"mspace", 0, {" ", "", ""}}, {"mi", 0, {"", "", ""}},
    {"mn", 0, {"", "", ""}},         {"mo", 0, {"", "", ""}},
};

static bool take(const char **at, const char *text)
{
    const size_t length = strlen(text);
    const bool found = strncmp(*at, text, length) == 0;

    *at += found ? length : 0;
    return found;
}

static void need(const char **at, const char *text, const char *whole)
{
    if (!take(at, text)) {
        fail_msg("expected %s at %.60s\n%s", text, *at, whole);
    }
}

static const struct element *read_tag(const char **at, const char *whole, bool *out_empty)
{
    char name[16], attribute[ATTRIBUTE_BYTES];
    int used = 0;

    if (sscanf(*at, "<%15[a-z]%n", name, &used) != 1) {
        fail_msg("expected an element at %.60s\n%s", *at, whole);
    }
    *at += used;
    while (sscanf(*at, " %127[a-z]%n", attribute, &used) == 1) {
        *at += used;
        if (sscanf(*at, "=\"%127[^\"<&]\"%n", attribute, &used) != 1) {
            fail_msg("an attribute without a value at %.60s\n%s", *at, whole);
        }
        *at += used;
    }
    *out_empty = take(at, "/");
    need(at, ">", whole);
    for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++) {
        if (strcmp(elements[i].name, name) == 0) {
            return &elements[i];
        }
    }
    fail_msg("element %s\n%s", name, whole);
    return NULL;
}

static void put_characters(const char **at, FILE *out)
{
    static const char *const shown[][2] = {
        {"&lt;", "<"}, {"&gt;", ">"}, {"\u2062", ""}, {"\u2061", ""}, {"\u2212", "-"}};

    while (**at != '<') {
        size_t i = 0;
        while (i < sizeof shown / sizeof *shown && !take(at, shown[i][0])) {
            i++;
        }
        if (i < sizeof shown / sizeof *shown) {
            fputs(shown[i][1], out);
        } else {
            assert_true(**at && **at != '&' && **at != '>');
            fputc(*(*at)++, out);
        }
    }
}

static void put_element(const char **at, const char *whole, FILE *out)
{
    bool empty = false;
    char end[24];
    const struct element *element = read_tag(at, whole, &empty);

    fputs(element->parts[0], out);
    int children = 0;
    snprintf(end, sizeof end, "</%s>", element->name);
    while (!empty && !take(at, end)) {
        if (element->children == 0) {
            assert_true(**at != '<');
            put_characters(at, out);
            continue;
        }
        fputs(children > 0 ? element->parts[1] : "", out);
        put_element(at, whole, out);
        children++;
    }
    if (element->children > 0) {
        assert_int_equal(children, element->children);
    }
    fputs(element->parts[2], out);
}

/* The caller frees it. */
static char *in_one_line(const char *mathml)
{
    char *line = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&line, &length);
    const char *at = mathml;

    put_element(&at, mathml, out);
    assert_string_equal(at, "");
    fclose(out);
    return line;
}

/* What is typeset for a text, its lines with "; " between them. The caller frees it. */
static char *typeset_text(const char *text, const char *form)
{
    struct record asked;
    char *lines = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&lines, &length);
    const cJSON *line = NULL;

    record_init(&asked, &typeset_type);
    record_put_text(&asked, "text", text);
    for (int i = 0; typeset_forms[i]; i++) {
        if (strcmp(typeset_forms[i], form) == 0) {
            record_put(&asked, "form", i);
        }
    }
    cJSON *json = typeset(&asked);
    const cJSON *list = cJSON_GetObjectItem(json, "lines");
    if (!list) {
        fail_msg("%s: %s", text, cJSON_PrintUnformatted(json));
    }
    cJSON_ArrayForEach(line, list)
    {
        char *one = in_one_line(line->valuestring);
        fprintf(out, "%s%s", line == list->child ? "" : "; ", one);
        free(one);
    }
    fclose(out);
    cJSON_Delete(json);
    record_finish(&asked);
    return lines;
}

/* --- cases --- */

static const struct {
    const char *text, *set;
} cases[] = {
    /* what the first look at it shows */
    {"x^2 + 9/4*z^2 - sqrt(y) = a", "x^{2}'+{9}/{4}z^{2}'-√{y}'=a"},
    {"x", "x'=0"},
    {"x < y", "x'<y"},
    {"x <= y", "x'≤y"},
    {"x > y", "x'>y"},
    {"x >= y", "x'≥y"},
    /* sums */
    {"x - (y - z)", "x'-(y-z)'=0"},
    {"x + (y - z)", "x'+y'-z'=0"},
    {"x + (-y + z)", "x'+(-y+z)'=0"},
    {"x - -y", "x'-(-y)'=0"},
    {"- -x", "-(-x)'=0"},
    {"-x*y + y", "-xy'+y'=0"},
    {"x + (-a)*b", "x'+(-ab)'=0"},
    {"-(x + y)", "-(x+y)'=0"},
    {"-(x + y)*z", "-(x+y)z'=0"},
    {"-(-x)*y", "-(-x)y'=0"},
    /* products */
    {"2*3*x", "2⋅3x'=0"},
    {"x*2", "x⋅2'=0"},
    {"x*2^y", "x⋅2^{y}'=0"},
    {"x*(y*z)", "xyz'=0"},
    {"x*(-y)", "x'(-y)'=0"},
    {"2*(x + 1)*(y - 1)", "2'(x+1)'(y-1)'=0"},
    {"(x + 1)^2*y", "(x+1)^{2}y'=0"},
    {"|x|*|y|", "|x||y|'=0"},
    {"x*(1/2)", "x⋅{1}/{2}'=0"},
    /* fractions */
    {"x/y*z", "{x}/{y}z'=0"},
    {"x/(y*z)", "{x}/{yz}'=0"},
    {"(x + y)/(x - y)", "{x+y}/{x-y}'=0"},
    {"x/y/z", "{{x}/{y}}/{z}'=0"},
    {"-1/2*x", "-{1}/{2}x'=0"},
    {"-(x/y)", "-{x}/{y}'=0"},
    /* powers */
    {"-x^2", "-x^{2}'=0"},
    {"(-x)^2", "(-x)^{2}'=0"},
    {"x^-2", "x^{-2}'=0"},
    {"x^y^z", "x^{y^{z}}'=0"},
    {"(x^y)^z", "(x^{y})^{z}'=0"},
    {"(x*y)^2", "(xy)^{2}'=0"},
    {"(x/y)^2", "({x}/{y})^{2}'=0"},
    {"(x + 1)^(y + 1)", "(x+1)^{y+1}'=0"},
    {"x^(1/2)", "x^{1/2}'=0"},
    {"x^(-1/2)", "x^{-1/2}'=0"},
    {"exp(-x^2/2 - y)", "e^{-x^{2}/2-y}'=0"},
    {"exp(x)^2", "(e^{x})^{2}'=0"},
    {"exp((x/2)*y)", "e^{{x}/{2}y}'=0"},
    {"exp(-(x/2)*y)", "e^{-{x}/{2}y}'=0"},
    {"exp(-(x/2))", "e^{-x/2}'=0"},
    {"2^(x/(y + 1))", "2^{{x}/{y+1}}'=0"},
    /* functions */
    {"sin(x)*cos(y)", "sin xcos y'=0"},
    {"sin(x)*y", "sin(x)y'=0"},
    {"y*sin(2*x)", "ysin 2x'=0"},
    {"sin(x + y)", "sin(x+y)'=0"},
    {"sin(x)^2", "sin^{2} x'=0"},
    {"sin(x)^2*y", "sin^{2}(x)y'=0"},
    {"-sin(x)*y", "-sin(x)y'=0"},
    {"-(x*sin(y))*z", "-xsin(y)z'=0"},
    {"-sin(x)^2*y", "-sin^{2}(x)y'=0"},
    {"sin(x)^-1", "(sin x)^{-1}'=0"},
    {"sin(x)^a", "(sin x)^{a}'=0"},
    {"sin(sin(x))", "sin(sin x)'=0"},
    {"sin(x)/x", "{sin x}/{x}'=0"},
    {"max(x, y)^2", "max(x,y)^{2}'=0"},
    {"|x - (|y|)|", "|x-|y||'=0"},
    {"|x|^2", "|x|^{2}'=0"},
    {"sqrt(x)^2", "(√{x})^{2}'=0"},
    {"log2(x)", "{ln x}/{ln 2}'=0"},
    /* numbers and names */
    {"1e-7*x", "10^{-7}x'=0"},
    {"1.5e-9 = x", "1.5×10^{-9}'=x"},
    {"pi*x + tau*y + e*z + phi", "πx'+τy'+ez'+φ'=0"},
    {"alpha := 2; k1 := 3; x_0 := 1; far := 4; alpha*k1*x + x_0*far",
     "α≔2; k_{1}≔3; x_{0}≔1; far≔4; αk_{1}x'+x_{0}far'=0"},
    {"r := x^2 + y^2; r^2 = r*z", "r≔x^{2}'+y^{2}; r^{2}'=rz"},
    {"b := 0.8; x = b*a", "b≔0.8; x'=ba"},
    {"k := 2; x^k = 1", "k≔2; x^{k}'=1"},
    {"k := 3; cheb(k, x) = y", "2x'(2x^{2}-1)'-x'=y"}, /* the number is needed */
};

static void texts_are_set(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *set = typeset_text(cases[i].text, "equation");
        if (strcmp(set, cases[i].set) != 0) {
            print_error("%s\nis set as   %s\ninstead of  %s\n", cases[i].text, set, cases[i].set);
        }
        assert_string_equal(set, cases[i].set);
        free(set);
    }
}

static void forms_differ(void **state)
{
    static const struct {
        const char *form, *text, *set;
    } rows[] = {
        {"function", "sqrt(x)", "√{x}"},
        {"function", "x = 0", "x"},
        {"function", "x = y", "x'=y"},
        {"function", "x < 0", "x'<0"},
        {"expression", "s*cos(t)", "scos t"},
        {"expression", "r := 1; a*r*u", "r≔1; aru"},
        {"expression", "2", "2"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *set = typeset_text(rows[i].text, rows[i].form);
        assert_string_equal(set, rows[i].set);
        free(set);
    }
}

/* The text itself, with each attribute. */
static void an_equation_is_mathml(void **state)
{
    struct equation_errors errors;
    struct equation *equation = equation_read("2*sin(x)/y <= 0", letters, &errors);
    const struct equation_mathml m = {equation, letters, NULL};
    char *text = equation_mathml(&m);
    (void)state;

    assert_string_equal(
        text, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" displaystyle=\"true\"><mrow>"
              "<mfrac><mrow><mn>2</mn><mo form=\"infix\" lspace=\"0\" rspace=\"0.17em\">\u2062</mo>"
              "<mi>sin</mi><mo>\u2061</mo><mspace width=\"0.17em\"/><mi>x</mi></mrow>"
              "<mrow><mi>y</mi></mrow></mfrac></mrow>"
              "<mrow><mo form=\"infix\">\u2264</mo><mn>0</mn></mrow></math>");
    free(text);
    free(equation);
}

/* --- every row of the tables --- */

static void every_function_has_a_look_of_its_own(void **state)
{
    char *set[EQUATION_FUNCTIONS];
    (void)state;

    for (int i = 0; i < EQUATION_FUNCTIONS; i++) {
        const struct equation_function *row = &equation_functions[i];
        char text[64], wanted[64];
        const char *name = row->sign ? row->sign : row->name;
        snprintf(text, sizeof text, "%s(x + 1%s)", row->name, row->arguments > 1 ? ", y" : "");
        switch (row->notation) {
        case EQUATION_CALLED:
            snprintf(wanted, sizeof wanted, "%s(x+1%s)", name, row->arguments > 1 ? ",y" : "");
            break;
        case EQUATION_ROOT:
            snprintf(wanted, sizeof wanted, row->sign ? "{x+1}√{%s}" : "√{x+1}", row->sign);
            break;
        case EQUATION_RAISED:
            snprintf(wanted, sizeof wanted, "%s^{x+1}", row->sign);
            break;
        case EQUATION_FENCED:
            snprintf(wanted, sizeof wanted, "%sx+1%s", row->sign, row->close);
            break;
        }
        set[i] = typeset_text(text, "function");
        assert_string_equal(set[i], wanted);
        for (int k = 0; k < i; k++) {
            assert_string_not_equal(set[i], set[k]);
        }
    }
    for (int i = 0; i < EQUATION_FUNCTIONS; i++) {
        free(set[i]);
    }
}

static void every_constant_and_letter_is_set(void **state)
{
    (void)state;
    for (int i = 0; equation_constants[i].name; i++) {
        char text[32];
        snprintf(text, sizeof text, "x*%s", equation_constants[i].name);
        char *set = typeset_text(text, "function");
        assert_true(strncmp(set, "x", 1) == 0 && strcmp(set + 1, equation_constants[i].sign) == 0);
        free(set);
    }
    for (int i = 0; equation_letters[i]; i++) {
        char *set = typeset_text(equation_letters[i], "expression");
        assert_string_equal(set, equation_letters[i]);
        free(set);
    }
}

/* --- bounds --- */

static char *sum_of(int terms)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    for (int i = 0; i < terms; i++) {
        fprintf(out, "%s%d.5*x^2*y", i > 0 ? "+" : "", i);
    }
    fclose(out);
    return text;
}

static void large_ones_end_with_an_ellipsis(void **state)
{
    static const char *const texts[] = {
        "k := x*y; (k + k*k)^(k + k)",
        "x + (%s)^2 + y",
        "(%s)*(%s)*(%s)*x",
        "sin(%s)/(%s)",
    };
    char *sum = sum_of(300);
    (void)state;

    char *set = typeset_text(sum, "equation");
    assert_non_null(strstr(set, "'+70.5x^{2}y'"));
    assert_null(strstr(set, "'+100.5"));
    assert_string_equal(set + strlen(set) - strlen("y'+⋯'=0"), "y'+⋯'=0");
    free(set);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const size_t room = 4 * strlen(sum) + 64;
        char *text = malloc(room);
        char *few = sum_of(i == 2 ? 90 : 150);
        char *at = text;
        for (const char *c = texts[i]; *c; c++) {
            if (*c == '%') {
                at = stpcpy(at, few);
                c++;
            } else {
                *at++ = *c;
            }
        }
        *at = '\0';
        char *lines = typeset_text(text, "equation");
        assert_true(strlen(lines) < 8000);
        assert_int_equal(strstr(lines, "⋯") != NULL, i > 0);
        free(lines);
        free(few);
        free(text);
    }
    free(sum);
}

/* Written out, each name doubles the one before. */
static void shared_parts_are_not_written_out(void **state)
{
    char *set = typeset_text("p := x + y; q := p*p; r := q*q; s := r*r; s*s = q", "equation");
    (void)state;

    assert_string_equal(set, "p≔x'+y; q≔pp; r≔qq; s≔rr; ss'=q");
    free(set);
    set = typeset_text("p := x + y; q := p*p; r := q*q; s := r*r; k := 2; cheb(k, s*s) = q",
                       "equation");
    assert_true(strlen(set) < 8000);
    free(set);
}

/* --- by chance --- */

static void random_texts_are_well_formed(void **state)
{
    static const char *const parts[] = {
        "x",    "y",    "z", "a", "2", "0.5", "(", ")", "+", "-",  "*", "/",     "^",    "^2",
        "sin(", "max(", ",", "=", "<", " ",   "|", ";", "r", ":=", "π", "sqrt(", "exp(", "floor("};

    enum { ROUNDS = 20000, PARTS = sizeof parts / sizeof parts[0] };
    struct random random = {.state = 4711};
    int valid = 0;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        char text[256] = "";
        struct equation_errors errors;
        const size_t length = 1 + random_below(&random, 14);
        for (size_t i = 0; i < length; i++) {
            strcat(text, parts[random_below(&random, PARTS)]);
        }
        struct equation *equation = equation_read(text, letters, &errors);
        if (equation) {
            free(typeset_text(text, "equation"));
            valid++;
        }
        free(equation);
    }
    assert_true(valid > ROUNDS / 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_set),
        cmocka_unit_test(forms_differ),
        cmocka_unit_test(an_equation_is_mathml),
        cmocka_unit_test(every_function_has_a_look_of_its_own),
        cmocka_unit_test(every_constant_and_letter_is_set),
        cmocka_unit_test(large_ones_end_with_an_ellipsis),
        cmocka_unit_test(shared_parts_are_not_written_out),
        cmocka_unit_test(random_texts_are_well_formed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
