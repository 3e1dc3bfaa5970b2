/* SPDX-License-Identifier: MIT */
/* The bound of answers that wait for their clients. Lengths are told and not allocated. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "server/net/answers.h"
#include "server/net/shared_buffer.h"

enum { PART = LIMIT_ANSWERS_BYTES / 8, SMALL = 60000 };

static struct answer *add_for(struct answers *answers, const char *client, size_t length)
{
    const struct response response = {.status = 200, .body = malloc(1), .length = length};
    struct answer *answer = answers_add(answers, client, &response);

    if (!answer) {
        free(response.body);
    }
    return answer;
}

/* Each of another client. */
static struct answer *add(struct answers *answers, size_t length)
{
    static int count;
    char client[16];

    snprintf(client, sizeof client, "%d", count++);
    return add_for(answers, client, length);
}

static void one_client_has_a_share(void **state)
{
    struct answers answers;
    struct answer *first, *second, *other;

    (void)state;
    answers_init(&answers);
    first = add_for(&answers, "a", PART);
    second = add_for(&answers, "a", PART);
    assert_non_null(second);
    assert_null(add_for(&answers, "a", PART));
    answer_destroy(add_for(&answers, "a", SMALL));
    other = add_for(&answers, "b", LIMIT_ANSWERS_SHARE_BYTES + PART); /* alone */
    assert_non_null(other);
    assert_null(add_for(&answers, "b", PART));
    answer_destroy(first);
    first = add_for(&answers, "a", PART);
    assert_non_null(first);
    answer_destroy(first);
    answer_destroy(second);
    answer_destroy(other);
    assert_int_equal(answers.held, 0);
    assert_null(answers.clients);
    answers_finish(&answers);
}

static void together(void **state)
{
    struct answers answers;
    struct answer *held[8], *small[100];

    (void)state;
    answers_init(&answers);
    for (int i = 0; i < 8; i++) {
        held[i] = add(&answers, PART);
        assert_non_null(held[i]);
    }
    assert_null(add(&answers, PART));
    for (int i = 0; i < 100; i++) { /* large ones keep no small ones out */
        small[i] = add(&answers, SMALL);
        assert_non_null(small[i]);
    }
    answer_destroy(held[3]);
    held[3] = add(&answers, PART);
    assert_non_null(held[3]);
    for (int i = 0; i < 100; i++) {
        answer_destroy(small[i]);
    }
    for (int i = 0; i < 8; i++) {
        answer_destroy(held[i]);
    }
    assert_int_equal(answers.held, 0);
    answers_finish(&answers);
}

static void shared_bytes_count_once(void **state)
{
    struct answers answers;
    struct answer *held[100];
    struct shared_buffer *shared = shared_buffer_create("", 1);

    (void)state;
    answers_init(&answers);
    shared->length = LIMIT_ANSWERS_BYTES;
    for (int i = 0; i < 100; i++) {
        held[i] = answers_add(&answers, "a",
                              &(struct response){.status = 200,
                                                 .shared = shared_buffer_ref(shared),
                                                 .length = shared->length});
        assert_non_null(held[i]);
    }
    assert_null(add(&answers, PART));
    for (int i = 0; i < 100; i++) {
        assert_null(add(&answers, PART));
        answer_destroy(held[i]);
    }
    assert_int_equal(answers.held, 0);
    answer_destroy(add(&answers, PART));
    shared_buffer_unref(shared);
    answers_finish(&answers);
}

static void static_bytes_count_nothing(void **state)
{
    struct answers answers;

    (void)state;
    answers_init(&answers);
    struct answer *answer = answers_add(
        &answers, "a",
        &(struct response){
            .status = 200, .body = "", .borrowed = true, .length = LIMIT_ANSWERS_BYTES});
    assert_non_null(answer);
    assert_int_equal(answers.held, 0);
    answer_destroy(answer);
    answers_finish(&answers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_client_has_a_share),
        cmocka_unit_test(together),
        cmocka_unit_test(shared_bytes_count_once),
        cmocka_unit_test(static_bytes_count_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
