/* SPDX-License-Identifier: MIT */
#ifndef SERVER_DIRECTORY_H
#define SERVER_DIRECTORY_H

/* Of what was just made: its name outlasts a loss of power. Nothing where the parent directory is
 * closed to this user. */
void directory_sync_parent(const char *path);

#endif
