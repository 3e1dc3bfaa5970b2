// SPDX-License-Identifier: MIT
// The rules of the house, checked by reading files: `node tests/lint/lint.mjs [ROOT [COMMIT]]`. Prints
// `file:line: rule: what is wrong` and fails when there is anything to print. The subjects of commits
// are checked after COMMIT.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

import { checkCircles, checkDrawing, checkImports, checkIncludes, checkUnused } from './arrows.mjs';
import { checkCommits } from './commits.mjs';
import { missingConst } from './constants.mjs';
import { missingBlank } from './declarations.mjs';
import { OLD_GLSL_NAMES, OLD_NAMES } from './names.mjs';
import { checkTidy } from './tidy.mjs';

const FUNCTION_LINES = { c: 60, script: 120 };
const LINE_COLUMNS = 100;
const ESCAPED_LINES = 3; // of a file
const CLANG_FORMAT = 14; // Debian 12's; others break lines a little differently

const here = path.dirname(new URL(import.meta.url).pathname);
const root = path.resolve(process.argv[2] ?? path.join(here, '../..'));
const faults = [];

function report(file, line, rule, message) {
    faults.push(`${file}:${line}: ${rule}: ${message}`);
}

function listFiles(folder = '') {
    const skipped = /^(\.git|build.*|node_modules|dist|coverage)$/;
    return fs.readdirSync(path.join(root, folder), { withFileTypes: true }).flatMap((entry) => {
        const name = path.join(folder, entry.name);
        if (entry.isDirectory()) {
            return skipped.test(entry.name) ? [] : listFiles(name);
        }
        return entry.isFile() ? [name] : [];
    });
}

// Calls `see(match, file, line, text)` for each match of the pattern in the files.
function search(files, pattern, see) {
    for (const file of files) {
        const lines = fs.readFileSync(path.join(root, file), 'utf8').split('\n');
        for (const [index, text] of lines.entries()) {
            const match = pattern.exec(text);
            if (match) {
                see(match, file, index + 1, text);
            }
        }
    }
}

// --- the layers ---

// What C and GLSL have in common has a name in renderer/glsl/interface.h. A fragment shader has one
// output, at location 0.
function checkBindings(files) {
    for (const file of files.filter((name) => /^renderer\/.*\.glsl$/.test(name))) {
        const text = fs.readFileSync(path.join(root, file), 'utf8');
        for (const { 0: what, index } of text.matchAll(/\b(binding|location)\s*=\s*\d+(?!\) out\b)(?!\d)/g)) {
            const line = text.slice(0, index).split('\n').length;
            report(file, line, 'binding', `${what.replace(/\s+/g, ' ')}: name it in renderer/glsl/interface.h`);
        }
    }
}

