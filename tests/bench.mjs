// SPDX-License-Identifier: MIT
// All measurements as one JSON object: `fieldcast bench` under "program", and what each script
// tests/bench/NAME.mjs prints under its name. `node tests/bench.mjs BUILD [ARGUMENT of bench]...`
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const tests = path.dirname(new URL(import.meta.url).pathname);
const build = path.resolve(process.argv[2] ?? 'build/release');
const program = path.join(build, 'fieldcast');

function measure(name, command, args) {
    console.error(`bench: ${name}`);
    const result = spawnSync(command, args, {
        cwd: path.dirname(tests),
        env: { ...process.env, FIELDCAST: program, FIELDCAST_BUILD: build },
        stdio: ['ignore', 'pipe', 'inherit'],
        maxBuffer: 1 << 28,
    });
    if (result.status !== 0) {
        console.error(`bench: ${name} failed`);
        process.exit(1);
    }
    return JSON.parse(result.stdout);
}

const results = { program: measure('program', program, ['bench', ...process.argv.slice(3)]) };
const folder = path.join(tests, 'bench');
for (const file of fs.existsSync(folder) ? fs.readdirSync(folder).sort() : []) {
    if (file.endsWith('.mjs')) {
        const name = path.basename(file, '.mjs');
        results[name] = measure(name, process.execPath, [path.join(folder, file)]);
    }
}
console.log(JSON.stringify(results, null, 2));
