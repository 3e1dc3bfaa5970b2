// SPDX-License-Identifier: MIT
// All hostile and honest texts of code beside eight busy loops: what was told otherwise than it should
// be, workers that ended, and how long a viewer of another scene waited for its pictures.
//
//   node tests/bench/hostile_code.mjs [STAGE]    STAGE: engine (the default), compute, fragment
import { hostileLoad } from '../support/hostile_load.mjs';
import { HONEST, HOSTILE } from '../support/hostile_code.mjs';

const stage = process.argv[2] ?? 'engine';
const EVERY = Number(process.env.HOSTILE_EVERY ?? 1); // each so manieth text
const TOLD = 25;

const texts = [...HOSTILE, ...HONEST].filter((_, i) => i % EVERY === 0);
const start = Date.now();
const result = await hostileLoad(texts, {
    options: { args: ['--stage', stage] },
    whole: true,
    tell: (i, name) => i % TOLD === 0 && console.error(`hostile: ${i} of ${texts.length}, ${name}`),
});
const figures = (pauses, what) => {
    const sorted = pauses.map((one) => one[what]).sort((a, b) => a - b);
    const at = (share) => Math.round(100 * (sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0)) / 100;
    return { count: sorted.length, p50: at(0.5), p99: at(0.99), longest: at(1) };
};
const both = (pauses) => ({ ms: figures(pauses, 'ms'), cpu_s: figures(pauses, 'cpu') });
console.log(
    JSON.stringify(
        {
            stage,
            texts: texts.length,
            wrong: result.wrong,
            restarts: result.restarts,
            dead: result.dead,
            alone: both(result.alone),
            beside: both(result.beside),
            seconds: Math.round((Date.now() - start) / 1000),
        },
        null,
        2,
    ),
);
process.exit(0);
