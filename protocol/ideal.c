/* SPDX-License-Identifier: MIT */
#include "ideal.h"

#include "limits.h"

const char *const order_names[] = {"lex", "grlex", "grevlex", NULL};
const char *const strategy_names[] = {"normal", "sugar", "first", NULL};
const char *const criteria_names[] = {"both", "coprime", "chain", "none", NULL};

/* clang-format off */
const struct record_type ideal_type = {
    "ideal", "A Groebner basis of an ideal of polynomials, step by step.",
    (const struct param[]){
        {"generators", PARAM_EQUATION,
         .doc = "Polynomials, one in each line. \"a = b\" stands for a - b."},
        {"letters", PARAM_TEXT,
         .doc = "The variables, the greatest first, with spaces between them. Empty: those of the "
                "generators in the order of the alphabet, with x, y and z last."},
        {"order", PARAM_ENUM, .def = {ORDER_GREVLEX}, .choices = order_names,
         .doc = "How monomials are compared: by the first letter that differs; by the degree, "
                "then so; by the degree, then by less of the last letter that differs."},
        {"weights", PARAM_TEXT,
         .doc = "A whole number for each letter: monomials are compared by their sums first."},
        {"eliminate", PARAM_INT, .max = LIMIT_GROEBNER_LETTERS,
         .doc = "So many letters, from the first, are above all others in any power: elements "
                "without them generate the elimination ideal."},
        {"prime", PARAM_INT, .max = 2147483647,
         .doc = "Coefficients are whole numbers modulo this prime; 0: rational numbers."},
        {"strategy", PARAM_ENUM, .choices = strategy_names,
         .doc = "Which pair comes next: the least common multiple, the least sugar, the oldest."},
        {"criteria", PARAM_ENUM, .choices = criteria_names,
         .doc = "Pairs that need no division: those whose leading monomials have no common factor "
                "(coprime), and those with a third element in a chain between them."},
        {"divide", PARAM_EQUATION,
         .doc = "A polynomial that is divided by the basis, with its quotients."},
        {.name = NULL}}};
/* clang-format on */
