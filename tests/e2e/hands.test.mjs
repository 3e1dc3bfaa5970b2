// SPDX-License-Identifier: MIT
// Hands in the picture: the gizmo and the keys, and what they make of the document on the server.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { ask, until } from '../support/daemon.mjs';
import { documentWhen, field, nodeIn, picture, row, SCENE, settled, useStage } from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(options) {
    id = await stage.scene();
    page = await stage.page({ scene: id, ...options });
    await settled(page);
}

/** The parts of the gizmo as the page says that it drew them. */
const parts = async () => JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');
const isPart = (motion, axis, plane = false) => (part) =>
    part.motion === motion && part.axis === axis && part.plane === plane;

/** Waits for a part and answers where it is in the window. */
async function place(motion, axis, plane) {
    const drawn = async () => (await parts()).find(isPart(motion, axis, plane));
    const { at } = await until(drawn, `the part ${motion} ${axis}`);
    const box = await picture(page).boundingBox();
    return { x: box.x + at.x, y: box.y + at.y };
}

/** Drags in steps, as a hand does; ends with the button up. */
async function drag(from, dx, dy) {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    for (let i = 1; i <= 5; i++) {
        await page.mouse.move(from.x + (dx * i) / 5, from.y + (dy * i) / 5);
    }
    await page.mouse.up();
}

const centerOf = async (locator) => {
    const box = await locator.boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
};
const select = (node) => row(page, node).click();
const placeOf = (document, node) => nodeIn(document, node).transform?.translation ?? [0, 0, 0];
const when = (holds, what) => documentWhen(stage, id, holds, what);

/** By which angle Rz·Ry·Rx turns: twice that of its quaternion's real part. */
function angleOf(rotation) {
    const product = (of) => rotation.reduce((all, angle) => all * of(angle / 2), 1);
    return 2 * Math.acos(Math.abs(product(Math.cos) + product(Math.sin)));
}

/** How often the page has begun to draw on the canvas of the hands; counted from the first call on. */
const drawings = () =>
    page.getByTestId('hands').evaluate(async (canvas) => {
        const brush = canvas.getContext('2d');
        if (canvas.drawings === undefined) {
            canvas.drawings = 0;
            brush.clearRect = (...box) => {
                canvas.drawings += 1;
                CanvasRenderingContext2D.prototype.clearRect.apply(brush, box);
            };
        }
        for (let i = 0; i < 2; i += 1) {
            await new Promise((drawn) => requestAnimationFrame(drawn));
        }
        return canvas.drawings;
    });

