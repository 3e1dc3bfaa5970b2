// SPDX-License-Identifier: MIT
// clang-tidy over the C files of protocol/, renderer/ and server/, by the checks of .clang-tidy. A file
// that was clean is not read again until it changes, or a header that it includes.
import { execFile, spawnSync } from 'node:child_process';
import crypto from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';

const CLANG_TIDY = 14; // Debian 12's
const BATCH = 8; // files of one process

const INCLUDE = /^\s*#\s*include\s*"([^"]+)"/gm;

// The files that a compiler reads by itself: neither parts of another one, nor made of such parts.
function unitsOf(root, files) {
    const own = files.filter((file) => /^(protocol|renderer|server)\/.*\.c$/.test(file));
    const parts = new Set();
    for (const file of own) {
        const included = includesOf(root, file).filter((name) => name.endsWith('.c'));
        [...included, ...(included.length > 0 ? [file] : [])].forEach((name) => parts.add(name));
    }
    return own.filter((file) => !parts.has(file));
}

function includesOf(root, file) {
    const text = fs.readFileSync(path.join(root, file), 'utf8');
    return [...text.matchAll(INCLUDE)].map(([, name]) => {
        const beside = path.join(path.dirname(file), name);
        return fs.existsSync(path.join(root, beside)) ? beside : name;
    });
}

// Names a state of the file, of all that it includes, and of how it is read.
function stateOf(root, file, how) {
    const hash = crypto.createHash('sha256').update(how);
    const seen = new Set();
    const visit = (name) => {
        if (!seen.has(name) && fs.existsSync(path.join(root, name))) {
            seen.add(name);
            hash.update(`\n${name}\n`).update(fs.readFileSync(path.join(root, name)));
            includesOf(root, name).forEach(visit);
        }
    };
    visit(file);
    return hash.digest('hex');
}

// Those of the Makefile, which a compiler prints: gcc's are seen where the program is built, clang's here.
function warningsOf(root) {
    const file = path.join(root, 'Makefile');
    const text = fs.existsSync(file) ? fs.readFileSync(file, 'utf8') : '';
    const [, list = ''] = /^warnings := ((?:.*\\\n)*.*)$/m.exec(text) ?? [];
    return list.split(/[\s\\]+/).filter((word) => /^-W(?!error)/.test(word));
}

function flagsOf(root) {
    const packages = fs.existsSync(path.join(root, 'deploy/packages'))
        ? fs.readFileSync(path.join(root, 'deploy/packages'), 'utf8')
        : '';
    const modules = [...packages.matchAll(/^module\s+(\S+)\s+\S+\s+run$/gm)].map(([, name]) => name);
    const found = spawnSync('pkg-config', ['--cflags', ...modules], { encoding: 'utf8' });
    if (modules.length > 0 && found.status !== 0) {
        return null;
    }
    const cflags = modules.length > 0 ? found.stdout.trim().split(/\s+/) : [];
    return ['-std=gnu17', '-D_GNU_SOURCE', '-DFIELDCAST_VERSION="0"', '-I.', ...warningsOf(root), ...cflags];
}

// Returns { faults: [text], skipped: reason or undefined }.
export async function checkTidy(root, files) {
    const version = spawnSync('clang-tidy', ['--version'], { encoding: 'utf8' });
    if (!version.stdout?.includes(`version ${CLANG_TIDY}.`)) {
        return { faults: [], skipped: `clang-tidy ${CLANG_TIDY} is not here` };
    }
    const flags = flagsOf(root);
    if (!flags) {
        return { faults: [], skipped: 'clang-tidy: pkg-config finds not all of deploy/packages' };
    }
    const how = flags.join(' ') + fs.readFileSync(path.join(root, '.clang-tidy'), 'utf8');
    const stamp = path.join(root, 'build/lint/tidy');
    const clean = new Set(fs.existsSync(stamp) ? fs.readFileSync(stamp, 'utf8').split('\n') : []);
    const units = unitsOf(root, files).map((file) => ({ file, state: stateOf(root, file, how) }));
    const open = units.filter(({ state }) => !clean.has(state));
    const batches = [];
    while (open.length > 0) {
        batches.push(open.splice(0, BATCH));
    }
    const faults = new Set();
    const worker = async () => {
        for (let batch = batches.pop(); batch; batch = batches.pop()) {
            const args = ['--quiet', ...batch.map(({ file }) => file), '--', ...flags];
            const result = await promisify(execFile)('clang-tidy', args, { cwd: root, maxBuffer: 1 << 26 }).catch((error) => error);
            if (result.code === undefined) {
                batch.forEach(({ state }) => clean.add(state));
            } else {
                faultsIn(root, result).forEach((fault) => faults.add(fault));
            }
        }
    };
    await Promise.all(os.cpus().map(worker));
    fs.mkdirSync(path.dirname(stamp), { recursive: true });
    fs.writeFileSync(stamp, units.map(({ state }) => state).filter((state) => clean.has(state)).join('\n'));
    return { faults: [...faults] };
}

// `file:line: tidy: what is wrong [check]`
function faultsIn(root, { stdout, message }) {
    const found = [...(stdout ?? '').matchAll(/^(.+?):(\d+):\d+: (?:error|warning): (.*)$/gm)].map(
        ([, file, line, what]) => `${path.relative(root, path.resolve(root, file))}:${line}: tidy: ${what.replace(',-warnings-as-errors', '')}`,
    );
    return found.length > 0 ? found : [`tidy: ${message}\n${stdout ?? ''}`];
}
