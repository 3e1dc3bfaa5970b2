// SPDX-License-Identifier: MIT
// The command line as a user meets it: output, exit status, and what is left on disk.
import assert from 'node:assert';
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';

import { EXAMPLES } from '../support/counts.mjs';
import { decodePng } from '../support/png.mjs';
import { readZip } from '../support/zip.mjs';

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), '../..');
const program = process.env.FIELDCAST ?? path.join(root, 'build/release/fieldcast');
const SMALL = ['--width', '32', '--height', '24', '--samples', '1'];
const SPHERE = '{"format":"fieldcast/1","root":{"type":"sphere"}}';

let folder;
before(() => {
    folder = fs.mkdtempSync(path.join(os.tmpdir(), 'fieldcast-cli-'));
});
after(() => fs.rmSync(folder, { recursive: true, force: true }));

// Runs the program; with `binary` stdout stays a Buffer.
function run(args, { input, binary = false, env = {} } = {}) {
    const result = spawnSync(program, args, {
        cwd: folder,
        input,
        env: { ...process.env, ...env },
        maxBuffer: 1 << 28,
    });
    return {
        status: result.status,
        out: binary ? result.stdout : String(result.stdout),
        err: String(result.stderr),
    };
}

function succeed(args, options) {
    const result = run(args, options);
    assert.equal(result.status, 0, result.err + result.out);
    return result;
}

function write(name, text) {
    fs.writeFileSync(path.join(folder, name), text);
    return name;
}

const pngSize = (bytes) => {
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
};

test('version and help', () => {
    assert.match(succeed(['--version']).out, /^fieldcast \d+\.\d+\.\d+\n$/);
    const help = succeed(['--help']).out;
    for (const command of ['serve', 'render', 'check', 'shader', 'import', 'schema', 'doctor', 'bench']) {
        assert.match(help, new RegExp(`^  ${command} `, 'm'));
        assert.match(succeed([command, '--help']).out, new RegExp(`^Usage: fieldcast ${command}`));
        assert.equal(succeed(['help', command]).out, succeed([command, '--help']).out);
    }
    assert.doesNotMatch(help, /worker/);
});

test('misuse says what is meant, on stderr, with status 2', () => {
    for (const [args, message] of [
        [[], /^Usage/],
        [['sreve'], /sreve: is no command; did you mean "serve"\?/],
        [['serve', '--prot', '1'], /--prot: is no option of fieldcast serve; did you mean "port"\?/],
        [['serve', '--port', '70000'], /--port: 70000 is above the maximum 65535/],
        [['render'], /render: needs SCENE.json/],
        [['render', 'example:snowman'], /--output: is needed/],
        [['render', 'example:snowman', '-o', 'x.bmp'], /x\.bmp has no known extension/],
    ]) {
        const result = run(args);
        assert.equal(result.status, 2, args.join(' '));
        assert.match(result.err, message);
        assert.equal(result.out, '');
    }
});

test('what cannot be printed is a failure', () => {
    const full = fs.openSync('/dev/full', 'w');
    for (const args of [
        ['--version'],
        ['help', 'options'],
        ['check', '--help'],
        ['check', 'example:surface-heart'],
        ['shader', 'example:first-steps'],
        ['schema'],
        ['schema', '--reference'],
        ['groebner', 'x*y - 1'],
    ]) {
        const { status, stderr } = spawnSync(program, args, { stdio: ['ignore', full, 'pipe'] });
        assert.equal(status, 1, args.join(' '));
        assert.match(String(stderr), /stdout: not all could be written/, args.join(' '));
    }
    fs.closeSync(full);
});

test('check names file, place and rule', () => {
    const good = write('good.json', SPHERE);
    const bad = write(
        'bad.json',
        '{"format":"fieldcast/1","root":{"id":"ball","type":"sphere","params":{"radius":-1}}}',
    );
    assert.equal(succeed(['check', good]).out, '');
    const result = run(['check', good, bad, 'absent.json', 'example:snowman']);
    assert.equal(result.status, 1);
    const lines = result.out.trimEnd().split('\n');
    assert.equal(lines.length, 2, result.out);
    assert.match(lines[0], /^bad\.json: \/nodes\/ball\/params\/radius: /);
    assert.equal(lines[1], 'absent.json: No such file or directory');
});

test('check reads stdin', () => {
    succeed(['check', '-'], { input: SPHERE });
    const result = run(['check', '-'], { input: '{"format":' });
    assert.equal(result.status, 1);
    assert.match(result.out, /^-: line 1/);
});

