/* SPDX-License-Identifier: MIT */
#include "tile_clock.h"

#include "draw_internal.h"

void tile_clock_mark(const struct gl *gl, bool software, struct tile_in_flight *slot,
                     enum frame_stage stage)
{
    if (software) {
        gl->Finish();
        const uint64_t now = draw_now_us();
        slot->stage_us[stage] += now - slot->last_us;
        slot->last_us = now;
    } else if (slot->marks < DRAW_MARKS) {
        if (slot->queries[slot->marks] == 0) {
            gl->GenQueries(1, &slot->queries[slot->marks]);
        }
        gl->QueryCounter(slot->queries[slot->marks], GL_TIMESTAMP);
        slot->stages[slot->marks++] = (uint8_t)stage;
    }
}

void tile_clock_start(const struct gl *gl, bool software, struct tile_in_flight *slot)
{
    for (int i = 0; i < FRAME_STAGES; i++) {
        slot->stage_us[i] = 0;
    }
    slot->marks = 0;
    slot->last_us = draw_now_us();
    if (!software) {
        tile_clock_mark(gl, software, slot, FRAME_MARCH);
    }
}

void tile_clock_resume(const struct gl *gl, bool software, struct tile_in_flight *slot)
{
    slot->last_us = draw_now_us();
    if (!software) {
        tile_clock_mark(gl, software, slot, FRAME_QUEUE);
    }
}

void tile_clock_fetch(const struct gl *gl, struct tile_in_flight *slot)
{
    GLuint64 before = 0;

    for (int i = 0; i < slot->marks; i++) {
        GLuint64 ns = 0;
        gl->GetQueryObjectui64v(slot->queries[i], GL_QUERY_RESULT, &ns);
        if (i > 0) {
            slot->stage_us[slot->stages[i]] += (ns - before) / 1000;
        }
        before = ns;
    }
}