describe('the gizmo', () => {
    test('an arrow moves along its axis alone, as one step of undo', async () => {
        await open();
        const start = await stage.document(id);
        await select('ball');
        await drag(await place('move', 0), 120, 40);
        const moved = await when((d) => placeOf(d, 'ball')[0] > -1.3, 'a ball further right');
        const [, y, z] = placeOf(moved, 'ball');
        assert.deepEqual([y, z], [0, 0]);
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });

    test('its canvas is touched while something is on it, and once more when that goes', async () => {
        await open();
        const [x, y] = await centerOf(picture(page));
        const hover = (dx) => page.mouse.move(x + dx, y, { steps: 4 });
        await drawings();
        await hover(9);
        assert.equal(await drawings(), 0);
        await select('ball');
        await place('move', 0);
        assert.ok((await drawings()) > 0);
        await page.keyboard.press('Escape');
        await until(async () => (await parts()).length === 0, 'nothing on it');
        const gone = await drawings();
        await hover(-9);
        assert.equal(await drawings(), gone);
    });

    test('it stands where its object is seen, also after an orbit', async () => {
        await open();
        await select('ball');
        const before = await place('move', null);
        const box = await picture(page).boundingBox();
        await drag({ x: box.x + 40, y: box.y + box.height - 120 }, 150, -30);
        await settled(page);
        const now = await place('move', null);
        assert.ok(Math.hypot(now.x - before.x, now.y - before.y) > 20, 'the gizmo followed the camera');
        /* A click on the middle goes through to the picture, where the ball is. */
        await select('ring');
        await page.mouse.click(now.x, now.y);
        await page.locator('[data-node="ball"][aria-selected="true"]').waitFor();
    });

    test('a ring turns about its axis; Ctrl goes in steps of 15 degrees', async () => {
        await open();
        await select('crate');
        await page.keyboard.press('2');
        const from = await place('turn', null);
        await page.keyboard.down('Control');
        await drag(from, -60, 80);
        await page.keyboard.up('Control');
        /* Each move of the drag is an edit: the first ones may turn it by nothing. */
        const document = await when((d) => {
            const steps = Math.hypot(...nodeIn(d, 'crate').transform.rotation) / (Math.PI / 12);
            return steps > 0.9;
        }, 'a crate turned by a step');
        const { rotation, translation } = nodeIn(document, 'crate').transform;
        const steps = angleOf(rotation) / (Math.PI / 12);
        assert.ok(Math.abs(steps - Math.round(steps)) < 1e-3, `${steps} steps`);
        assert.deepEqual(translation, [1.5, 0, 0]);
    });

    test('with Ctrl, a move is drawn to the middle of another shape, or goes in steps', async () => {
        await open();
        await select('crate');
        await field(page, 'translation x').fill('1.537');
        await page.keyboard.press('Enter');
        await settled(page);
        const crate = await place('move', null);
        await select('ball');
        const ball = await place('move', null);
        const arrow = await place('move', 0);
        const [dx, dy] = [crate.x - ball.x, crate.y - ball.y];
        await page.keyboard.down('Control');
        await drag(arrow, dx + 5, dy);
        await when((d) => placeOf(d, 'ball').join() === '1.537,0,0', 'the middle of the crate');
        await page.keyboard.up('Control');
        await page.keyboard.press('Control+z');
        await when((d) => placeOf(d, 'ball')[0] === -1.5, 'the place before');
        /* The server has it before the page draws it. */
        await until(async () => {
            const now = await place('move', 0);
            return Math.hypot(now.x - arrow.x, now.y - arrow.y) < 1;
        }, 'the gizmo at the place before');
        await page.keyboard.down('Control');
        await drag(await place('move', 0), 0.6 * dx, 0.6 * dy);
        await page.keyboard.up('Control');
        const stepped = await when((d) => placeOf(d, 'ball')[0] > 0, 'the steps');
        const [x] = placeOf(stepped, 'ball');
        assert.ok(Math.abs(10 * x - Math.round(10 * x)) < 1e-9, `${x} is no step`);
    });

    test('Esc in a drag brings back what was, and leaves no step', async () => {
        await open();
        const start = await stage.document(id);
        await select('ball');
        const from = await place('move', 1);
        await page.mouse.move(from.x, from.y);
        await page.mouse.down();
        await page.mouse.move(from.x, from.y - 80, { steps: 5 });
        await when((d) => placeOf(d, 'ball')[1] > 0.2, 'a raised ball');
        await page.keyboard.press('Escape');
        await page.mouse.up();
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
        const undo = page.getByRole('button', { name: /^Undo/ }).first();
        await until(() => undo.isDisabled(), 'no step in the page');
    });

    test('a light that is chosen has one too', async () => {
        id = await stage.scene({
            format: 'fieldcast/1',
            lights: [{ id: 'lamp', type: 'point', position: [1, 1, 1] }],
            root: { id: 'root', type: 'union', children: [{ id: 'ball', type: 'sphere' }] },
        });
        page = await stage.page({ scene: id });
        await settled(page);
        await page.locator('[data-resource="lamp"] .resource-pick').click();
        await drag(await place('move', 1), 0, -60);
        await when((d) => d.lights[0].position[1] > 1.05, 'a raised lamp');
    });
});

describe('handles of parameters', () => {
    test('a radius is dragged on the surface, as one step of undo', async () => {
        await open();
        const start = await stage.document(id);
        await select('ball');
        const spot = async () => (await parts()).find(({ handle }) => handle === 'radius')?.at;
        const at = await until(spot, 'the handle of the radius');
        const box = await picture(page).boundingBox();
        await drag({ x: box.x + at.x, y: box.y + at.y }, 60, 0);
        const document = await when((d) => nodeIn(d, 'ball').params.radius > 1.2, 'a greater ball');
        assert.deepEqual(placeOf(document, 'ball'), [-1.5, 0, 0]);
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });

    test('a length is an arrow, and the arrows of the gizmo leave it room', async () => {
        await open();
        await select('crate');
        const all = await until(async () => {
            const drawn = await parts();
            return drawn.filter(({ handle }) => handle).length === 3 && drawn.some(isPart('move', 1)) && drawn;
        }, 'three handles');
        const size = all.find(({ handle }) => handle === 'size.y');
        assert.equal(size.look, 'arrow');
        const tip = all.find(isPart('move', 1)).at;
        assert.ok(Math.hypot(tip.x - size.at.x, tip.y - size.at.y) > 20, `${JSON.stringify([tip, size.at])}`);
        await select('ball');
        await until(async () => (await parts()).some(({ handle, look }) => handle === 'radius' && look === 'dot'), 'a dot');
    });
});

