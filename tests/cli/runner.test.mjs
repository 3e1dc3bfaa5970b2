// SPDX-License-Identifier: MIT
// The test runner can fail: broken suites in a scratch tree are told from good ones.
import assert from 'node:assert';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { countTap } from '../support/tap.mjs';

const tests = path.dirname(path.dirname(new URL(import.meta.url).pathname));

function numbers(text) {
    const { passed, failed, skipped, faults } = countTap(text);
    return [passed, failed, skipped.length, faults.length];
}

test('flat results are counted', () => {
    assert.deepEqual(numbers('1..3\nok 1 - a\nnot ok 2 - b\nok 3 - c # SKIP no GPU\n'), [1, 1, 1, 0]);
});

test('parents and describe() are not counted', () => {
    const text = [
        '    ok 1 - child',
        '        not ok 1 - grandchild',
        '    not ok 2 - in',
        'not ok 1 - parent',
        'ok 2 - empty',
        "  type: 'suite'",
        '    ok 1 - child',
        'not ok 3 - parent that fails by itself',
        '1..3',
    ].join('\n');
    assert.deepEqual(numbers(text), [2, 2, 0, 0]);
});

test('a broken plan is a fault', () => {
    assert.deepEqual(numbers('1..2\nok 1 - a\n'), [1, 0, 0, 1]);
});

// Runs a tree with one suite, a shell script.
function runSuite(script) {
    const tree = fs.mkdtempSync(path.join(os.tmpdir(), 'fieldcast-runner-'));
    try {
        fs.mkdirSync(path.join(tree, 'tests/x'), { recursive: true });
        fs.cpSync(path.join(tests, 'support'), path.join(tree, 'tests/support'), { recursive: true });
        fs.copyFileSync(path.join(tests, 'run.mjs'), path.join(tree, 'tests/run.mjs'));
        fs.writeFileSync(path.join(tree, 'tests/x/run.sh'), script);
        const result = spawnSync(process.execPath, [path.join(tree, 'tests/run.mjs'), tree], {
            encoding: 'utf8',
        });
        return { status: result.status, last: result.stdout.trimEnd().split('\n').pop() };
    } finally {
        fs.rmSync(tree, { recursive: true, force: true });
    }
}

for (const [name, script, status, last] of [
    ['a good suite passes', 'echo 1..1; echo ok 1 - a', 0, '1 passed, 0 failed'],
    ['a failed test fails', 'echo not ok 1 - a; exit 1', 1, '0 passed, 1 failed'],
    ['no test at all fails', 'true', 1, '0 passed, 1 failed'],
    ['a crash fails', 'echo ok 1 - a; kill -SEGV $$', 1, '1 passed, 1 failed'],
    ['a status without a reason fails', 'echo ok 1 - a; exit 3', 1, '1 passed, 1 failed'],
    ['a process left behind fails', 'echo ok 1 - a; sleep 600 &', 1, '1 passed, 1 failed'],
]) {
    test(name, () => assert.deepEqual(runSuite(script), { status, last }));
}
