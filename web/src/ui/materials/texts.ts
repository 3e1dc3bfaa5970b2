/* SPDX-License-Identifier: MIT */
/* The texts of the gallery, which is loaded later. */
export const TEXTS = {
    search: "Clay, gold, glass, wood …",
    what: "Adds it to the scene. Drag it onto something to use it there.",
    whatTry: "The picture shows it on trial; a click applies it.",
    trying: "Trying {name}, not applied yet",
    earth: "Clay and glazes",
    soft: "Plastic, rubber, wax",
    metal: "Metals",
    clear: "Glass and water",
    light: "Light",
    pattern: "Wood and stone",
} as const;
