// SPDX-License-Identifier: MIT
// A view that moves: what the viewers of guests.mjs look at.
export const VIEW = { width: 128, height: 96 };
export const EVERY_MS = 40;
export const place = (i) => ({ camera: { position: [5 * Math.sin(i / 20), 1, 5 * Math.cos(i / 20)] } });