const ball = (n) => ({ type: 'sphere', transform: { translation: [n, 0, 0] } });
const balls = (count) => ({ id: 'all', type: 'union', children: Array.from({ length: count }, (_, n) => ball(n)) });
const field = (code) => ({ id: 'own', type: 'field', params: { code } });
const shaded = (code) => ({
    shaders: { pale: { code } },
    materials: { m: { shader: 'pale' } },
    root: { ...ball(0), material: 'm' },
});
/* What reads well as a document, and cannot be drawn. */
const UNDRAWABLE = [
    ['code that is none', { root: field('float sdf(vec3 p) { this is no code }') }, /^\/nodes\/own\/params\/code:1:21: there is no type this/],
    ['a type mismatch', { root: field('float sdf(vec3 p)\n{\n    return p;\n}') }, /^\/nodes\/own\/params\/code:3:\d+: /],
    ['no function', { root: field('float x = 1.0;') }, /there is no function float sdf/],
    ['recursion', { root: field('float f(float x) { return f(x); } float sdf(vec3 p) { return f(p.x); }') }, /calls itself/],
    ['a loop without end', { root: field('float sdf(vec3 p) { float s = 0.0; for (float x = 0.0; x < p.x; x += 0.1) s += x; return s; }') }, /:1:\d+: .*loop/],
    ['loops that take too long', { root: field('float sdf(vec3 p) { float s = 0.0; for (int i = 0; i < 4000; i++) for (int k = 0; k < 4000; k++) s += p.x; return s; }') }, /above the maximum/],
    ['a division by 0', { root: field('float sdf(vec3 p) {\n    return length(p) / (p.x - p.x);\n}') }, /^\/nodes\/own\/params\/code:2:\d+: /],
    [
        'a primitive',
        { primitives: { rod: { code: 'float sdf(vec3 p) { return q; }' } }, root: { type: 'field', params: { primitive: 'rod' } } },
        /^\/primitives\/rod\/code:1:\d+: .*q/,
    ],
    ['a shader', shaded('vec3 shade(FragmentProperties p) { return vec2(1.0); }'), /^\/shaders\/pale\/code:1:\d+: /],
    ['too many lights', { lights: Array.from({ length: 17 }, () => ({ type: 'point' })), root: ball(0) }, /^\/lights: more lights than the maximum 16/],
    ['too many volumes', { volumes: Array.from({ length: 9 }, () => ({ type: 'box' })), root: ball(0) }, /^\/volumes: more volumes than the maximum 8/],
];

test('check tells of what cannot be drawn what render tells of it', () => {
    for (const [what, document, message] of UNDRAWABLE) {
        const text = JSON.stringify({ format: 'fieldcast/1', ...document });
        write('undrawable.json', text);
        const checked = run(['check', 'undrawable.json']);
        assert.equal(checked.status, 1, what);
        const said = checked.out.replace(/^undrawable\.json: /, '');
        assert.match(said, message, what);
        const drawn = run(['render', 'undrawable.json', '-o', 'undrawable.png', ...SMALL]);
        assert.equal(drawn.status, 1, what);
        assert.equal(drawn.err.replace(/^fieldcast: (undrawable\.json: )?/, ''), said, what);
    }
});

// `render` draws without them.
const UNUSED = [
    ['a primitive', { primitives: { rod: { code: 'nonsense' } }, root: ball(0) }, /^\/primitives\/rod\/code:1:\d+: /],
    ['a shader', { shaders: { pale: { code: 'nonsense' } }, root: ball(0) }, /^\/shaders\/pale\/code:1:\d+: /],
    ['a hidden node', { root: { type: 'union', children: [ball(0), { ...field('nonsense'), visible: false }] } }, /^\/nodes\/own\/params\/code:1:\d+: /],
    [
        'a hidden equation',
        { root: { type: 'union', children: [ball(0), { type: 'implicit', id: 'own', visible: false, params: { equation: 'x +' } }] } },
        /^\/nodes\/own\/params\/equation:1:\d+: /,
    ],
];

test('check reads code that nothing draws', () => {
    for (const [what, document, message] of UNUSED) {
        const file = write('unused.json', JSON.stringify({ format: 'fieldcast/1', ...document }));
        const checked = run(['check', file]);
        assert.equal(checked.status, 1, what);
        assert.match(checked.out.replace(/^unused\.json: /, ''), message, what);
        succeed(['render', file, '-o', 'unused.png', ...SMALL]);
    }
});

test('check passes what can be drawn, and warns of it as render does', () => {
    const steep = { format: 'fieldcast/1', root: field('float sdf(vec3 p) { return 3.0 * (length(p) - 0.5); }') };
    const checked = run(['check', write('steep.json', JSON.stringify(steep))]);
    assert.equal(checked.status, 0);
    assert.match(checked.err, /^fieldcast: warning: steep\.json: \/nodes\/own\/params\/code: the distance changes by up to /);
});

test('check tells which picture a document needs besides', () => {
    const document = (image) => JSON.stringify({ format: 'fieldcast/1', environment: { type: 'image', image }, root: { type: 'sphere' } });
    const checked = run(['check', write('around.json', document('ab'.repeat(32)))]);
    assert.equal(checked.status, 0);
    assert.match(checked.err, /^fieldcast: warning: around\.json: \/environment\/image: the document needs the file with the SHA-256 (ab){32}/);
    assert.equal(succeed(['check', 'example:studio-portrait']).err, '');
});

