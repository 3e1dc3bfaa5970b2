/* SPDX-License-Identifier: MIT */
/* Threads whose work may wait for drawing. They take no lock for longer than some instructions. */
#ifndef RENDERER_PATIENT_H
#define RENDERER_PATIENT_H

/* Where both want a processor, the calling thread gets a third of the time of one that draws.
 * Before the process is confined (confine.h). */
void patient_thread(void);

#endif
