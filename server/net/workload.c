/* SPDX-License-Identifier: MIT */
#include "workload.h"

int64_t workload_charge(struct workload *workload, int64_t now_us, int64_t spent_us)
{
    const int64_t paid = now_us - workload->at_us - spent_us;

    workload->us = (workload->us > paid ? workload->us - (paid > 0 ? paid : 0) : 0) + spent_us;
    workload->at_us = now_us;
    if (workload->us <= WORKLOAD_FREE_US) {
        return 0;
    }
    return workload->us < WORKLOAD_REST_MAX_US ? workload->us : WORKLOAD_REST_MAX_US;
}
