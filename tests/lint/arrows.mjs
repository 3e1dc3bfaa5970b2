// SPDX-License-Identifier: MIT
// Which folder may use which. Lint holds all #include and import lines to these tables, and README.md's
// drawing is made of them: `node tests/lint/arrows.mjs README.md` writes it (make docs).
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

// What every folder of server/ may use, and what it uses nothing of.
const BASE = ['algebra', 'clock', 'digest', 'directory', 'doorbell', 'embedded', 'log', 'metrics', 'questions', 'tasks'].map((name) => `server/${name}.h`);
const WORKER = ['renderer/renderer.h', 'renderer/worker/worker.h', 'renderer/pick.h'];

// What files in a folder or below it may include besides that folder: other folders, single headers.
export const INCLUDES = {
    protocol: [],
    renderer: ['protocol'],
    'renderer/sdf': ['protocol'],
    'renderer/image': ['protocol'],
    'renderer/glsl': ['protocol'],
    'renderer/code': ['protocol', 'renderer/sdf'],
    'renderer/algebra': ['protocol', 'renderer/code'],
    'renderer/field': ['protocol', 'renderer/sdf', 'renderer/code', 'renderer/glsl'],
    'renderer/spmd': ['renderer/code', 'renderer/glsl', 'renderer/field'],
    'renderer/engine': ['protocol', 'renderer/image', 'renderer/code', 'renderer/glsl', 'renderer/field', 'renderer/crash.h'],
    'renderer/gl': ['protocol', 'renderer/glsl', 'renderer/crash.h', 'renderer/vigil.h'],
    'renderer/draw': [
        'protocol',
        ...['glsl', 'field', 'engine', 'gl', 'image', 'crash.h', 'patient.h'].map((name) => `renderer/${name}`),
    ],
    'renderer/worker': [
        'protocol',
        ...['field', 'image', 'renderer.h', 'portrait.h', 'crash.h', 'patient.h', 'slice.h', 'vigil.h'].map((name) => `renderer/${name}`),
    ],
    server: ['protocol', 'renderer/slice.h', 'renderer/vigil.h', ...WORKER],
    'server/net': ['protocol', ...BASE],
    'server/store': ['protocol', ...BASE],
    'server/live': ['protocol', ...WORKER, ...BASE, 'server/net', 'server/store'],
    'server/rest': ['protocol', ...BASE, 'server/net', 'server/live'],
    'server/serve': ['protocol', 'renderer/renderer.h', 'renderer/slice.h', ...BASE, 'server/net', 'server/live', 'server/rest'],
    'server/cli': ['protocol', 'renderer/renderer.h', 'renderer/worker/worker.h', ...BASE, 'server/store', 'server/serve.h'],
};
// What the files that all of server/ may use include themselves.
const BASE_INCLUDES = ['protocol', 'renderer/slice.h', ...BASE];

// Programs and processes of their own: no other file of their layer includes them.
const ENDS = ['renderer/spmd', 'renderer/algebra', 'renderer/worker'];

// The system's headers, where not all may be used.
const SYSTEM = {
    protocol:
        /^(cjson\/cJSON|assert|ctype|errno|float|inttypes|limits|math|search|stdarg|stdbool|stddef|stdint|stdio|stdlib|string)\.h$/,
};

// What files of a folder of web/src may import besides it; only ui knows React.
export const IMPORTS = { model: [], link: ['model'], overlay: ['model'], ui: ['model', 'link', 'overlay'] };

const within = (name, place) => name === place || name.startsWith(`${place}/`);

const filesOf = (files, layer) => files.filter((file) => /\.[ch]$/.test(file) && within(file.replace(/\.[ch]$/, ''), layer));

// `search(files, pattern, see)` as in lint.mjs.
export function checkIncludes(files, search, report) {
    const rules = [...Object.entries(INCLUDES), ...BASE.map((header) => [header.replace(/\.h$/, ''), BASE_INCLUDES])];
    for (const [layer, may] of rules) {
        search(filesOf(files, layer), /^\s*#\s*include\s*(["<])([^">]+)[">]/, ([, quote, name], file, line) => {
            const allowed =
                quote === '<'
                    ? !SYSTEM[layer] || SYSTEM[layer].test(name)
                    : !name.includes('/') || [layer, ...may].some((place) => within(name, place));
            const end = ENDS.find((place) => within(name, place) && within(file, path.dirname(place)) && !within(file, place));
            if (!allowed || end) {
                report(file, line, 'arrow', `${layer}/ may not include ${name}`);
            }
        });
    }
}

