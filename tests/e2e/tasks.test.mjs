// SPDX-License-Identifier: MIT
// What somebody comes to do, from the first act to the last, with all that may be asked of it.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { violationsOf } from './axe.mjs';
import { openScreen } from './screens/screen.mjs';
import {
    carry,
    closePage,
    difference,
    documentWhen,
    dragBy,
    field,
    nodeIn,
    picture,
    row,
    SCENE,
    settled,
    stillPixels,
    useStage,
    waitForSaved,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(document, options) {
    id = await stage.scene(document);
    page = await stage.page({ scene: id, ...options });
    await settled(page);
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const press = async (...keys) => {
    for (const key of keys) {
        await page.keyboard.press(key);
    }
};
const idOfPage = () => new URL(page.url()).pathname.split('/').at(-1);
const allOf = (node, type) => [node, ...(node.children ?? []).flatMap((child) => allOf(child, type))].filter((one) => one.type === type);

const scaleOf = ({ transform }) => [transform?.scale ?? 1].flat()[0];

/** The parts of the gizmo and the handles, in pixels of the window. */
async function grip(isIt, what) {
    const parts = async () => JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');
    await settled(page);
    await until(async () => (await parts()).some(isIt), what);
    const { at } = (await parts()).find(isIt);
    const box = await picture(page).boundingBox();
    return { x: box.x + at.x, y: box.y + at.y };
}

async function dragTo(from, x, y) {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(x, y, { steps: 8 });
    await page.mouse.up();
}

describe('a snowman from an empty scene', () => {
    const MOST_ACTS = 19;

    test(`takes at most ${MOST_ACTS} acts of a pointer`, async () => {
        page = await stage.page({ width: 1440, height: 900 });
        await page.getByRole('button', { name: 'New scene' }).first().click();
        await page.locator('[role=treeitem]').first().waitFor();
        id = idOfPage();
        let acts = 1;
        const act = async (what) => {
            acts += 1;
            await what;
        };
        const tile = (type) => page.locator(`[role=option][data-type=${type}]`).first();
        /** By parts of the picture's width and height. */
        const spot = async (x, y) => {
            const box = await picture(page).boundingBox();
            return { x: box.x + box.width * x, y: box.y + box.height * y };
        };
        const add = async (type, way, at) => {
            await act(page.keyboard.press('Shift+A'));
            await tile(type).waitFor();
            if (way) {
                await act(page.locator(`[data-way=${way}]`).click());
            }
            await act(at ? carry(page, tile(type), at) : tile(type).click());
            await settled(page);
        };
        await add('sphere');
        await when((d) => allOf(d.root, 'sphere').length === 1, 'the body');
        await add('sphere', 'blend', await spot(0.5, 0.345));
        const two = await when((d) => allOf(d.root, 'sphere').length === 2, 'the head');
        assert.equal(allOf(two.root, 'smooth_union').length, 1);
        const radius = await grip((part) => part.handle === 'radius', 'the handle of the radius');
        const middle = await grip((part) => part.motion === 'move' && part.axis === null, 'the middle');
        await act(dragTo(radius, middle.x + 0.65 * (radius.x - middle.x), middle.y + 0.65 * (radius.y - middle.y)));
        await when((d) => allOf(d.root, 'sphere')[1].params?.radius < 0.4, 'a smaller head');
        await act(row(page, 'smooth_union-1').click());
        await act(dragBy(page, field(page, 'smoothness'), 60, 0));
        await when((d) => allOf(d.root, 'smooth_union')[0].params?.k > 0.1, 'a smoother neck');
        await add('cone', 'union', await spot(0.5, 0.33));
        await when((d) => allOf(d.root, 'cone').length === 1, 'a nose');
        await act(dragBy(page, field(page, 'scale'), -70, 0));
        await when((d) => scaleOf(allOf(d.root, 'cone')[0]) < 0.6, 'a smaller nose');
        await act(page.getByRole('button', { name: 'Add a material' }).click());
        await act(page.locator('[data-preset=ceramic]').dragTo(row(page, 'root')));
        const made = await when((d) => d.root.material?.startsWith('ceramic'), 'a white snowman');
        assert.ok(acts <= MOST_ACTS, `${acts} acts`);
        const [body, head] = allOf(made.root, 'sphere');
        assert.ok(head.transform.translation[1] > 0.3, `${JSON.stringify([body, head])}`);
        await settled(page);
        if (process.env.SNOWMAN_PICTURE) {
            await page.screenshot({ path: process.env.SNOWMAN_PICTURE });
        }
    });

    test('takes keys alone, from the start page on', async () => {
        page = await stage.page();
        await page.locator('[data-example]').first().waitFor();
        const start = page.getByRole('button', { name: 'New scene' }).first();
        await until(async () => {
            await page.keyboard.press('Tab');
            return start.evaluate((one) => one === document.activeElement);
        }, 'the focus on New scene');
        await page.keyboard.press('Enter');
        await page.locator('[role=treeitem]').first().waitFor();
        id = idOfPage();
        const add = async (words, type) => {
            await page.keyboard.press('Shift+A');
            await page.getByRole('combobox').waitFor();
            await page.keyboard.type(words);
            await page.locator(`[role=option][data-type=${type}][aria-selected=true]`).waitFor();
            await page.keyboard.press('Enter');
        };
        await add('ball', 'sphere');
        await row(page, 'sphere-1').and(page.locator('[aria-selected=true]')).waitFor();
        await add('ball', 'sphere');
        await row(page, 'sphere-2').and(page.locator('[aria-selected=true]')).waitFor();
        await settled(page);
        await press('g', 'y', '.', '7', 'Enter', 's', '.', '6', 'Enter');
        await when((d) => scaleOf(nodeIn(d, 'sphere-2')) === 0.6, 'the head');
        await page.keyboard.press('Control+a');
        await press('b');
        const made = await when((d) => allOf(d.root, 'smooth_union').length === 1, 'the neck');
        assert.deepEqual(nodeIn(made, 'sphere-2').transform.translation, [0, 0.7, 0]);
    });
});

describe('exact moves', () => {
    test('a half along an axis: the gizmo and G X .5 Enter make the same document', async () => {
        await open();
        await row(page, 'ball').click();
        const arrow = await grip((part) => part.motion === 'move' && part.axis === 0 && !part.plane, 'the arrow');
        const box = await picture(page).boundingBox();
        const half = (0.5 * box.height) / 2 / Math.tan(Math.PI / 8) / Math.hypot(1.5, 7);
        await press('Shift+M');
        await dragTo(arrow, arrow.x + half, arrow.y);
        await when((d) => nodeIn(d, 'ball').transform.translation.join() === '-1,0,0', 'a half to the right');
        await waitForSaved(page);
        const byGizmo = await stage.document(id);
        await closePage(page);

        await open();
        await row(page, 'ball').click();
        await picture(page).hover();
        await press('g', 'x', '.', '5', 'Enter');
        await when((d) => nodeIn(d, 'ball').transform.translation[0] === -1, 'the same by keys');
        await waitForSaved(page);
        assert.equal(await stage.document(id), byGizmo);
    });

    test('30 degrees about the own axis in a turned parent', async () => {
        const document = structuredClone(SCENE);
        document.root.children[2].transform = { rotation: [0.4, -0.3, 0.8], scale: 0.5 };
        await open(document);
        await row(page, 'ring').click();
        await picture(page).hover();
        await press('l');
        await page.locator('.hand-tools-space').getByText('Local').waitFor();
        await press('r', 'y', '3', '0', 'Enter');
        // The ring follows what is typed: 3 degrees first.
        const isTurned = ({ rotation }) => rotation?.every((angle, i) => Math.abs(angle - [0, Math.PI / 6, 0][i]) < 1e-6);
        await when((d) => isTurned(nodeIn(d, 'ring').transform), 'a turned ring');
        for (const [axis, shown] of [['x', '0°'], ['y', '30°'], ['z', '0°']]) {
            await until(async () => (await field(page, `rotation ${axis}`).inputValue()) === shown, `${axis}: ${shown}`);
        }
    });
});

test('a whole drag of a colour is one step back, and one forward', async () => {
    await open();
    const start = await stage.document(id);
    await page.locator('[data-resource=clay] .resource-pick').click();
    await page.locator('[data-param=diffuse] .colour-button').click();
    const area = page.locator('.react-colorful__saturation');
    const box = await area.boundingBox();
    await dragTo({ x: box.x + 20, y: box.y + 20 }, box.x + box.width - 25, box.y + box.height / 2);
    await page.keyboard.press('Escape');
    await page.locator('.react-colorful').waitFor({ state: 'detached' });
    await until(async () => (await stage.document(id)) !== start, 'another colour');
    await waitForSaved(page);
    const dragged = await stage.document(id);
    await page.keyboard.press('Control+z');
    await until(async () => (await stage.document(id)) === start, 'every byte as it was');
    const undo = page.getByRole('button', { name: /^Undo/ }).first();
    await until(() => undo.isDisabled(), 'no other step');
    await page.keyboard.press('Control+Shift+z');
    await until(async () => (await stage.document(id)) === dragged, 'every byte as it was dragged');
});

describe('errors of a shader', () => {
    const LOSS = 48;
    const LINES = [
        'vec3 shade(FragmentProperties properties) {',
        '    vec3 p = properties.world_position;',
        '    float wave = sin(p.x * 3.0);',
        '    float other = cos(p.y * 2.0);',
        '    vec3 low = vec3(0.2, 0.3, 0.4);',
        '    vec3 high = vec3(0.9, 0.8, 0.6);',
        '    float share = clamp(wave * other, 0.0, 1.0);',
        '    return mix(low, high, share);',
        '}',
    ];
    /* What a hand may type at the end of a line, and what is wrong with it. */
    const FAULTS = [' float q = nope;', ' 1 +;', ' vec2 v = vec3(1.0);', ' mixx(1.0, 2.0, 0.5);', ' wave = low;'];

    test('20 of them stand at their lines; the picture, the cursor and the typing stay', async () => {
        await open({
            ...SCENE,
            shaders: { own: { properties: [], code: LINES.join('\n') } },
            materials: { ...SCENE.materials, clay: { shader: 'own' } },
        });
        await page.locator('[data-resource=own] .resource-pick').click();
        await page.getByRole('button', { name: 'Edit code' }).click();
        const panel = page.getByTestId('code');
        await panel.locator('.code-state[data-good]').waitFor();
        await settled(page);
        const before = await stillPixels(page);
        await panel.locator('.cm-content').click();
        const markers = () =>
            panel.locator('.cm-lint-marker-error').evaluateAll((all) =>
                all.map((one) => {
                    const { top } = one.getBoundingClientRect();
                    const numbers = [...document.querySelectorAll('.cm-lineNumbers .cm-gutterElement')];
                    return Number(numbers.find((number) => Math.abs(number.getBoundingClientRect().top - top) < 12)?.textContent);
                }),
            );
        let state = 7;
        const next = (count) => (state = (state * 48271) % 2147483647) % count;
        for (let i = 0; i < 20; i += 1) {
            const line = 2 + next(LINES.length - 3);
            const fault = FAULTS[next(FAULTS.length)];
            await page.keyboard.press('Control+Home');
            for (let down = 1; down < line; down += 1) {
                await page.keyboard.press('ArrowDown');
            }
            await page.keyboard.press('End');
            await page.keyboard.insertText(fault);
            const told = `${fault} in line ${line}`;
            await until(async () => (await markers()).join() === String(line), `the mark of${told}`);
            await page.locator('[data-resource=clay], [data-resource=own]').locator('.tree-error').first().waitFor();
            assert.equal(await panel.locator('.cm-activeLineGutter').first().textContent(), String(line), told);
            if (i % 5 === 0) {
                assert.ok(difference(await stillPixels(page), before) < LOSS, `the last good picture, with${told}`);
            }
            for (let back = 0; back < fault.length; back += 1) {
                await page.keyboard.press('Backspace');
            }
            await panel.locator('.code-state[data-good]').waitFor();
            await when((d) => d.shaders.own.code === LINES.join('\n'), `the mended text, after${told}`);
            assert.deepEqual(await markers(), []);
            await settled(page);
        }
        await page.locator('.tree-error').first().waitFor({ state: 'detached' });
    });
});

test('with 100 ms round trip what is drawn over a moving picture stands where the picture shows it', async () => {
    /* One in each quarter of the picture. */
    const corners = { a: [-2, 1.2, 0], b: [2, 1.2, 0], c: [-2, -1.2, 0.5], d: [2, -1.2, -0.5] };
    const each = (make) => Object.keys(corners).map(make);
    const document = {
        format: 'fieldcast/1',
        camera: { position: [0, 0, 9], target: [0, 0, 0] },
        environment: { type: 'solid', color: [0, 0, 0] },
        lights: each((key) => ({ id: key, type: 'point', position: corners[key], intensity: 0 })),
        materials: { bright: { shader: 'unlit', properties: { color: [0.4, 0.4, 0.4] } } },
        render: { samples: 1 },
        root: {
            id: 'root',
            type: 'union',
            material: 'bright',
            children: each((key) => ({ id: `ball-${key}`, type: 'sphere', params: { radius: 0.3 }, transform: { translation: corners[key] } })),
        },
    };
    page = await openScreen(stage, { scene: document, tampered: true, delay: 50 }, { theme: 'dark', width: 1100, height: 700 });
    await settled(page);
    await page.locator('[data-mark="lights/d"]').waitFor({ state: 'attached' }); // it comes later than the picture
    await page.evaluate((keys) => {
        const canvas = document.querySelector('.view-picture > canvas');
        const copy = document.createElement('canvas');
        const brush = copy.getContext('2d', { willReadFrequently: true });
        const middles = () => {
            Object.assign(copy, { width: canvas.width, height: canvas.height });
            brush.drawImage(canvas, 0, 0);
            const { data, width, height } = brush.getImageData(0, 0, canvas.width, canvas.height);
            const sums = keys.map(() => [0, 0, 0]);
            for (let i = 0; i < data.length; i += 4) {
                const weight = Math.max(0, data[i + 1] - 12);
                if (weight > 0) {
                    const [x, y] = [(i / 4) % width, Math.floor(i / 4 / width)];
                    const sum = sums[Number(2 * x > width) + 2 * Number(2 * y > height)];
                    sum[0] += weight * (x + 0.5);
                    sum[1] += weight * (y + 0.5);
                    sum[2] += weight;
                }
            }
            return sums.map(([x, y, weight]) => [x / weight, y / weight]);
        };
        const marks = () =>
            keys.map((key) => document.querySelector(`[data-mark="lights/${key}"]`).style.translate.split(' ').map(parseFloat));
        window.samples = [];
        window.look = () => {
            const { state } = document.querySelector('[data-testid=state]').dataset;
            window.samples.push({ shown: middles(), drawn: marks(), state });
            window.looking = requestAnimationFrame(window.look);
        };
    }, Object.keys(corners));
    await page.evaluate(() => window.look());
    await dragBy(page, picture(page), 40, 12, { steps: 60 });
    await settled(page);
    const samples = await page.evaluate(() => {
        cancelAnimationFrame(window.looking);
        return window.samples;
    });
    const apart = ({ shown, drawn }) => Math.max(...shown.map(([x, y], i) => Math.hypot(x - drawn[i][0], y - drawn[i][1])));
    const picturesOf = (list) => new Set(list.map(({ shown }) => String(shown))).size;
    assert.ok(picturesOf(samples.filter(({ state }) => state === 'moving')) > 3, 'several pictures of the motion');
    /* Each picture, from the animation frame after the one that it came in. */
    const still = samples.filter(({ shown }, i) => i > 0 && String(shown) === String(samples[i - 1].shown));
    const worst = still.reduce((a, b) => (apart(a) > apart(b) ? a : b));
    console.log(`# ${samples.length} animation frames, ${picturesOf(samples)} pictures, at most ${apart(worst).toFixed(2)} px apart`);
    /* A pixel of a moving picture is several pixels wide, which moves the middles of balls by as much. */
    assert.ok(apart(worst) <= 2, JSON.stringify(worst));
});

describe('by keys alone', () => {
    for (const width of [1200, 320]) {
        test(`a number and an order are changed, names are told, ${width} px`, async () => {
            id = await stage.scene();
            page = await stage.page({ scene: id, width, height: 760 });
            await settled(page);
            const focused = () => page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? document.activeElement.innerText);
            const inTree = () => page.evaluate(() => document.activeElement.closest('[role=tree]') !== null);
            await until(async () => {
                await page.keyboard.press('Tab');
                return inTree();
            }, 'the focus in the tree');
            await page.keyboard.press('Home');
            await press('ArrowDown');
            await row(page, 'ball').and(page.locator('[aria-selected=true]')).waitFor();
            await press('Alt+ArrowDown');
            await when((d) => d.root.children.map((one) => one.id).join() === 'crate,ball,pair', 'the order');

            const editTab = page.getByRole('tab', { name: 'Edit', exact: true });
            const radius = field(page, 'radius');
            const onto = async (locator, what) =>
                until(async () => {
                    await page.keyboard.press('Tab');
                    return (await locator.count()) > 0 && locator.evaluate((one) => one === document.activeElement);
                }, what);
            if (width < 800) {
                await until(async () => {
                    await page.keyboard.press('Shift+Tab');
                    return page.evaluate(() => document.activeElement.getAttribute('role') === 'tab');
                }, 'the tabs of the sheet');
                await press('ArrowRight');
                if ((await radius.count()) === 0) {
                    await press('Enter');
                }
                assert.equal(await editTab.getAttribute('aria-selected'), 'true');
            }
            await onto(radius, 'the focus in the field of the radius');
            await page.keyboard.press('Control+a');
            await page.keyboard.type('1/3');
            await page.keyboard.press('Enter');
            await when((d) => nodeIn(d, 'ball').params.radius === 0.333333, 'a third');
            assert.equal(await focused(), 'radius');
            const names = await page.getByTestId('inspector').ariaSnapshot();
            for (const name of ['spinbutton "radius"', 'spinbutton "translation x"', 'spinbutton "rotation y"']) {
                assert.ok(names.includes(name), `${name} in\n${names}`);
            }
            assert.deepEqual(await violationsOf(page), []);
        });
    }

    test('Tab goes through the whole page and out of it: nothing holds the focus', async () => {
        await open();
        await row(page, 'ball').click();
        const seen = [];
        const here = () =>
            page.evaluate(() => {
                const one = document.activeElement;
                window.tabbed ??= [];
                const known = window.tabbed.indexOf(one);
                if (known < 0) {
                    window.tabbed.push(one);
                }
                return { known, body: one === document.body, region: one.closest('[data-region]')?.dataset.region ?? null };
            });
        for (let i = 0; i < 300; i += 1) {
            await page.keyboard.press('Tab');
            const { known, body, region } = await here();
            if (known === 0) {
                break;
            }
            assert.ok(known < 0, `the focus goes round at ${JSON.stringify(seen.slice(-3))}`);
            seen.push(body ? null : region);
        }
        const order = seen.filter((region, i) => region !== null && region !== seen[i - 1]);
        assert.deepEqual([...new Set(order)].sort(), ['Inspector', 'Picture', 'Scene', 'Status', 'Tools']);
    });
});
