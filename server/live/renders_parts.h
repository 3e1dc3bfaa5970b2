/* SPDX-License-Identifier: MIT */
/* An order as renders.c keeps it. Private to renders.c and image_queue.c. */
#ifndef SERVER_RENDERS_PARTS_H
#define SERVER_RENDERS_PARTS_H

#include "renders.h"

struct render {
    struct render *next;
    uint32_t id;
    struct render_order order;
    char *document; /* a copy of order.document */
    char *account;  /* a copy of order.account */
    int64_t asked;  /* clock_ms */
    int deaths;     /* workers lost while this was asked and belongs to no room */
    bool sent;
    int64_t deadline;
};

#endif
