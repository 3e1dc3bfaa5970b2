/* SPDX-License-Identifier: MIT */
#ifndef SERVER_DIRECTORY_H
#define SERVER_DIRECTORY_H

/* Syncs the directory that holds `path`, so that the name of a new file survives a loss of power.
 * Does nothing where this user may not open that directory. */
void directory_sync_parent(const char *path);

#endif
