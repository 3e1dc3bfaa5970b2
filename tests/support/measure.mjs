// SPDX-License-Identifier: MIT
// Runs a measurement, which prints one JSON object.
import { spawnSync } from 'node:child_process';
import path from 'node:path';

const root = path.dirname(path.dirname(path.dirname(new URL(import.meta.url).pathname)));

/** What the command prints; `build` has the program that it measures. Ends the process where it fails. */
export function measure(name, build, command, args) {
    console.error(`bench: ${name}`);
    const result = spawnSync(command, args, {
        cwd: root,
        env: { ...process.env, FIELDCAST: path.join(build, 'fieldcast'), FIELDCAST_BUILD: build },
        stdio: ['ignore', 'pipe', 'inherit'],
        maxBuffer: 1 << 28,
    });
    if (result.status !== 0) {
        console.error(`bench: ${name} failed`);
        process.exit(1);
    }
    return JSON.parse(result.stdout);
}

/** tests/bench/NAME.mjs */
export const measureScript = (name, build) =>
    measure(name, build, process.execPath, [path.join(root, `tests/bench/${name}.mjs`)]);
