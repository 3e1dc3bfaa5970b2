/* SPDX-License-Identifier: MIT */
/* fieldcast groebner: a basis of an ideal of polynomials. */
#include <stdlib.h>

#include "algebra_command.h"
#include "command.h"
#include "protocol/ideal.h"

/* Each polynomial is a line. */
static void set_generators(struct record *asked, const struct options *options)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    for (int i = 0; i < options->operand_count; i++) {
        fprintf(out, "%s\n", options->operands[i]);
    }
    fclose(out);
    record_put_text(asked, "generators", text);
    free(text);
}

/* Options have the names of the members. */
static void set_members(struct record *asked, const struct options *options)
{
    for (int i = OPTION_LETTERS; i <= OPTION_DIVIDE; i++) {
        const struct option_value *value = &options->values[i];
        const char *name = option_row((enum option)i)->name;
        if (value->source == SOURCE_NONE) {
            continue;
        }
        if (option_row((enum option)i)->type == OPTION_TEXT) {
            record_put_text(asked, name, value->text);
        } else {
            record_put(asked, name, value->number[0]);
        }
    }
}

static void print_step(void *data, const char *line)
{
    (void)data;
    fputs(line, stderr);
}

static bool ask(struct algebra *algebra, const void *question, cJSON **out, struct error *err)
{
    const struct options *options = question;
    const bool steps = options->values[OPTION_STEPS].number[0] != 0;
    struct record asked;

    record_init(&asked, &ideal_type);
    set_generators(&asked, options);
    set_members(&asked, options);
    const bool ok = algebra_ask(algebra, &asked, steps ? print_step : NULL, NULL, out, err);
    record_finish(&asked);
    return ok;
}

int command_groebner(const struct options *options)
{
    if (options->operand_count == 0) {
        fputs("fieldcast: groebner takes polynomials\n", stderr);
        return EXIT_USAGE;
    }
    return algebra_command_run(ask, options);
}