describe('handles of every type', () => {
    const numbers = (param) => param.main && param.handle !== undefined;
    const SHEET = { x: 's', y: 't', z: '0', s: [-1, 1], t: [-1, 1] };
    /* On the middle of the gizmo there is none. */
    const AWAY = { offset: 0.5 };
    const PARAMS = { plane: AWAY, revolve: AWAY, repeat: { count: [3, 2, -1] }, parametric: { surface: SHEET } };
    const node = ({ type, children }) => ({
        id: `the-${type}`,
        type,
        visible: false,
        params: PARAMS[type] ?? {},
        children: children === 'none' ? [] : [{ id: `below-${type}`, type: 'circle' }],
    });

    test('each main number that has a place in the registry has it in the picture', async () => {
        const { 'x-fieldcast': schema } = await ask(stage.daemon, 'GET', '/v1/schema.json');
        const types = schema.nodes.filter(({ params }) => params.some(numbers));
        id = await stage.scene({
            ...SCENE,
            camera: { position: [1.5, 1.5, 3], target: [0, 0, 0] },
            root: { id: 'root', type: 'union', children: types.map(node) },
        });
        page = await stage.page({ scene: id });
        await settled(page);
        await select('root');
        const wanted = new Map(types.map(({ type, params }) => [`the-${type}`, params.filter(numbers)]));
        const seen = new Set();
        for (let i = 0; i < 2 * types.length && seen.size < types.length; i++) {
            await page.keyboard.press('ArrowDown');
            const chosen = await page.locator('[data-node][aria-selected="true"]').getAttribute('data-node');
            for (const { name } of wanted.get(chosen) ?? []) {
                const drawn = async () => (await parts()).some(({ handle }) => handle?.split('.')[0] === name);
                await until(drawn, `a handle of ${name} at ${chosen}`);
            }
            if (wanted.has(chosen)) {
                seen.add(chosen);
            }
        }
        assert.equal(seen.size, types.length);
    });

    test('how far a shape grows is an arrow on its surface, which the pointer takes along', async () => {
        const shape = { id: 'inner', type: 'sphere', params: { radius: 0.8 } };
        id = await stage.scene({
            ...SCENE,
            root: { id: 'soft', type: 'round', params: { radius: 0.1 }, transform: { scale: 1.5 }, children: [shape] },
        });
        page = await stage.page({ scene: id });
        await settled(page);
        await select('soft');
        const arrow = async () => (await parts()).find(({ handle }) => handle === 'radius');
        const { at, look } = await until(arrow, 'a handle');
        assert.equal(look, 'arrow');
        const box = await picture(page).boundingBox();
        await drag({ x: box.x + at.x, y: box.y + at.y }, 40, 0);
        await until(async () => {
            const after = (await arrow())?.at;
            return after && Math.hypot(after.x - at.x - 40, after.y - at.y) < 2;
        }, 'an arrow that went with the pointer');
        /* The first arrow is 0.9 from the middle, in the node's own space. */
        const ball = await until(async () => (await parts()).find(isPart('move', null))?.at, 'the gizmo');
        const wanted = 0.9 * (1 + 40 / (at.x - ball.x)) - 0.8;
        await when((d) => Math.abs(nodeIn(d, 'soft').params.radius - wanted) < 0.01, `a radius of ${wanted}`);
    });
});

