// SPDX-License-Identifier: MIT
// All measurements as one JSON object: `fieldcast bench` under "program", and what each script
// tests/bench/NAME.mjs prints under its name. `node tests/bench.mjs BUILD [ARGUMENT of bench]...`
import fs from 'node:fs';
import path from 'node:path';
import { measure, measureScript } from './support/measure.mjs';

const build = path.resolve(process.argv[2] ?? 'build/release');
const scripts = path.join(path.dirname(new URL(import.meta.url).pathname), 'bench');

const program = path.join(build, 'fieldcast');
const results = { program: measure('program', build, program, ['bench', ...process.argv.slice(3)]) };
for (const file of fs.readdirSync(scripts).sort()) {
    if (file.endsWith('.mjs')) {
        const name = path.basename(file, '.mjs');
        results[name] = measureScript(name, build);
    }
}
console.log(JSON.stringify(results, null, 2));