test('check warns of a slope that only the second shape has, and of one far from the origin', () => {
    const primitives = { ball: { params: [{ name: 'k', type: 'float', default: 1 }], code: 'float sdf(vec3 p) { return k * (length(p) - 0.5); }' } };
    const shape = (k) => ({ type: 'field', params: { primitive: 'ball', k } });
    const second = { format: 'fieldcast/1', primitives, root: { type: 'union', children: [shape(1), shape(5)] } };
    const far = { format: 'fieldcast/1', root: field('float sdf(vec3 p) { float d = length(p) - 3.0; return p.x > 2.2 ? 6.0 * d : d; }') };
    assert.match(succeed(['check', write('second.json', JSON.stringify(second))]).err, /\/primitives\/ball\/code: the distance changes by up to 5 /);
    assert.match(succeed(['check', write('far.json', JSON.stringify(far))]).err, /\/nodes\/own\/params\/code: the distance changes by up to /);
    second.root.children.pop();
    assert.equal(succeed(['check', write('second.json', JSON.stringify(second))]).err, '');
});

test('a thousand shapes are right, and draw', () => {
    const scene = write('many.json', JSON.stringify({ format: 'fieldcast/1', root: balls(1000) }));
    succeed(['check', scene]);
    succeed(['render', scene, '-o', 'many.png', ...SMALL]);
});

test('every example is right', () => {
    const examples = fs
        .readdirSync(path.join(root, 'protocol/examples'))
        .filter((name) => name.endsWith('.json'));
    assert.equal(examples.length, EXAMPLES);
    succeed(['check', ...examples.map((name) => `example:${path.basename(name, '.json')}`)]);
});

const thesis = path.join(root, 'tests/import/thesis');

test('import makes a document of a folder, and it draws', () => {
    const { err } = succeed(['import', thesis, '-o', 'cena.json']);
    assert.match(err, /^\S+scenes\/Cena1\.json:8:1: read as a member of the object before it.*\n$/);
    assert.equal(succeed(['check', 'cena.json']).out, '');
    assert.equal(succeed(['import', thesis, '-o', '-']).out, fs.readFileSync(path.join(folder, 'cena.json'), 'utf8'));
    succeed(['render', 'cena.json', '-o', 'cena.png', ...SMALL]);
    assert.deepEqual(pngSize(fs.readFileSync(path.join(folder, 'cena.png'))), [32, 24]);
});

// Red, green and blue in the middle of a picture.
function middlePixel(name) {
    const { width, height, channels, pixels } = decodePng(fs.readFileSync(path.join(folder, name)));
    const at = channels * (Math.floor(height / 2) * width + Math.floor(width / 2));
    return [...pixels.subarray(at, at + 3)];
}

// The thesis' blend of (0.5, 0.1, 0.5) and (0.2, 0.7, 0.6), 0.618 of the way, is (0.315, 0.471, 0.562).
test('an imported shader has its colour in the picture', () => {
    fs.cpSync(thesis, path.join(folder, 'blend'), { recursive: true });
    write('blend/models/Ball.json', '{"name": "Ball", "materials": ["blend_material"], "model": {"type": "Primitives/Sphere", "material_id": 0}}');
    write('blend/scenes/ball.json', '{"name": "ball", "scene": [{"type": "Models/Ball"}]}');
    succeed(['import', 'blend', '-o', 'ball.json', '--scene', 'ball']);
    succeed(['render', 'ball.json', '-o', 'ball.png', ...SMALL]);
    const pixel = middlePixel('ball.png');
    assert.ok(pixel.every((value, i) => Math.abs(value - [152, 182, 197][i]) <= 1), `${pixel}`);
});

test('whole numbers of a shader are imported, checked and drawn', () => {
    fs.mkdirSync(path.join(folder, 'whole'));
    write('whole/s.json', JSON.stringify({
        name: 'Pos',
        properties: ['[int2] _I2', '[int3] _I3'],
        code: 'int2 _I2;\nint3 _I3;\nfloat3 shade(FragmentProperties p) { return float3(_I2 % 2, _I3.z / 4); }',
    }));
    write('whole/m.json', '{"base_shader": "Pos", "properties": [{"name": "_I2", "type": "int2", "value": "(3, 4)"}, {"name": "_I3", "type": "int3", "value": "(0, 0, 7)"}]}');
    write('whole/scene.json', '{"scene": [{"type": "Operations/Union", "children": [{"type": "Models/ball"}]}]}');
    write('whole/ball.json', '{"materials": ["m"], "model": {"type": "Primitives/Torus", "data": [0.1, 1], "material_id": 0}}');
    succeed(['import', 'whole', '-o', 'whole.json']);
    assert.equal(succeed(['check', 'whole.json']).out, '');
    succeed(['render', 'whole.json', '-o', 'whole.png', ...SMALL]);
    assert.deepEqual(middlePixel('whole.png'), [255, 0, 255]);
});