// The members of the interface's structs that are no vectors: [where they are read, their names].
function scalarMembers() {
    const file = path.join(root, 'renderer/glsl/interface.h');
    const text = fs.existsSync(file) ? fs.readFileSync(file, 'utf8') : '';
    const lists = [...text.matchAll(/^#define (\w+)_(MEMBERS|ARGS)\(X\)((?:.*\\\n)*.*)/gm)];
    const places = { LIGHT: 'light|lights\\[.*?\\]', VOLUME: 'volume|volumes\\[.*?\\]' };
    return lists.map(([, list, kind, rows]) => {
        const pattern = kind === 'ARGS' ? /X\((\w+)\)/g : /X\((?:int|float), (\w+)\)/g;
        const names = [...rows.matchAll(pattern)].map(([, name]) => name);
        return [kind === 'ARGS' ? 'args' : (places[list] ?? list.toLowerCase()), names];
    });
}

// GLSL lets a number be read as a vector of one.
function checkSwizzles(files) {
    const own = files.filter((file) => /^renderer\/.*\.glsl$/.test(file));
    const roots = scalarMembers().map(([place, names]) => `(?:${place})\\.(?:${names.join('|')})`);
    if (roots.length > 0) {
        const pattern = new RegExp(`\\b(?:${roots.join('|')})\\s*(?:\\.\\s*[xyzwrgbastpq]+\\b|\\[)`);
        search(own, pattern, ([what], file, line) => {
            report(file, line, 'swizzle', `${what}: the member is a number, see renderer/glsl/interface.h`);
        });
    }
}

// A GPU waits for a loop without an end, and no number need be one: loops count whole numbers.
function checkLoops(files) {
    const loop = String.raw`\bwhile\s*\(|\bfor\s*\(\s*(?!u?int\b)`;
    const see = ([what], file, line) => report(file, line, 'endless', `${what}: loops of shaders are \`for (int\``);
    search(files.filter((file) => /^renderer\/glsl\/.*\.glsl$/.test(file)), new RegExp(loop), see);
    search(files.filter((file) => file === 'renderer/field/shader.c'), new RegExp(`"[^"]*?(?:${loop})`), see);
}

// All style sheets are one on the page: rules for a class of the same name would meet.
function checkClasses(files) {
    const homes = new Map();
    search(files.filter((file) => /^web\/src\/.*\.css$/.test(file)), /^\.([a-z][a-z0-9-]*)(?= \{|,$)/, ([, name], file, line) => {
        const home = homes.get(name) ?? file;
        homes.set(name, home);
        if (home !== file) {
            report(file, line, 'class', `.${name} has rules in ${home} too: it wants a name of its own`);
        }
    });
}

// protocol/ is pure: it prints only where error.c is handed a stream.
function checkPurity(files) {
    const own = files.filter((file) => /^protocol\/.*\.c$/.test(file));
    const output = /\b(printf|puts|putchar|fputs|fputc|fprintf|fwrite|fopen|perror|system|exit)\s*\(|\bstd(in|out|err)\b/;
    search(own, output, ([what], file, line) => {
        if (!(file === 'protocol/error.c' && what.startsWith('fprintf'))) {
            report(file, line, 'pure', `protocol/ does no input or output: ${what}`);
        }
    });
}

// --- size ---

function checkFunctionsC(files) {
    const own = files.filter((file) => file.endsWith('.c'));
    const tags = spawnSync(
        'ctags',
        ['--output-format=json', '--fields=+ne', '--kinds-C=f', '-f', '-', ...own],
        { cwd: root, encoding: 'utf8', maxBuffer: 1 << 28 },
    );
    if (tags.error || own.length === 0) {
        report('tests/lint/lint.mjs', 1, 'tool', 'universal-ctags is missing');
        return;
    }
    const texts = new Map(own.map((file) => [file, fs.readFileSync(path.join(root, file), 'utf8').split('\n')]));
    for (const line of tags.stdout.split('\n').filter((text) => text.startsWith('{'))) {
        const tag = JSON.parse(line);
        const at = missingBlank(texts.get(tag.path), tag.line - 1, tag.end - 1);
        checkLength(tag.path, tag.line, tag.name, tag.end - tag.line + 1);
        if (at >= 0) {
            report(tag.path, at + 1, 'declared', 'a blank line follows the declarations that a function begins with');
        }
    }
}

// Formatted code ends a function with a brace in the column where its first line begins.
function checkFunctionsScript(files) {
    for (const file of files.filter((name) => /\.(tsx?|mjs)$/.test(name))) {
        const lines = fs.readFileSync(path.join(root, file), 'utf8').split('\n');
        for (const [index, text] of lines.entries()) {
            const head = /^( *)(?:export )?(?:default )?(?:async )?(?:function\*? ?(\w*)|const (\w+) = .*=> \{$)/.exec(text);
            if (!head || text.trimEnd().endsWith('}')) {
                continue;
            }
            const end = lines.findIndex((line, at) => at > index && line.startsWith(`${head[1]}}`));
            checkLength(file, index + 1, head[2] || head[3] || 'a function', end - index + 1);
        }
    }
}

function checkLength(file, line, name, length) {
    const most = file.endsWith('.c') ? FUNCTION_LINES.c : FUNCTION_LINES.script;
    if (length > most) {
        report(file, line, 'size', `${name} has ${length} lines, above the maximum ${most}`);
    }
}

// --- text ---

const SOURCE = /(\.(c|h|glsl|ts|tsx|mjs|css|sh|service|conf)|(^|\/)(Makefile|\.clang-(format|tidy)|\.editorconfig))$/;
const TEXT = /(\.(md|json|html|yml|txt|supp)|(^|\/)(packages|\.gitignore|LICENSE|run))$/;

function checkText(files) {
    const sources = files.filter((file) => SOURCE.test(file));
    for (const file of sources) {
        const head = fs.readFileSync(path.join(root, file), 'utf8').split('\n', 2);
        const line = head[0].startsWith('#!') ? head[1] : head[0];
        if (!line?.includes('SPDX-License-Identifier: MIT')) {
            report(file, 1, 'licence', 'the first line does not say SPDX-License-Identifier: MIT');
        }
    }
    const written = files.filter((file) => SOURCE.test(file) || TEXT.test(file));
    for (const file of written) {
        const text = fs.readFileSync(path.join(root, file), 'utf8');
        if (text.length > 0 && !text.endsWith('\n')) {
            report(file, text.split('\n').length, 'blank', 'the last line does not end');
        }
    }
    search(written, /[ \t\r]+$/, (match, file, line) => {
        report(file, line, 'blank', 'blanks at the end of the line');
    });
    const notLint = sources.filter((file) => !file.startsWith('tests/lint/'));
    search(notLint, /\b(TODO|FIXME|XXX|HACK)\b|^\s*#\s*if 0\b/, ([word], file, line) => {
        report(file, line, 'word', `${word.trim()}: finish it or leave it out`);
    });
    search(files.filter((file) => /\.([ch]|glsl)$/.test(file)), /\t/, (match, file, line) => {
        report(file, line, 'blank', 'a tab');
    });
    const columns = files.filter((file) => /\.([ch]|glsl|sh)$/.test(file));
    search(columns, new RegExp(`^.{${LINE_COLUMNS + 1}}`), (match, file, line) => {
        report(file, line, 'size', `more than ${LINE_COLUMNS} columns`);
    });
}

// Tests write JSON in single quotes, by tests/support/json_text.h; test_json.c reads JSON itself.
function checkEscapes(files) {
    const own = files.filter((file) => /^tests\/.*\.[ch]$/.test(file) && file !== 'tests/unit/test_json.c');
    for (const file of own) {
        const found = [];
        search([file], /\\"[^"\\]*\\" ?:/, (match, name, line) => found.push(line));
        if (found.length > ESCAPED_LINES) {
            const message = `${found.length} lines of escaped JSON members, above the maximum ${ESCAPED_LINES}: use json_text`;
            report(file, found[ESCAPED_LINES], 'escape', message);
        }
    }
}

// A test's name says what holds: `edits_are_undone`.
function checkTests(files) {
    const own = files.filter((file) => /^tests\/.*\.c$/.test(file));
    search(own, /\bvoid (test_\w+)\(void \*\*\w+\)/, ([, name], file, line) => {
        report(file, line, 'test', `${name}: a name says what holds, without test_`);
    });
}

// `sizeof value`, `sizeof(type)`; macros may have either.
const TYPE = '(struct|enum|union|unsigned|void|char|bool|short|int|long|float|double|type|\\w+_t|v[a-z])\\b';

function checkSizeof(files) {
    const own = files.filter((file) => /\.[ch]$/.test(file));
    const value = new RegExp(`^(?!\\s*#\\s*define).*\\bsizeof\\((?!${TYPE})\\*?[a-zA-Z_][\\w.>-]*\\)(?![[.])`);
    search(own, value, (match, file, line) => {
        report(file, line, 'sizeof', 'a value needs no parentheses: `sizeof value`, `sizeof(type)`');
    });
}

function checkConstants(files) {
    for (const file of files.filter((name) => name.endsWith('.c'))) {
        const text = fs.readFileSync(path.join(root, file), 'utf8');
        for (const { at, names } of missingConst(text)) {
            report(file, text.slice(0, at).split('\n').length, 'const', `${names.join(', ')}: const, since nothing writes it later`);
        }
    }
}

// --- names ---

const escaped = (text) => text.replace(/[.*+?^${}()|[\]\\/]/g, '\\$&');

// The history may name what was.
function checkNames(files) {
    const names = OLD_NAMES.map(([old]) => escaped(old) + (/[_/]$/.test(old) ? '' : '(?!\\w)'));
    const pattern = new RegExp(`(?<!\\w)(${names.join('|')})`);
    const renamed = new Map(OLD_NAMES);
    const own = files.filter((file) => !/^tests\/lint\/|^CHANGELOG\.md$/.test(file));
    const see = ([, old], file, line) => {
        report(file, line, 'name', `${old} is called ${renamed.get(old)}`);
    };
    for (const file of own.filter((file) => pattern.test(file))) {
        see(pattern.exec(file), file, 1);
    }
    search(own.filter((file) => SOURCE.test(file) || TEXT.test(file)), pattern, see);
}

function checkNamesGlsl(files) {
    const pattern = new RegExp(`\\b(${OLD_GLSL_NAMES.map(([old]) => old).join('|')})\\b`);
    const renamed = new Map(OLD_GLSL_NAMES);
    for (const file of files.filter((name) => /^renderer\/.*\.glsl$/.test(name))) {
        const text = fs.readFileSync(path.join(root, file), 'utf8');
        const code = text.replace(/\/\*[^]*?\*\//g, (comment) => comment.replace(/[^\n]/g, ' '));
        for (const [index, line] of code.split('\n').entries()) {
            const old = pattern.exec(line)?.[1];
            if (old) {
                report(file, index + 1, 'name', `${old} is called ${renamed.get(old)} in GLSL`);
            }
        }
    }
}

// --- other tools ---

function run(rule, program, args, options = {}) {
    const result = spawnSync(program, args, { cwd: root, encoding: 'utf8', ...options });
    if (result.error) {
        return false;
    }
    if (result.status !== 0) {
        faults.push(`${rule}:\n${(result.stdout + result.stderr).trimEnd()}`);
    }
    return true;
}

function checkFormat(files) {
    const version = spawnSync('clang-format', ['--version'], { encoding: 'utf8' });
    if (!version.stdout?.includes(`version ${CLANG_FORMAT}.`)) {
        console.log(`not checked: clang-format ${CLANG_FORMAT} is not here`);
        return;
    }
    const own = files.filter((name) => /\.[ch]$/.test(name));
    const { status, stderr } = spawnSync('clang-format', ['--dry-run', '--Werror', ...own], {
        cwd: root,
        encoding: 'utf8',
        maxBuffer: 1 << 28,
    });
    const wrong = new Map(); // file: the first line of it that is
    for (const [, file, line] of stderr.matchAll(/^(.+?):(\d+):\d+: error: code should be clang-formatted/gm)) {
        wrong.set(file, Math.min(wrong.get(file) ?? Infinity, Number(line)));
    }
    wrong.forEach((line, file) => report(file, line, 'format', '`make format` would change this line'));
    if (status !== 0 && wrong.size === 0) {
        faults.push(`format:\n${stderr.trimEnd()}`);
    }
}

function checkTools(files) {
    const scripts = files.filter((file) => file.endsWith('.sh') || file === '.ci/run');
    if (scripts.length > 0 && !run('shellcheck', 'shellcheck', scripts)) {
        console.log('not checked: shellcheck is not here');
    }
    const web = path.join(root, 'web');
    if (!fs.existsSync(path.join(web, 'package.json'))) {
        return;
    }
    const biome = path.join(web, 'node_modules/.bin/biome');
    if (!run('biome', biome, ['check', '--colors=off', '.'], { cwd: web })) {
        console.log('not checked: biome is not here (deploy/install-deps.sh)');
    }
}

const files = listFiles().sort();
checkIncludes(files, search, report);
checkCircles(files, search, report);
if (checkDrawing(root, report)) {
    checkUnused(files, search, report);
}
checkBindings(files);
checkLoops(files);
checkClasses(files);
checkSwizzles(files);
checkPurity(files);
checkImports(files, search, report);
checkFunctionsC(files);
checkFunctionsScript(files);
checkText(files);
checkEscapes(files);
checkTests(files);
checkSizeof(files);
checkConstants(files);
checkNames(files);
checkNamesGlsl(files);
if (checkCommits(root, (commit, message) => faults.push(`${commit}: commit: ${message}`), process.argv[3]) === 0) {
    console.log('not checked: no commit, for the history from where the rule begins is not here');
}
checkFormat(files);
checkTools(files);
const tidy = await checkTidy(root, files);
faults.push(...tidy.faults);
if (tidy.skipped) {
    console.log(`not checked: ${tidy.skipped}`);
}
if (faults.length > 0) {
    console.log(faults.join('\n'));
    console.log(`${faults.length} faults`);
    process.exit(1);
}
