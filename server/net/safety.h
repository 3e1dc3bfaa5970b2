/* SPDX-License-Identifier: MIT */
/* Headers of every answer of the server. A browser then guesses no types, sends no Referer, and
 * lets no page of another site embed the answer. */
#ifndef SERVER_SAFETY_H
#define SERVER_SAFETY_H

/* X("name", "value") */
#define SAFETY_HEADERS(X)                                                                          \
    X("X-Content-Type-Options", "nosniff")                                                         \
    X("Referrer-Policy", "no-referrer")                                                            \
    X("Cross-Origin-Resource-Policy", "same-origin")

#endif
