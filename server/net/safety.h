/* SPDX-License-Identifier: MIT */
/* What every answer tells a browser, whoever writes it: types are not guessed, addresses not told,
 * and pages of other sites may not embed it. */
#ifndef SERVER_SAFETY_H
#define SERVER_SAFETY_H

/* X("name", "value") */
#define SAFETY_HEADERS(X)                                                                          \
    X("X-Content-Type-Options", "nosniff")                                                         \
    X("Referrer-Policy", "no-referrer")                                                            \
    X("Cross-Origin-Resource-Policy", "same-origin")

#endif
