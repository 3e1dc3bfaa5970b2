// SPDX-License-Identifier: MIT
// What the driver takes to compile users' code that is as large as may be: processor time against a
// scene without code, of each kind of statement alone and of texts by chance, with and without the
// driver's optimizer. BOUND_SEEDS texts, from BOUND_FROM on; BOUND_TEXTS: a folder for them.
import { spawnSync } from 'node:child_process';
import path from 'node:path';

const program = path.join(process.env.FIELDCAST_BUILD ?? 'build/release', 'tests/property/test_code_bound');
const seeds = process.env.BOUND_SEEDS ?? '20';

function measure(extra) {
    const { stdout } = spawnSync(program, { env: { ...process.env, BOUND_SEEDS: seeds, ...extra }, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
    const rows = [...stdout.matchAll(/^# ratio (\S+) of (\d+) ms, (.+)$/gm)].map(([, ratio, , name]) => ({ ratio: Number(ratio), name }));
    rows.sort((a, b) => b.ratio - a.ratio);
    return { texts: rows.length, median: rows[rows.length >> 1]?.ratio, worst: rows.slice(0, 5) };
}

console.log(JSON.stringify({ optimized: measure({}), plain: measure({ GALLIVM_PERF: 'nopt' }) }, null, 2));
