/* SPDX-License-Identifier: MIT */
#include "order.h"

static void add_sum(struct order *out, int from, int to)
{
    unsigned long *row = out->matrix[out->rows++];

    for (int i = from; i < to; i++) {
        row[i] = 1;
    }
}

/* Of the letters from..to. */
static void add_block(struct order *out, enum order_kind kind, int from, int to)
{
    if (kind == ORDER_GRLEX) {
        add_sum(out, from, to);
        /* A block behind this one is compared later. */
        for (int i = from; i < to && to < out->letters; i++) {
            add_sum(out, i, i + 1);
        }
    }
    /* Less of the last letter is more of the others, at the same degree. */
    for (int end = to; kind == ORDER_GREVLEX && end > from; end--) {
        add_sum(out, from, end);
    }
}

void order_make(struct order *out, const struct order_params *params)
{
    bool weighted = false;

    *out = (struct order){.letters = params->letters};
    for (int i = 0; i < params->letters; i++) {
        out->matrix[0][i] = params->weights[i];
        weighted |= params->weights[i] != 0;
    }
    out->rows = weighted;
    if (params->eliminate > 0) {
        add_block(out, params->kind, 0, params->eliminate);
    }
    add_block(out, params->kind, params->eliminate, params->letters);
}

unsigned long order_image(const struct order *order, int row, const unsigned long *exponents)
{
    unsigned long sum = 0;

    for (int i = 0; i < order->letters; i++) {
        sum += order->matrix[row][i] * exponents[i];
    }
    return sum;
}

int order_compare(const struct order *order, const unsigned long *a, const unsigned long *b)
{
    for (int row = 0; row < order->rows; row++) {
        const unsigned long left = order_image(order, row, a), right = order_image(order, row, b);
        if (left != right) {
            return left < right ? -1 : 1;
        }
    }
    for (int i = 0; i < order->letters; i++) {
        if (a[i] != b[i]) {
            return a[i] < b[i] ? -1 : 1;
        }
    }
    return 0;
}
