// SPDX-License-Identifier: MIT
// This tree keeps the rules of the house, and each rule can fail: a small tree is clean, and breaking
// it in one place makes the linter name the rule.
import assert from 'node:assert';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, describe, test } from 'node:test';

import { INCLUDES } from './arrows.mjs';

const here = path.dirname(new URL(import.meta.url).pathname);
const C = '/* SPDX-License-Identifier: MIT */\n';
const TS = '// SPDX-License-Identifier: MIT\n';

const CLEAN = {
    Makefile: '# SPDX-License-Identifier: MIT\nwarnings := -Wextra\n',
    'protocol/scene.c': `${C}#include "scene.h"\n\n#include <cjson/cJSON.h>\n#include <string.h>\n`,
    'protocol/error.c': `${C}#include <stdio.h>\n\nvoid print(FILE *out)\n{\n    fprintf(out, "x");\n}\n`,
    'protocol/scene.h': C,
    'renderer/draw/draw.c': `${C}#include "draw.h"\n\n#include <GL/gl.h>\n\n#include "protocol/scene.h"\n`,
    'renderer/draw/draw.h': C,
    'renderer/renderer.h': C,
    'renderer/glsl/interface.h': `${C}#define FRAME_MEMBERS(X) X(vec3, zenith) X(int, effects)\n#define SHADE_ARGS(X) X(first)\n`,
    'renderer/glsl/march.glsl': `${C}/* Most of it. */\nlayout(location = 0) out float o;\nfloat f() { return frame.zenith.x; }\n`,
    'server/live/room.c': `${C}#include "protocol/scene.h"\n#include "renderer/renderer.h"\n`,
    'server/live/room.h': C,
    'server/live/hub.c': `${C}#include "room.h"\n\nint scan(int *to);\n\nint count(int a)\n{\n    const int b = a;\n    int c = b, d = 0;\n\n    scan(&d);\n    c += d;\n    return c;\n}\n`,
    'web/src/model/document.ts': `${TS}import { b } from './operations';\n`,
    'web/src/link/link.ts': `${TS}import { b } from '../model/operations';\n`,
    'web/src/ui/App.tsx': `${TS}import React from 'react';\nimport { l } from '../link/link';\n`,
    'web/src/ui/app.css': `${C}.bar {\n    color: red;\n}\n`,
    'deploy/run.sh': `#!/bin/sh\n# SPDX-License-Identifier: MIT\necho hello\n`,
    'README.md': '# text\n',
};

const longFunction = (lines) => `${C}int f(void)\n{\n${'    f();\n'.repeat(lines)}    return 0;\n}\n`;