test('a file name that is no UTF-8 makes a document that check passes', () => {
    const name = Buffer.concat([Buffer.from(path.join(folder, 'latin/sc')), Buffer.from([0xe9]), Buffer.from('ne.json')]);
    fs.mkdirSync(path.join(folder, 'latin'));
    fs.writeFileSync(name, '{"scene": [{"type": "Primitives/Sphere"}]}');
    succeed(['import', 'latin', '-o', 'latin.json']);
    assert.equal(JSON.parse(fs.readFileSync(path.join(folder, 'latin.json'), 'utf8')).name, 'sc\ufffdne');
    succeed(['check', 'latin.json']);
});

test('import names file, line, column and what was expected', () => {
    fs.mkdirSync(path.join(folder, 'two/below'), { recursive: true });
    write('two/below/a.json', '{"scene": []}');
    write('two/b.json', '{"name": "B", "scene": [{"type": "Primitives/Sphere"}]}');
    write('two/notes.txt', '{');
    let result = run(['import', 'two', '-o', 'x.json']);
    assert.equal(result.status, 1);
    assert.match(result.err, /there are 2 scenes: "B", "a"; say which/);
    succeed(['import', 'two', '-o', 'x.json', '--scene', 'B']);
    assert.equal(JSON.parse(fs.readFileSync(path.join(folder, 'x.json'), 'utf8')).name, 'B');
    write('two/b.json', '{"scene": [\n  {"type": "Primitives/Spere"}]}');
    result = run(['import', 'two', '-o', 'y.json', '--scene', 'b']);
    assert.equal(result.status, 1);
    assert.match(result.err, /^fieldcast: two\/b\.json:2:12: no file has the primitive "Spere"/m);
    assert.equal(fs.existsSync(path.join(folder, 'y.json')), false);
    assert.match(run(['import', 'nowhere', '-o', 'y.json']).err, /nowhere: No such file/);
    assert.equal(run(['import', 'two']).status, 2);
});

