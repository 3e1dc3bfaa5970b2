// SPDX-License-Identifier: MIT
// The command line as a user meets it: output, exit status, and what is left on disk.
import assert from 'node:assert';
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';

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
    for (const command of ['serve', 'render', 'check', 'import', 'schema', 'doctor', 'bench']) {
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

test('every example is right', () => {
    const examples = fs
        .readdirSync(path.join(root, 'protocol/examples'))
        .filter((name) => name.endsWith('.json'));
    assert.ok(examples.length >= 8);
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

test('schema is JSON with the registry in it', () => {
    const schema = JSON.parse(succeed(['schema']).out);
    assert.match(schema.$schema, /2020-12/);
    assert.ok(schema['x-fieldcast'].nodes.some((node) => node.type === 'sphere'));
});

test('render writes PNG, JPEG and NPY by the extension', () => {
    for (const [name, starts] of [
        ['a.png', '\x89PNG'],
        ['a.jpg', '\xff\xd8'],
        ['a.npy', '\x93NUMPY'],
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
        picture('--position', '0,9,9'),
        picture('--target', '3,0,0'),
        picture('--fov', '80'),
    ];
    assert.equal(new Set(pictures).size, pictures.length);
    assert.equal(picture(), pictures[0], 'the same picture twice');
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
    const fov = run(['render', 'example:snowman', '-o', 'x.png', '--fov', '0']);
    assert.notEqual(fov.status, 0);
    assert.match(fov.err, /--fov: /);
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

test('bench prints JSON of drawing, compiling, encoding and storing', () => {
    const args = ['bench', '--only', 'first-steps', '--rounds', '1', '--data', 'bench'];
    const { renderer, drawing, documents, edits } = JSON.parse(succeed(args).out);
    assert.ok(renderer.name);
    assert.equal(drawing.length, 1);
    const [row] = drawing;
    assert.equal(row.example, 'first-steps');
    assert.deepEqual(
        row.pictures.map(({ width, height }) => [width, height]),
        [
            [640, 360],
            [1280, 720],
        ],
    );
    for (const { ms, stages_ms: stages, ...ways } of row.pictures) {
        assert.ok(stages.march > 0 && stages.shadow > 0 && stages.shade > 0);
        assert.ok(Math.abs(ways.from_camera_ratio - ways.from_camera_ms / ways.by_passes_ms) < 0.01);
        assert.ok(Object.values(stages).reduce((a, b) => a + b) < 1.05 * ms, 'stages are parts of the whole');
    }
    // The example has nothing that mirrors, so both are the same picture; ratios of noise are wide.
    assert.ok(row.effects_off_ratio > 0.2 && row.effects_off_ratio < 5);
    assert.ok(row.first_picture.cold_ms > 0 && row.first_picture.warm_ms > 0);
    assert.ok(row.encoders.length >= 3 && row.encoders.every(({ bytes }) => bytes > 0));
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
    assert.deepEqual(fs.readdirSync(path.join(folder, 'bench')), [], 'nothing is left');
    assert.equal(run(['bench', '--only', 'nothing']).status, 2);
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

test('serve refuses a token file that is none', () => {
    const short = run(['serve', '--port', '0', '--data', 'data', '--token-file', write('token', 'short\n')]);
    assert.equal(short.status, 2);
    assert.match(short.err, /token: the first line must be a token of 16 to 200/);
});

test('the example config file holds only what is known', () => {
    const text = fs.readFileSync(path.join(root, 'deploy/fieldcast.conf'), 'utf8');
    const settings = text.replace(/^# (?=[a-z-]+ = )/gm, '').replace(/^token-file.*\n/m, '');
    assert.ok(settings.match(/^[a-z-]+ = /gm).length >= 8);
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