const BREAKS = [
    ['arrow', 'protocol/scene.c', `${C}#include "renderer/renderer.h"\n`],
    ['arrow', 'protocol/scene.h', `${C}#include <pthread.h>\n`],
    ['arrow', 'protocol/scene.c', `${C}#include <GL/gl.h>\n`],
    ['arrow', 'renderer/draw/draw.c', `${C}#include "server/live/room.h"\n`],
    ['arrow', 'server/live/room.c', `${C}#include "renderer/gl/program.h"\n`],
    ['arrow', 'server/live/room.c', `${C}  #  include "renderer/field/field.h"\n`],
    ['arrow', 'web/src/model/document.ts', `${TS}import { l } from '../link/link';\n`],
    ['arrow', 'renderer/gl/gl.c', `${C}#include "renderer/draw/frame_uniforms.h"\n`],
    ['arrow', 'renderer/gl/gl.c', `${C}#include "renderer/renderer.h"\n`],
    ['arrow', 'renderer/field/field.c', `${C}#include "renderer/gl/gl.h"\n`],
    ['arrow', 'renderer/image/png.c', `${C}#include "renderer/renderer.h"\n`],
    ['arrow', 'renderer/draw/draw.c', `${C}#include "renderer/worker/worker.h"\n`],
    ['arrow', 'renderer/draw/draw.c', `${C}#include "renderer/renderer.h"\n`],
    ['arrow', 'renderer/job.c', `${C}#include "renderer/worker/turns.h"\n`],
    ['arrow', 'server/net/http.c', `${C}#include "server/live/hub.h"\n`],
    ['arrow', 'server/net/http.c', `${C}#include "server/rest/routes.h"\n`],
    ['arrow', 'server/store/store.c', `${C}#include "server/live/hub.h"\n`],
    ['arrow', 'server/live/hub.h', `${C}#include "server/rest/routes.h"\n`],
    ['arrow', 'server/rest/images.c', `${C}#include "server/cli/options.h"\n`],
    ['arrow', 'server/tasks.c', `${C}#include "server/live/hub.h"\n`],
    ['arrow', 'server/net/ws.c', `${C}#include "renderer/worker/worker.h"\n`],
    ['arrow', 'web/src/model/document.ts', `${TS}const o = await import('../overlay/pointer');\n`],
    ['arrow', 'web/src/link/link.ts', `${TS}import { App } from '../ui/App';\n`],
    ['arrow', 'web/src/link/link.ts', `${TS}import React from 'react';\n`],
    ['arrow', 'web/src/overlay/pointer.ts', `${TS}export { App } from '../ui/App';\n`],
    ['circle', 'server/live/room.c', `${C}#include "hub.h"\n`],
    ['binding', 'renderer/glsl/march.glsl', `${C}layout(binding = 3) uniform sampler2D a;\n`],
    ['binding', 'renderer/glsl/march.glsl', `${C}layout(location = 2) uniform int a;\n`],
    ['binding', 'renderer/glsl/march.glsl', `${C}layout(std430, binding=0) buffer X { float a; };\n`],
    ['binding', 'renderer/glsl/march.glsl', `${C}layout(std140, binding =\n    12)\nuniform X { float a; };\n`],
    ['binding', 'renderer/glsl/march.glsl', `${C}layout(location = 10) in float a;\n`],
    ['swizzle', 'renderer/glsl/march.glsl', `${C}int f() { return frame.effects.w; }\n`],
    ['swizzle', 'renderer/glsl/march.glsl', `${C}int f() { return args.first[1]; }\n`],
    ['class', 'web/src/ui/view.css', `${C}.bar,\n.foo {\n    color: red;\n}\n`],
    ['endless', 'renderer/glsl/march.glsl', `${C}void f()\n{\n    while (rest > 0.0) {\n    }\n}\n`],
    ['endless', 'renderer/glsl/march.glsl', `${C}void f()\n{\n    for (float x = 1.0; x > 0.0; x -= 1.0) {\n    }\n}\n`],
    ['endless', 'renderer/field/shader.c', `${C}void f(void)\n{\n    fputs("for (float x = 1.0;", out);\n}\n`],
    ['pure', 'protocol/scene.c', `${C}void f(void)\n{\n    printf("x");\n}\n`],
    ['pure', 'protocol/scene.c', `${C}void f(void)\n{\n    error_print(0, stderr);\n}\n`],
    ['size', 'renderer/draw/draw.c', longFunction(70)],
    ['size', 'web/src/ui/App.tsx', `${TS}function f() {\n${'    f();\n'.repeat(130)}}\n`],
    ['size', 'renderer/glsl/march.glsl', `${C}/* ${'x'.repeat(100)} */\n`],
    ['licence', 'renderer/draw/draw.h', '#define DRAW 1\n'],
    ['licence', 'deploy/run.sh', '#!/bin/sh\necho hello\n'],
    ['blank', 'README.md', '# text \n'],
    ['blank', 'README.md', '# text'],
    ['blank', 'renderer/glsl/march.glsl', `${C}\tfloat f();\n`],
    ['word', 'renderer/draw/draw.h', `${C}/* TO${'DO'} */\n`],
    ['word', 'renderer/draw/draw.c', `${C}#if 0\n#endif\n`],
    ['sizeof', 'server/live/room.c', `${C}static int a[3];\n\nint f(void)\n{\n    return sizeof(a);\n}\n`],
    ['declared', 'server/live/room.c', `${C}int f(int b)\n{\n    int a = 2 *\n            b;\n    return a;\n}\n`],
    ['declared', 'server/live/room.c', `${C}void f(void **state)\n{\n    struct room *room;\n    (void)state;\n    room = 0;\n}\n`],
    ['const', 'server/live/room.c', `${C}int f(int b)\n{\n    int a = 2 * b, c = a;\n    return c;\n}\n`],
    ['const', 'server/live/hub.c', `${C}int f(int b)\n{\n    if (b > 0) {\n        bool a = b == 1;\n        return a;\n    }\n    return 0;\n}\n`],
    ['escape', 'tests/unit/test_scene.c', `${C}const char *a =\n${'    "{\\"type\\":1}"\n'.repeat(4)};\n`],
    ['test', 'tests/unit/test_json.c', `${C}static void test_numbers(void **state)\n{\n    (void)state;\n}\n`],
    ['name', 'server/live/room.c', `${C}#include "fallback.h"\n\nvoid f(void)\n{\n    say_bye(0);\n}\n`],
    ['name', 'server/live/fallback.h', C],
    ['name', 'README.md', '`server/live/renders` asks again.\n'],
    ['name', 'renderer/glsl/march.glsl', `${C}/* What light goes through. */\nfloat through = 0.0;\n`],
    ['name', 'renderer/draw/draw.h', `${C}#include "frame_block.h"\n`],
    ['format', 'renderer/draw/draw.c', `${C}int f(void) { return 0; }\n`],
    ['tidy', 'server/live/hub.c', `${C}int f(int a)\n{\n    return a == 1 || a == 1;\n}\n`],
    ['tidy', 'server/live/stream.c', `${C}int f(int *a)\n{\n    return *a;\n}\n`],
    ['tidy', 'server/live/room.c', `${C}int f(int a)\n{\n    if (a > 0);\n    return a;\n}\n`],
    ['tidy', 'server/live/rooms.c', `${C}struct pair {\n    int a, b;\n};\nstatic const struct pair pairs[] = {{1}};\nint f(void)\n{\n    return pairs[0].a;\n}\n`],
    ['shellcheck', 'deploy/run.sh', `#!/bin/sh\n# SPDX-License-Identifier: MIT\necho $1\n`],
];

