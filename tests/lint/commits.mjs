// SPDX-License-Identifier: MIT
// The subjects of commits: `area: verb ...`, imperative, at most 72 characters.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const SUBJECT_CHARACTERS = 72;
// The rule holds for what came after this commit.
const RULE_AFTER = 'a135d9c831e72f02538eaa27d43cac755d1ac0bb';

const VERBS = new Set(
    `abort accept act adapt add adjust advance align allow answer apply ask assert attach avoid back balance batch
    begin bend bind block bound break bring build bump bundle cache call cancel carry cast catch change check
    choose clamp clarify clean clear clip clone close collapse collect color colour combine compare compile complete compress
    compute confine configure connect consider convert copy correct count cover create cross cut deal decide declare
    decode define delay delete deny derive describe detach detect disable discard display distinguish divide document
    download draw drive drop edit embed empty enable encode end enforce ensure erase escape estimate evaluate exclude
    expand expect explain export expose extend extract fade fail fall feed fetch fill filter find finish fit fix flush
    focus fold follow forbid force forget format forward free freeze gather generate give go grant group grow guard
    guess halve hand handle hash help hide hint hold hurry ignore implement import improve include increase index infer
    inform inherit initialise inline insert inspect install instance interpolate invert isolate join judge jump keep know
    kill label launch lay lead leave lengthen let lift light limit link lint list listen load lock log look loosen lose
    lower make map mark march mask match measure meet mend merge migrate mirror mix move name narrow nest normalise note
    number observe offer omit open order organise own pack paint parse pass paste patch pause pay pick pin place plan
    play point poll pool prefer prepare press preserve prevent print probe promise propose protect prove provide publish
    pull push put quarantine queue quote raise reach react read rebuild receive record recover redraw reduce refer
    refine reflect refresh refuse regenerate reject relax release rely remember remove rename render reorder repair
    repeat replace reply report require reserve reset resize resolve respect rest restart restore restrict retry return
    reuse revert review rewrite rotate round route run sample save say scale scan schedule search seal see select send
    separate serialise serve set shade share shorten show shrink shut sign simplify size skip smooth snap solve sort
    speak speed spell split spread stage stand start starve state stay step stop store stream strip style submit subtract
    suggest supervise supply support suspend swap switch synchronise sync take teach tell test think throttle
    tidy tie tighten time trace track translate treat trim trust try tune turn type undo unify unite unload unpack
    update upgrade upload use validate vary verify wait wake walk warm warn watch weigh widen wrap write zoom`.split(/\s+/),
);

// What is wrong with a subject; undefined: nothing.
export function subjectFault(subject) {
    const [, rest] = /^[a-z0-9_./-]+(?:, [a-z0-9_./-]+)*: (.+)$/.exec(subject) ?? [];
    const verb = rest?.split(/\s/)[0];
    if (subject.length > SUBJECT_CHARACTERS) {
        return `${subject.length} characters, above the maximum ${SUBJECT_CHARACTERS}`;
    }
    if (!rest) {
        return 'expected `area: verb ...` in lower case';
    }
    if (!VERBS.has(verb)) {
        return `${verb} is no verb of the list: begin with an imperative, or add it to tests/lint/commits.mjs`;
    }
    return subject.endsWith('.') ? 'ends with a full stop' : undefined;
}

function git(root, ...args) {
    const { status, stdout } = spawnSync('git', ['-C', root, ...args], { encoding: 'utf8', maxBuffer: 1 << 26 });
    return status === 0 ? stdout.trimEnd() : null;
}

// Calls `report(commit, message)` for each fault; returns how many commits were read, 0 where there
// is no history.
export function checkCommits(root, report, after = RULE_AFTER) {
    const top = git(root, 'rev-parse', '--show-toplevel');
    if (!top || path.resolve(top) !== fs.realpathSync(root) || git(root, 'cat-file', '-e', `${after}^{commit}`) === null) {
        return 0;
    }
    const lines = git(root, 'log', '--no-merges', '--format=%h %s', `${after}..HEAD`)?.split('\n').filter(Boolean) ?? [];
    for (const line of lines) {
        const [, commit, subject] = /^(\w+) (.*)$/.exec(line) ?? [];
        const fault = subjectFault(subject);
        if (fault) {
            report(commit, `${fault}: ${subject}`);
        }
    }
    return lines.length;
}
