// SPDX-License-Identifier: MIT
// How many there are of what suites walk: a walk that loses some of them fails.
export const EXAMPLES = 73; // protocol/examples/*.json
export const GOLDEN = 182; // tests/golden/*/*/scene.json that are drawn
export const OUTPUTS = 11; // rows of the schema
export const LIGHTS = 3; // the same
export const VOLUMES = 3;
export const SHADERS = 7;