describe('handles of an instance', () => {
    const sets = (name, place, most) => ({ name, type: 'float', sets: `/nodes/${place}`, range: [0.1, most] });
    const POSTS = {
        ...SCENE,
        models: {
            knob: {
                params: [sets('across', 'ball-of-it/params/radius', 2)],
                root: { id: 'ball-of-it', type: 'sphere', params: { radius: 0.3 } },
            },
            post: {
                params: [sets('high', 'pole/params/size.y', 40), sets('knob', 'top/params/across', 1)],
                root: {
                    id: 'post-root',
                    type: 'group',
                    children: [
                        { id: 'pole', type: 'box', params: { size: [0.4, 1, 0.4] } },
                        { id: 'top', type: 'model', params: { model: 'knob' }, transform: { translation: [0.8, 0.2, 0] } },
                    ],
                },
            },
        },
        root: {
            ...SCENE.root,
            children: [
                { id: 'low', type: 'model', params: { model: 'post' }, material: 'clay', transform: { translation: [-2, 0, 0] } },
                { id: 'tall', type: 'model', params: { model: 'post', high: 30 }, material: 'slate', transform: { translation: [2, 0, 0] } },
            ],
        },
    };
    const handle = async (key) => {
        const found = async () => (await parts()).find((part) => part.handle === key);
        const { at, look } = await until(found, `the handle ${key}`);
        const box = await picture(page).boundingBox();
        return { x: box.x + at.x, y: box.y + at.y, look, box };
    };
    const openPosts = async (environment) => {
        id = await stage.scene({ ...POSTS, environment });
        page = await stage.page({ scene: id });
        await settled(page);
    };

    test('they are those of the parts that it sets, and set its own values', async () => {
        await openPosts();
        const start = await stage.document(id);
        await select('low');
        const high = await handle('high');
        assert.equal(high.look, 'arrow');
        await drag(high, 0, -60);
        const grown = await when((d) => nodeIn(d, 'low').params.high > 1.3, 'a higher post');
        assert.deepEqual(nodeIn(grown, 'pole', grown.models.post.root).params.size, [0.4, 1, 0.4]);
        const knob = await handle('knob');
        assert.equal(knob.look, 'dot');
        await drag(knob, 30, 0);
        await when((d) => nodeIn(d, 'low').params.knob > 0.4, 'a greater knob');
        await until(async () => {
            const after = await handle('knob');
            return Math.hypot(after.x - knob.x - 30, after.y - knob.y) < 2;
        }, 'a handle that went with the pointer');
        const document = JSON.parse(await stage.document(id));
        assert.deepEqual(nodeIn(document, 'tall').params, { model: 'post', high: 30 });
        await page.keyboard.press('Control+z');
        await page.keyboard.press('Control+z');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });

    /* Where the upper end is seen: from 0, at the top of the picture, to 1. */
    const upperEnd = async () => {
        const { y, box } = await handle('high');
        return (y - box.y) / box.height;
    };

    test('Home shows all that has an end, beside a floor', async () => {
        await openPosts({ floor: true, floor_height: -16 });
        await select('tall');
        assert.ok((await upperEnd()) < 0, 'at first it is out of sight');
        await picture(page).focus();
        await page.keyboard.press('Home');
        await until(async () => {
            const end = await upperEnd();
            return end > 0 && end < 0.12;
        }, 'the upper end near the edge');
    });

    test('F shows all of an instance, with its own values', async () => {
        await openPosts();
        const frames = async (node) => {
            await select(node);
            await picture(page).focus();
            await page.keyboard.press('f');
            await until(async () => {
                const end = await upperEnd();
                return end > 0 && end < (node === 'tall' ? 0.12 : 0.4);
            }, `the upper end of ${node}`);
        };
        await select('tall');
        assert.ok((await upperEnd()) < 0, 'at first it is out of sight');
        await frames('tall');
        /* The other is too small by now to have a handle. */
        await frames('low');
    });
});

describe('keys', () => {
    test('G X .5 Enter moves by exactly a half', async () => {
        await open();
        await select('ball');
        await picture(page).hover({ position: { x: 300, y: 300 } });
        for (const key of ['g', 'x', '.', '5', 'Enter']) {
            await page.keyboard.press(key);
        }
        const document = await when((d) => placeOf(d, 'ball')[0] !== -1.5, 'a moved ball');
        assert.deepEqual(placeOf(document, 'ball'), [-1, 0, 0]);
    });

    test('R Y 30 Enter turns by 30 degrees, S 2 Enter doubles', async () => {
        await open();
        await select('crate');
        await picture(page).hover({ position: { x: 300, y: 300 } });
        for (const key of ['r', 'y', '3', '0', 'Enter', 's', '2', 'Enter']) {
            await page.keyboard.press(key);
        }
        const document = await when((d) => nodeIn(d, 'crate').transform.scale !== undefined, 'a doubled crate');
        const { rotation, scale } = nodeIn(document, 'crate').transform;
        assert.ok(Math.abs(rotation[1] - Math.PI / 6) < 1e-6, `${rotation}`);
        assert.deepEqual([rotation[0], rotation[2]], [0, 0]);
        assert.deepEqual(scale, [2, 2, 2]);
    });

    test('Ctrl+Z, Delete and the wheel do nothing to what G holds', async () => {
        await open();
        await select('crate');
        await field(page, 'translation x').fill('1.25');
        await page.keyboard.press('Enter');
        await settled(page);
        const start = await stage.document(id);
        await select('ball');
        const box = await picture(page).boundingBox();
        await page.mouse.move(box.x + 300, box.y + 300);
        await page.keyboard.press('g');
        await page.keyboard.press('Control+z');
        await page.keyboard.press('Delete');
        await page.mouse.wheel(0, -240);
        await page.mouse.move(box.x + 380, box.y + 260, { steps: 4 });
        await when((d) => placeOf(d, 'ball')[0] > -1.4, 'a ball at the pointer');
        await page.getByText('Let go first').waitFor();
        await page.keyboard.press('Escape');
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });

    test('a press beside the picture ends what G took where it is', async () => {
        await open();
        await select('ball');
        const box = await picture(page).boundingBox();
        await page.mouse.move(box.x + 300, box.y + 300);
        await page.keyboard.press('g');
        await page.mouse.move(box.x + 380, box.y + 260, { steps: 4 });
        await when((d) => placeOf(d, 'ball')[0] > -1.4, 'a ball at the pointer');
        const filter = page.getByRole('textbox', { name: 'Filter nodes' });
        await filter.click();
        await filter.pressSequentially('12');
        assert.equal(await filter.inputValue(), '12');
        await settled(page);
        const left = await stage.document(id);
        await page.mouse.move(box.x + 200, box.y + 200, { steps: 4 });
        await settled(page);
        assert.equal(await stage.document(id), left);
        await page.getByRole('button', { name: 'Undo move ball' }).waitFor();
    });

    test('the pointer moves what G took; a right click gives it back', async () => {
        await open();
        const start = await stage.document(id);
        await select('ball');
        const box = await picture(page).boundingBox();
        await page.mouse.move(box.x + 300, box.y + 300);
        await page.keyboard.press('g');
        await page.mouse.move(box.x + 380, box.y + 260, { steps: 4 });
        await when((d) => placeOf(d, 'ball')[0] > -1.4, 'a ball at the pointer');
        await page.mouse.click(box.x + 380, box.y + 260, { button: 'right' });
        await until(async () => (await stage.document(id)) === start, 'the document as it was');
    });
});