// An arrow that no file needs is a line too many in the drawing.
export function checkUnused(files, search, report) {
    for (const [layer, may] of Object.entries(INCLUDES)) {
        const used = new Set();
        search(filesOf(files, layer), /^\s*#\s*include\s*"([^"]+)"/, ([, name]) => used.add(may.find((place) => within(name, place))));
        for (const place of may.filter((name) => !BASE.includes(name) && !used.has(name))) {
            report('tests/lint/arrows.mjs', 1, 'arrow', `no file of ${layer}/ includes ${place}: take it out`);
        }
    }
}

// Within these folders no file needs itself by way of others; `a.c` and `a.h` are one.
const WITHOUT_CIRCLES = [
    ...['glsl', 'sdf', 'spmd', 'algebra'].map((name) => `renderer/${name}`),
    ...['net', 'live', 'rest'].map((name) => `server/${name}`),
];

export function checkCircles(files, search, report) {
    const needs = new Map();
    const stem = (file) => file.replace(/\.[ch]$/, '');
    for (const folder of WITHOUT_CIRCLES) {
        const own = files.filter((file) => path.dirname(file) === folder && /\.[ch]$/.test(file));
        search(own, /^\s*#\s*include\s*"([^"]+)"/, ([, name], file, line) => {
            const target = name.includes('/') ? name : path.join(folder, name);
            if (path.dirname(target) === folder && stem(target) !== stem(file)) {
                needs.set(stem(file), [...(needs.get(stem(file)) ?? []), { to: stem(target), file, line }]);
            }
        });
    }
    const done = new Set();
    const visit = (node, way) => {
        for (const { to, file, line } of done.has(node) ? [] : needs.get(node) ?? []) {
            if (way.includes(to)) {
                report(file, line, 'circle', [...way.slice(way.indexOf(to)), to].join(' -> '));
            } else {
                visit(to, [...way, to]);
            }
        }
        done.add(node);
    };
    [...needs.keys()].forEach((node) => visit(node, [node]));
}

export function checkImports(files, search, report) {
    const source = 'web/src/';
    for (const [part, others] of Object.entries(IMPORTS)) {
        const own = files.filter((file) => file.startsWith(`${source}${part}/`) && /\.tsx?$/.test(file));
        const pattern = /(?:\bfrom|\bimport)\s*\(?\s*['"]([^'"]+)['"]/;
        search(own, pattern, ([, name], file, line) => {
            const target = path.join(path.dirname(file), name).replace(source, '').split('/')[0];
            const wrong = name.startsWith('.')
                ? target in IMPORTS && target !== part && !others.includes(target)
                : part !== 'ui' && /^(react|@base-ui|@headless-tree|lucide-react)/.test(name);
            if (wrong) {
                report(file, line, 'arrow', `web/src/${part} may not import ${name}`);
            }
        });
    }
}

// --- the drawing ---

// Each name behind all that it needs: [[names that need none of the others], [...], ...].
function ranks(needs) {
    const rank = (name) => 1 + Math.max(-1, ...needs[name].filter((other) => other in needs).map(rank));
    const out = [];
    for (const name of Object.keys(needs)) {
        (out[rank(name)] ??= []).push(name);
    }
    return out;
}

// Of the folders below `top`, those that each one needs.
function needsBelow(top) {
    const names = Object.keys(INCLUDES).filter((name) => name.startsWith(`${top}/`));
    const short = (name) => name.slice(top.length + 1);
    return Object.fromEntries(
        names.map((name) => [short(name), INCLUDES[name].map((other) => short(other.replace(/\.h$/, '')))]),
    );
}

export function drawing() {
    const row = (top, needs, first, last) => {
        const columns = [...first, ...ranks(needs).map((names) => names.join('  ')), ...last];
        return `${top.padEnd(10)} ${columns.join('  <-  ')}`;
    };
    const { worker, ...parts } = needsBelow('renderer');
    const layers = ['protocol', 'renderer', 'server'];
    const tops = layers.map((name) => [name, INCLUDES[name].map((other) => other.split('/')[0])]);
    const folders = Object.entries(INCLUDES).filter(([name]) => name.includes('/'));
    const places = (may) => {
        const shown = may.filter((name) => !BASE.includes(name) && name !== 'protocol');
        return shown.map((name) => `\`${name}\``).join(' ') || 'nothing else';
    };
    return [
        '```',
        row('', Object.fromEntries(tops), [], []) + `${' '.repeat(8)}protocol  <-  (schema)  <-  web`,
        '',
        row('renderer/', parts, [], ['files of renderer/', ...(worker ? ['worker'] : [])]),
        row('server/', needsBelow('server'), [BASE.map((name) => path.basename(name, '.h')).join('  ')], []),
        row('web/src/', IMPORTS, [], []),
        '```',
        '| folder | includes, besides itself, `protocol`, and the files of `server/` that all its folders use |',
        '|---|---|',
        ...folders.map(([name, may]) => `| \`${name}\` | ${places(may)} |`),
    ].join('\n');
}

const BEGIN = '<!-- arrows -->\n';
const END = '\n<!-- end of arrows -->';

// README.md with the drawing as the tables are now; null: it has no place for one.
export function withDrawing(text) {
    const [begin, end] = [text.indexOf(BEGIN), text.indexOf(END)];
    return begin < 0 || end < 0 ? null : text.slice(0, begin + BEGIN.length) + drawing() + text.slice(end);
}

// Whether README.md has the drawing, true or not.
export function checkDrawing(root, report) {
    const file = path.join(root, 'README.md');
    const text = fs.existsSync(file) ? fs.readFileSync(file, 'utf8') : '';
    const wanted = withDrawing(text);
    if (wanted !== null && wanted !== text) {
        const line = text.slice(0, text.indexOf(BEGIN)).split('\n').length;
        report('README.md', line, 'drawing', 'the arrows are others now: `make docs` writes them');
    }
    return wanted !== null;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [, , file] = process.argv;
    fs.writeFileSync(file, withDrawing(fs.readFileSync(file, 'utf8')));
}
