// SPDX-License-Identifier: MIT
// Adds up TAP. Only leaves count: a result that follows deeper ones is their parent, and node's
// describe() is no test even when it is empty.

const add = (a, b) => ({ results: a.results + b.results, failed: a.failed + b.failed });

export function countTap(text) {
    const count = { passed: 0, failed: 0, skipped: [], faults: [] };
    const seen = []; // per depth: results since the last one nearer to the margin
    let planned = 0;
    let atTop = 0;
    let hasPlan = false;
    let lastPassed = false;
    for (const line of text.split('\n')) {
        const plan = /^1\.\.(\d+)/.exec(line);
        if (plan) {
            hasPlan = true;
            planned += Number(plan[1]);
        }
        if (lastPassed && /^\s+type: 'suite'/.test(line)) {
            count.passed -= 1;
            lastPassed = false;
        }
        const result = /^( *)(not )?ok\b(.*)$/.exec(line);
        if (!result) {
            continue;
        }
        const depth = result[1].length / 4;
        const failed = Boolean(result[2]);
        const below = seen.splice(depth + 1).reduce(add, { results: 0, failed: 0 });
        while (seen.length <= depth) {
            seen.push({ results: 0, failed: 0 });
        }
        seen[depth] = add(seen[depth], { results: 1, failed: failed ? 1 : 0 });
        atTop += depth === 0 ? 1 : 0;
        lastPassed = false;
        if (below.results > 0 && (!failed || below.failed > 0)) {
            continue;
        }
        if (/# SKIP/i.test(result[3])) {
            count.skipped.push(result[3].trim());
        } else if (failed) {
            count.failed += 1;
        } else {
            count.passed += 1;
            lastPassed = true;
        }
    }
    if (hasPlan && planned !== atTop) {
        count.faults.push(`planned ${planned} tests, ran ${atTop}`);
    }
    return count;
}