describe('what stands in the scene and is not seen', () => {
    const LAMP = {
        ...SCENE,
        lights: [...SCENE.lights, { id: 'lamp', type: 'point', position: [0, 1, 1], intensity: 5 }],
    };

    test('a light has an icon; a click chooses it, and the gizmo moves it', async () => {
        id = await stage.scene(LAMP);
        page = await stage.page({ scene: id });
        await settled(page);
        const mark = page.locator('[data-mark="lights/lamp"]');
        await mark.click();
        await page.locator('[data-resource=lamp][data-selected]').waitFor();
        const before = await mark.boundingBox();
        await drag(await place('move', 0), 90, 0);
        const moved = await when((d) => d.lights[1].position[0] > 0.5, 'a lamp further right');
        assert.deepEqual(moved.lights[1].position.slice(1), [1, 1]);
        await until(async () => (await mark.boundingBox()).x > before.x + 60, 'the icon goes along');
        await page.keyboard.press('Control+k');
        await page.keyboard.type('lights, volumes and camera');
        await page.keyboard.press('Enter');
        await mark.waitFor({ state: 'detached' });
    });

    test('the camera has an icon once the view is another, and a gizmo that moves it with its target', async () => {
        id = await stage.scene({ ...SCENE, camera: { position: [0, 1, 3], target: [0, 0, 0] } });
        page = await stage.page({ scene: id });
        await settled(page);
        const mark = page.locator('[data-mark="camera"]');
        assert.equal(await mark.isVisible(), false);
        await page.locator('[data-view="right"]').click();
        await picture(page).focus();
        for (let i = 0; i < 24; i += 1) {
            await page.keyboard.press('-');
        }
        await settled(page);
        await mark.click();
        const before = await stage.document(id);
        await drag(await place('move', 1), 0, -50);
        const { camera } = await when((d) => d.camera.position[1] > 1.1, 'a raised camera');
        assert.deepEqual([camera.position[0], camera.position[2]], [0, 3]);
        assert.ok(Math.abs(camera.position[1] - 1 - camera.target[1]) < 1e-5, `${camera.target}`);
        await page.getByRole('button', { name: 'Undo move camera' }).click();
        await until(async () => (await stage.document(id)) === before, 'the camera where it was');
    });

    test('a click on an end of the axes looks from there', async () => {
        await open();
        const ball = page.getByRole('group', { name: 'Views along the axes' });
        const end = (view) => ball.locator(`[data-view="${view}"]`);
        await end('right').click();
        const middle = async () => {
            const [a, b] = [await ball.boundingBox(), await end('right').boundingBox()];
            return Math.hypot(a.x + a.width / 2 - b.x - b.width / 2, a.y + a.height / 2 - b.y - b.height / 2);
        };
        await until(async () => (await middle()) < 2, 'the end of X in the middle');
        await settled(page);
        /* From the right, the crate hides what is behind it: its face fills the middle. */
        await page.mouse.click(...(await centerOf(picture(page))));
        await page.locator('[data-node="crate"][aria-selected="true"]').waitFor();
    });
});