test('shader prints the GLSL of a pass, whole', () => {
    const text = succeed(['shader', 'example:snowman']).out;
    assert.match(text, /^#version 430 core\n/);
    assert.match(text, /float map\(vec3 p0\)\n\{[^}]*sd_sphere\(/);
    assert.match(text, /void main\(\)/);
    assert.doesNotMatch(text, /#include/);
    assert.doesNotMatch(text, /void surface\(/);
    assert.match(succeed(['shader', '--pass', 'material', 'example:snowman']).out, /void surface\(/);
    assert.match(succeed(['shader', '--pass', 'sample', 'example:snowman']).out, /int trace\(/);
    const sphere = succeed(['shader', write('sphere.json', SPHERE)]).out;
    assert.notEqual(sphere, text);
    assert.equal(run(['shader', '--pass', 'colour', 'example:snowman']).status, 2);
    assert.equal(run(['shader', write('none.json', '{}')]).status, 1);
});

test('shader takes the programs that are wanted', () => {
    const tree = /float map\(vec3 p0\)/; // that of the scene, written out
    const shader = (...args) => succeed(['shader', 'example:snowman', ...args]).out;
    assert.match(shader('--programs', 'compiled'), tree);
    assert.doesNotMatch(shader('--programs', 'interpreted'), tree);
    assert.equal(run(['shader', 'example:snowman', '--programs', 'none']).status, 2);
});

test('schema is JSON with the registry in it', () => {
    const schema = JSON.parse(succeed(['schema']).out);
    assert.match(schema.$schema, /2020-12/);
    assert.ok(schema['x-fieldcast'].nodes.some((node) => node.type === 'sphere'));
});

test('render writes PNG, JPEG, NPY and HDR by the extension', () => {
    for (const [name, starts] of [
        ['a.png', '\x89PNG'],
        ['a.jpg', '\xff\xd8'],
        ['a.npy', '\x93NUMPY'],
        ['a.hdr', '#?RADIANCE'],
    ]) {
        succeed(['render', 'example:first-steps', '-o', name, ...SMALL]);
        const bytes = fs.readFileSync(path.join(folder, name));
        assert.equal(bytes.subarray(0, starts.length).toString('latin1'), starts);
    }
    assert.deepEqual(pngSize(fs.readFileSync(path.join(folder, 'a.png'))), [32, 24]);
});

test('render goes through stdin and stdout', () => {
    const file = write('sphere.json', SPHERE);
    const args = ['-o', '-', '--format', 'png', ...SMALL];
    const piped = succeed(['render', '-', ...args], { input: SPHERE, binary: true });
    assert.deepEqual(pngSize(piped.out), [32, 24]);
    const read = succeed(['render', file, ...args], { binary: true });
    assert.ok(piped.out.equals(read.out));
});

test('render shows what it is asked for', () => {
    const picture = (...args) =>
        succeed(['render', 'example:snowman', '-o', '-', '--format', 'png', ...SMALL, ...args], {
            binary: true,
        }).out.toString('base64');
    const pictures = [
        picture(),
        picture('--aov', 'depth'),
        picture('--aov', 'normal'),
        picture('--aov', 'id'),
        picture('--camera-position', '0,9,9'),
        picture('--camera-target', '3,0,0'),
        picture('--camera-fov', '80'),
    ];
    assert.equal(new Set(pictures).size, pictures.length);
    assert.equal(picture(), pictures[0], 'the same picture twice');
});

test('render cuts with a plane', () => {
    // The rows of the picture that have something in them.
    const rows = (...args) => {
        const { out } = succeed(['render', '-', '-o', '-', '--format', 'png', '--aov', 'id', ...SMALL, ...args], { input: SPHERE, binary: true });
        const { width, height, channels, pixels } = decodePng(out);
        const bytes = width * channels;
        return Array.from({ length: height }, (_, y) => y).filter((y) => pixels.subarray(y * bytes, (y + 1) * bytes).some(Boolean));
    };
    assert.deepEqual(rows(), [9, 10, 11, 12, 13, 14]);
    assert.deepEqual(rows('--section-normal', '0,1,0'), [12, 13, 14]);
    assert.deepEqual(rows('--section-offset', '0'), [12, 13, 14], 'up by default');
    assert.deepEqual(rows('--section-normal', '0,-1,0'), [9, 10, 11, 12]); // and the cut itself
    assert.deepEqual(rows('--section-normal', '0,1,0', '--section-offset', '2'), rows(), 'beyond it');
    assert.deepEqual(rows('--section-normal', '0,1,0', '--section-offset', '-2'), []);
    assert.equal(run(['render', '-', '-o', 'x.png', '--section-normal', '0,1']).status, 2);
});

test('the quality of a JPEG is that of its table', () => {
    const jpeg = (...args) => succeed(['render', 'example:csg', '-o', '-', '--format', 'jpg', ...SMALL, ...args], { binary: true }).out;
    const table = (bytes) => [...bytes.subarray(bytes.indexOf(Buffer.from([0xff, 0xdb])) + 5).subarray(0, 64)];
    assert.deepEqual(new Set(table(jpeg('--quality', '100'))), new Set([1]));
    assert.deepEqual(new Set(table(jpeg('--quality', '1'))), new Set([255]));
    assert.deepEqual(table(jpeg('--quality', '90')).slice(0, 4), [3, 2, 2, 3]);
    assert.ok(jpeg().equals(jpeg('--quality', '90')), 'by default');
    assert.equal(run(['render', 'example:csg', '-o', 'x.jpg', '--quality', '101']).status, 2);
});

test('the camera of the command line changes the document\'s', () => {
    const document = { format: 'fieldcast/1', camera: { position: [2, 1, 3] }, root: { type: 'box' } };
    const options = {
        type: 'orthographic',
        /* As far apart as the document's: shadows and edges take their scale from that. */
        position: [1.5, 2.5, 3.5],
        target: [0.5, 0.5, 0.5],
        up: [0.5, 1, 0],
        height: 2.5,
        aperture: 0.1,
        focus: 4,
    };
    const draw = (camera, ...args) => {
        const input = JSON.stringify({ ...document, camera: { ...document.camera, ...camera } });
        return succeed(['render', '-', '-o', '-', '--format', 'png', ...SMALL, ...args], { input, binary: true }).out;
    };
    const given = Object.entries(options).map(([name, value]) => `--camera-${name}=${value}`);
    assert.ok(draw({}, ...given).equals(draw(options)));
    assert.ok(draw({}, '--camera-fov', '20').equals(draw({ fov: 20 })));
    assert.ok(!draw({}).equals(draw({ fov: 20 })));
    const all = JSON.parse(succeed(['schema']).out)['x-fieldcast'].camera.map(({ name }) => name);
    assert.deepEqual([...Object.keys(options), 'fov'].sort(), all.sort());
});

test('switches are the same words as in a query', () => {
    const draw = (word) =>
        succeed(['render', 'example:first-steps', '-o', '-', '--format', 'png', ...SMALL, '--transparent', word], { binary: true }).out;
    assert.ok(draw('true').equals(draw('on')));
    assert.ok(draw('false').equals(draw('off')));
    assert.equal(decodePng(draw('true')).channels, 4);
    assert.equal(decodePng(draw('false')).channels, 3);
});

test('render puts several outputs into one file', () => {
    const aov = ['--aov', 'normal,color'];
    for (const [name, inside] of [
        ['a.zip', 'png'],
        ['a.npz', 'npy'],
    ]) {
        succeed(['render', 'example:first-steps', '-o', name, ...aov, ...SMALL]);
        const members = readZip(fs.readFileSync(path.join(folder, name)));
        assert.deepEqual(
            members.map((member) => member.name),
            [`color.${inside}`, `normal.${inside}`],
        );
        const alone = ['render', 'example:first-steps', '-o', '-', '--format', inside, '--aov', 'normal', ...SMALL];
        assert.ok(members[1].bytes.equals(succeed(alone, { binary: true }).out));
    }
    const result = run(['render', 'example:first-steps', '-o', 'a.png', ...aov, ...SMALL]);
    assert.equal(result.status, 2);
    assert.match(result.err, /--output: a\.png holds one picture; several go into a \.zip or \.npz/);
});

test('render takes a region, a level and transparency', () => {
    const render = (...args) =>
        succeed(['render', 'example:first-steps', '-o', '-', '--format', 'png', ...SMALL, ...args], {
            binary: true,
        }).out;
    const [whole, part] = [decodePng(render()), decodePng(render('--region', '8,6,10,5'))];
    assert.deepEqual([part.width, part.height], [10, 5]);
    for (let y = 0; y < 5; y += 1) {
        const from = ((6 + y) * 32 + 8) * 3;
        assert.ok(part.pixels.subarray(30 * y, 30 * y + 30).equals(whole.pixels.subarray(from, from + 30)));
    }
    assert.ok(!render('--level', 'draft').equals(render('--level', 'final')));
    assert.equal(decodePng(render('--transparent', 'on')).channels, 4);
    const jpeg = run(['render', 'example:first-steps', '-o', 'x.jpg', '--transparent', 'on', ...SMALL]);
    assert.equal(jpeg.status, 1);
    assert.match(jpeg.err, /format: JPEG holds no transparent background/);
    const outside = run(['render', 'example:first-steps', '-o', 'x.png', '--region', '30,0,3,1', ...SMALL]);
    assert.match(outside.err, /region: 30,0,3,1 is not inside of 32 x 24 pixels/);
    assert.ok(!fs.existsSync(path.join(folder, 'x.png')));
});

test('the mode of a written file is the usual one, and a failure leaves nothing', () => {
    const target = path.join(folder, 'kept.png');
    succeed(['render', 'example:first-steps', '-o', 'kept.png', ...SMALL]);
    assert.equal(fs.statSync(target).mode & 0o777, 0o666 & ~process.umask());
    const kept = fs.readFileSync(target);
    const names = fs.readdirSync(folder);
    const result = run(['render', 'absent.json', '-o', 'kept.png', ...SMALL]);
    assert.equal(result.status, 1);
    assert.match(result.err, /absent\.json: No such file/);
    assert.ok(fs.readFileSync(target).equals(kept));
    const nowhere = run(['render', 'example:first-steps', '-o', 'no/where.png', ...SMALL]);
    assert.equal(nowhere.status, 1);
    assert.match(nowhere.err, /no\/where\.png: No such file or directory/);
    assert.deepEqual(fs.readdirSync(folder), names);
});

test('render refuses what the scene would refuse', () => {
    const result = run(['render', 'example:snowmna', '-o', 'x.png']);
    assert.equal(result.status, 1);
    assert.match(result.err, /example:snowmna: is no example; did you mean "snowman"\?/);
    const fov = run(['render', 'example:snowman', '-o', 'x.png', '--camera-fov', '0']);
    assert.notEqual(fov.status, 0);
    assert.match(fov.err, /--camera-fov: /);
});

test('a GPU that is asked for and not there is an error', () => {
    const doctor = succeed(['doctor', '--port', '0']).out;
    const result = run(['render', 'example:first-steps', '-o', 'gpu.png', '--device', 'gpu', ...SMALL]);
    if (/drawn by the CPU|closed to this user/.test(doctor)) {
        assert.equal(result.status, 1);
        assert.match(result.err, /GPU|software/i);
    } else {
        assert.equal(result.status, 0, result.err);
    }
});

test('doctor says what fails', async () => {
    const good = succeed(['doctor', '--port', '0', '--data', path.join(folder, 'data')]);
    assert.match(good.out, /^ok {4}drawing .*OpenGL 4\.\d/m);
    assert.match(good.out, /^ok {4}stage .*; the device has compute and fragment shaders$/m);
    assert.match(good.out, /^ok {4}data .*will be made/m);
    assert.ok(!fs.existsSync(path.join(folder, 'data')));

    const taken = net.createServer();
    await new Promise((resolve) => taken.listen(0, '127.0.0.1', resolve));
    const port = String(taken.address().port);
    const busy = run(['doctor', '--port', port]);
    taken.close();
    assert.equal(busy.status, 1);
    assert.match(busy.out, /^FAIL {2}port .* is in use/m);

    const blocked = run(['doctor', '--port', '0', '--data', path.join(write('file', ''), 'data')]);
    assert.equal(blocked.status, 1);
    assert.match(blocked.out, /^FAIL {2}data /m);
});

const OLDER = { MESA_GL_VERSION_OVERRIDE: '3.3', MESA_GLSL_VERSION_OVERRIDE: '330' };

test('a device of OpenGL 3.3 draws by fragment shaders, if these are asked for', () => {
    const doctor = succeed(['doctor', '--port', '0', '--device', 'software'], { env: OLDER }).out;
    assert.match(doctor, /^ {6}device \d .*\(without compute shaders\): works/m);
    assert.match(doctor, /^ok {4}drawing .*OpenGL 3\.3/m);
    assert.match(doctor, /^ok {4}stage +engine; the device has fragment shaders alone/m);
    const args = ['render', 'example:first-steps', '-o', '-', '--format', 'png', '--device', 'software', ...SMALL];
    const drawn = (stage, env = {}) => succeed([...args, '--stage', stage], { binary: true, env }).out;
    assert.ok(drawn('fragment', OLDER).equals(drawn('fragment')));
    assert.ok(drawn('auto', OLDER).equals(drawn('engine')));
    const refused = run([...args, '--stage', 'compute'], { env: OLDER });
    assert.equal(refused.status, 1);
    assert.match(refused.err, /compute shaders need OpenGL 4\.3; .* has 3\.3/);
});

test('bench prints JSON of drawing, compiling, encoding and storing', () => {
    const args = ['bench', '--only', 'first-steps', '--rounds', '1', '--scale-down', '8', '--data', 'bench'];
    const { renderer, drawing, documents, edits } = JSON.parse(succeed(args).out);
    assert.ok(renderer.name);
    assert.equal(drawing.length, 1);
    const [row] = drawing;
    assert.equal(row.example, 'first-steps');
    assert.deepEqual(
        row.pictures.map(({ width, height }) => [width, height]),
        [
            [80, 45],
            [160, 90],
        ],
    );
    for (const { ms, stages_ms: stages, engine_ratio: engine, fragment_ratio: fragment } of row.pictures) {
        assert.ok(stages.shade > 0 && engine > 0 && fragment > 0);
        assert.ok(Object.values(stages).reduce((a, b) => a + b) < 1.05 * ms, 'stages are parts of the whole');
    }
    assert.ok(row.effects_off_ratio > 0);
    assert.ok(row.first_picture.cold_ms > 0 && row.first_picture.warm_ms > 0);
    assert.deepEqual(row.encoders.map(({ codec }) => codec), ['jpeg moving', 'jpeg still', 'png live', 'png file']);
    assert.ok(row.encoders.every(({ bytes }) => bytes > 0));
    assert.deepEqual(
        edits.map(({ nodes }) => nodes),
        [1, 10000],
    );
    for (const { stream_per_second, alone_p50_ms, alone_p95_ms } of edits) {
        assert.ok(stream_per_second > 0 && alone_p95_ms >= alone_p50_ms);
    }
    assert.deepEqual(
        documents.map(({ nodes }) => nodes),
        [1000, 10000, 100000],
    );
    // The sanitizers' allocator does not count.
    assert.ok(documents.every(({ parse_ms, memory_mib }) => parse_ms > 0 && memory_mib >= 0));
    const { edit_us: edit, edit_p95_us: slow } = documents[1].drawn;
    assert.ok(edit > 0 && slow >= edit);
    assert.deepEqual(fs.readdirSync(path.join(folder, 'bench')), [], 'nothing is left');
    assert.equal(run(['bench', '--only', 'nothing']).status, 2);
});

test('bench tells how the pictures of compute shaders, fragment shaders and the engine differ', () => {
    const args = ['bench', '--part', 'stages', '--only', 'first-steps', '--rounds', '1'];
    const { stages } = JSON.parse(succeed(args).out);
    const [row] = stages;
    assert.equal(stages.length, 1);
    assert.equal(row.example, 'first-steps');
    assert.ok(row.fragment_ratio > 0 && row.engine_ratio > 0);
    for (const part of [row.fragment_differs, row.engine_differs]) {
        assert.ok(part >= 0 && part < 0.01, `${part}`);
    }
});

test('a signal from the terminal, which reaches the worker too, drains', async () => {
    const args = ['serve', '--port', '0', '--data', path.join(folder, 'made/for/it')];
    const daemon = spawn(program, args, { detached: true, stdio: ['ignore', 'pipe', 'pipe'] });
    let log = '';
    daemon.stderr.on('data', (chunk) => {
        log += chunk;
    });
    const ended = new Promise((resolve) => daemon.on('close', resolve));
    await new Promise((resolve) => daemon.stdout.once('data', resolve));
    while (!log.includes('ready')) {
        await new Promise((resolve) => daemon.stderr.once('data', resolve));
    }
    process.kill(-daemon.pid, 'SIGINT');
    assert.equal(await ended, 0, log);
    assert.match(log, /draining/);
    assert.doesNotMatch(log, /too long/);
});

test('check tells how well each equation is drawn, and warns of a pole', () => {
    const wall = (equation, mode = 'solid') => ({ id: 'wall', type: 'implicit', params: { equation, mode } });
    const check = (root) => run(['check', write('wall.json', JSON.stringify({ format: 'fieldcast/1', root }))]);
    const told = (text) => [0, `wall.json: /nodes/wall/params/equation: ${text}\n`, ''];
    const parts = ({ status, out, err }) => [status, out, err];
    assert.deepEqual(parts(check(wall('x^2 + y^2 = z'))), told('exact polynomial of degree 2'));
    assert.deepEqual(parts(check(wall('y = 1/(x^2 + 0.5)'))), told('safe'));
    const double = check(wall('(sin(3*x) - y)^2 = 0'));
    assert.match(double.out, /^wall\.json: \/nodes\/wall\/params\/equation: safe, \d\d % unresolved\n$/);
    const pole = check(wall('y = 1/(x - 0.5)', 'sheet'));
    assert.deepEqual([pole.status, pole.out], [0, '']);
    assert.match(
        pole.err,
        /^fieldcast: warning: wall\.json: \/nodes\/wall\/params\/equation: unsafe: pole at \(0\.5, .*; the sign changes there and a wall is drawn\n$/,
    );
    const jump = { id: 'all', type: 'union', children: [wall('x = 0'), { ...wall('floor(x) = y'), id: 'steps' }] };
    const both = check(jump);
    assert.equal(both.out, told('exact polynomial of degree 1')[1]);
    assert.match(both.err, /\/nodes\/steps\/params\/equation: unsafe: jump at \(/);
});

test('without a graphics device the engine draws, unless one is asked for', () => {
    const args = ['render', 'example:first-steps', '-o', '-', '--format', 'png', ...SMALL];
    const drawn = succeed([...args, '--stage', 'engine'], { binary: true }).out;
    assert.ok(succeed([...args, '--device', 'none'], { binary: true }).out.equals(drawn));
    const env = { __EGL_VENDOR_LIBRARY_FILENAMES: '/dev/null' }; // no vendor's library of EGL
    const missing = succeed(args, { binary: true, env });
    assert.ok(missing.out.equals(drawn));
    assert.match(missing.err, /no device, so the engine draws: /);
    assert.match(succeed(['doctor'], { env }).out, /by the engine, without a graphics device/);
    for (const asked of [['--device', 'gpu'], ['--device', 'software'], ['--device-index', '0'], ['--stage', 'compute']]) {
        assert.equal(run([...args, ...asked], { env }).status, 1, asked.join(' '));
    }
    const shaders = run([...args, '--device', 'none', '--stage', 'fragment']);
    assert.equal(shaders.status, 1);
    assert.match(shaders.err, /shaders need a device, and none is to be opened/);
});

test('where OpenGL is too old the engine draws, and the reason is told whole', () => {
    const args = ['render', 'example:first-steps', '-o', '-', '--format', 'png', ...SMALL];
    const drawn = succeed([...args, '--device', 'none'], { binary: true }).out;
    const env = { MESA_GL_VERSION_OVERRIDE: '3.2', MESA_GLSL_VERSION_OVERRIDE: '150' };
    const old = succeed(args, { binary: true, env });
    assert.ok(old.out.equals(drawn));
    assert.match(old.err, /no device.*: no OpenGL 3\.3 core context \(\w+\), which fieldcast needs\n/);
    assert.equal(run([...args, '--stage', 'fragment'], { env }).status, 1);
});

test('serve refuses a token file that is none', () => {
    const short = run(['serve', '--port', '0', '--data', 'data', '--token-file', write('token', 'short\n')]);
    assert.equal(short.status, 2);
    assert.match(short.err, /token: the first line must be a token of 16 to 200/);
});

test('the example config file holds only what is known', () => {
    const text = fs.readFileSync(path.join(root, 'deploy/fieldcast.conf'), 'utf8');
    const settings = text.replace(/^# (?=[a-z-]+ = )/gm, '').replace(/^token-file.*\n/m, '');
    const named = text.match(/^(# )?[a-z-]+(?= = )/gm).map((line) => line.replace('# ', ''));
    const readme = fs.readFileSync(path.join(root, 'README.md'), 'utf8');
    const stored = [...readme.matchAll(/^\| `--([a-z-]+).*`FIELDCAST_/gm)]
        .map(([, name]) => name)
        .filter((name) => !['web', 'config'].includes(name));
    assert.deepEqual(named.sort(), stored.sort());
    const file = write('example.conf', settings);
    const env = { HOME: folder };
    succeed(['doctor', '--config', file, '--port', '0'], { env });
    const broken = run(['doctor', '--config', write('broken.conf', `${settings}prot = 1\n`)], { env });
    assert.equal(broken.status, 2);
    assert.match(broken.err, /broken\.conf:\d+: prot: is no option of the config file/);
});

test("README's table is that of `fieldcast help options`", () => {
    const readme = fs.readFileSync(path.join(root, 'README.md'), 'utf8');
    assert.ok(readme.includes(succeed(['help', 'options']).out), 'run: make docs');
});

test('README shows every command', () => {
    const readme = fs.readFileSync(path.join(root, 'README.md'), 'utf8');
    const [, list] = /^Commands:\n((?: {2}.*\n)+)/m.exec(succeed(['--help']).out);
    const commands = [...list.matchAll(/^ {2}(\w+)/gm)].map(([, name]) => name);
    const shown = [...readme.matchAll(/^fieldcast (\w+)/gm)].map(([, name]) => name);
    assert.deepEqual(shown.sort(), commands.sort());
});

test('the page asks for the formats that there are', () => {
    const [, formats] = /--format FORMAT.*One of ([a-z, ]+)\./.exec(succeed(['help', 'options']).out);
    const [, page] = /FORMATS = \[(.*)\] as const/.exec(fs.readFileSync(path.join(root, 'web/src/model/picture.ts'), 'utf8'));
    assert.deepEqual(page.match(/\w+/g).sort(), formats.split(', ').sort());
});