// Of each row of the table: a header of a folder that it may not use.
for (const [layer, may] of Object.entries(INCLUDES)) {
    const headers = ['protocol/scene.h', ...Object.keys(INCLUDES).map((folder) => `${folder}/any.h`)];
    const allowed = (header) => [layer, ...may].some((place) => header === place || header.startsWith(`${place}/`));
    const forbidden = headers.findLast((header) => !allowed(header));
    BREAKS.push(['arrow', `${layer}/row.c`, `${C}#include "${forbidden}"\n`]);
}

const trees = [];
after(() => trees.forEach((tree) => fs.rmSync(tree, { recursive: true, force: true })));

function makeTree(changes) {
    const tree = fs.mkdtempSync(path.join(os.tmpdir(), 'fieldcast-lint-'));
    trees.push(tree);
    for (const name of ['.clang-format', '.clang-tidy']) {
        fs.copyFileSync(path.join(here, '../..', name), path.join(tree, name));
    }
    for (const [file, text] of Object.entries({ ...CLEAN, ...changes })) {
        fs.mkdirSync(path.join(tree, path.dirname(file)), { recursive: true });
        fs.writeFileSync(path.join(tree, file), text);
    }
    return tree;
}

const lint = (changes) => lintTree(makeTree(changes));

function lintTree(tree, ...args) {
    const run = spawnSync(process.execPath, [path.join(here, 'lint.mjs'), tree, ...args], {
        encoding: 'utf8',
    });
    return { status: run.status, text: run.stdout + run.stderr };
}

test('this tree is clean', () => {
    const { status, text } = lintTree(path.join(here, '../..'));
    assert.equal(status, 0, text);
});

test('the small tree is clean', () => {
    const { status, text } = lint({});
    assert.equal(status, 0, text);
});

// Starting the tools takes the time: a tree is broken in many files at once, in each of them once.
const rounds = [];

