/* SPDX-License-Identifier: MIT */
/* The choices of a hand: which way its axes point, and about what it turns and scales. */

export type Space = "world" | "local" | "parent";
export const SPACES: readonly Space[] = ["world", "local", "parent"];

/* The middle of all, the origin of the active one, or each its own. */
export type Pivot = "center" | "origin" | "each";
export const PIVOTS: readonly Pivot[] = ["center", "origin", "each"];