function roundFor(file, text) {
    const round = rounds.find(({ changes }) => !(file in changes)) ?? { changes: {}, result: null };
    if (!rounds.includes(round)) {
        rounds.push(round);
    }
    round.changes[file] = text;
    return round;
}

describe('each rule can fail', () => {
    for (const [rule, file, text] of BREAKS) {
        const round = roundFor(file, text);
        const name = text.split('\n').slice(1).join(' ').slice(0, 50).trim();
        test(`${rule}: ${file}: ${name}`, () => {
            round.result ??= lint(round.changes);
            assert.equal(round.result.status, 1, round.result.text);
            const place = rule === 'shellcheck' ? '^shellcheck:' : `^${file}:\\d+: ${rule}: `;
            assert.match(round.result.text, new RegExp(place, 'm'));
        });
    }
});

test('what was clean is read again when a header changes', () => {
    const tree = makeTree({});
    assert.equal(lintTree(tree).status, 0);
    const stamp = path.join(tree, 'build/lint/tidy');
    const before = fs.readFileSync(stamp, 'utf8');
    assert.equal(lintTree(tree).status, 0);
    assert.equal(fs.readFileSync(stamp, 'utf8'), before);
    const wrong = `${C}static inline int f(int a)\n{\n    return a - a;\n}\n`;
    fs.writeFileSync(path.join(tree, 'server/live/room.h'), wrong);
    for (let again = 0; again < 2; again++) {
        const { status, text } = lintTree(tree);
        assert.equal(status, 1, text);
        assert.match(text, /^server\/live\/room\.h:4: tidy: /m);
    }
});

test('the drawing of the arrows is theirs, and each arrow is needed', () => {
    const readme = fs.readFileSync(path.join(here, '../../README.md'), 'utf8');
    const wrong = lint({ 'README.md': readme.replace('| `renderer/code` | `renderer/sdf` |', '| `renderer/code` | nothing else |') });
    assert.match(wrong.text, /^README\.md:\d+: drawing: /m);
    const right = lint({ 'README.md': readme });
    assert.doesNotMatch(right.text, /: drawing: /);
    assert.match(right.text, /: arrow: no file of renderer\/code\/ includes renderer\/sdf: take it out/);
});

const SUBJECTS = [
    ['a full stop', 'server: say bye.'],
    ['too long', `server: say ${'bye '.repeat(16)}`.trim()],
    ['no area', 'say bye'],
    ['no verb', 'server: the bye is said'],
    ['no imperative', 'server, web: says bye'],
    ['upper case', 'Server: say bye'],
];

test('subjects of commits are checked from a commit on', () => {
    const tree = makeTree({});
    const git = (...args) => {
        const own = ['-C', tree, '-c', 'user.name=n', '-c', 'user.email=e@localhost', '-c', 'commit.gpgsign=false'];
        const run = spawnSync('git', [...own, ...args], { encoding: 'utf8' });
        assert.equal(run.status, 0, run.stderr);
        return run.stdout.trim();
    };
    const commit = (subject) => {
        git('commit', '-q', '--allow-empty', '-m', subject);
        return git('rev-parse', '--short', 'HEAD');
    };
    git('init', '-q');
    git('add', '.');
    const first = commit('What was before the rule.');
    commit('server/live, web: say bye');
    assert.equal(lintTree(tree, first).status, 0);
    const wrong = SUBJECTS.map(([what, subject]) => [what, commit(subject)]);
    const { status, text } = lintTree(tree, first);
    assert.equal(status, 1, text);
    for (const [what, hash] of wrong) {
        assert.match(text, new RegExp(`^${hash}: commit: `, 'm'), what);
    }
    assert.equal(text.match(/: commit: /g).length, SUBJECTS.length, text);
    const shallow = path.join(tree, 'build/shallow');
    git('clone', '-q', '--depth', '1', `file://${tree}`, shallow);
    const none = lintTree(shallow, first);
    assert.equal(none.status, 0, none.text);
    assert.match(none.text, /^not checked: no commit/m);
});
