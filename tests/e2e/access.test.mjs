// SPDX-License-Identifier: MIT
// For everybody: axe finds nothing, narrow windows hold everything, keys reach every region.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { TAGS, violationsOf } from './axe.mjs';
import { check as lookAt } from './screens/checks.mjs';
import { closePage, row, SCENE, settled, useStage } from './stage.mjs';

const RULES = [...TAGS, 'best-practice'];

/** One of everything that a document can hold of its own. */
const OWN = {
    ...SCENE,
    primitives: {
        egg: {
            params: [{ name: 'radius', type: 'float', default: 0.5, range: [0, 2] }],
            code: 'float sdf(vec3 p) { return length(p) - radius; }',
        },
    },
    shaders: {
        marble: {
            properties: [{ name: 'vein', type: 'color' }],
            code: 'vec3 shade(FragmentProperties properties) { return vein; }',
        },
    },
    materials: { veined: { shader: 'marble' }, ...SCENE.materials },
    models: { pawn: { id: 'foot', type: 'cylinder' } },
    root: {
        id: 'root',
        type: 'union',
        children: [
            { id: 'it', type: 'field', params: { primitive: 'egg' }, material: 'veined' },
            { id: 'one', type: 'model', params: { model: 'pawn' } },
            { id: 'solid', type: 'extrude', children: [{ id: 'shape', type: 'polygon' }] },
        ],
    },
};

let scene;
const stage = useStage({ driver: 'null', coarse: true }, async () => {
    scene = await stage.scene();
});

/** Themes differ by their colours alone: the light one is looked at for these. */
async function check(page, what, without = []) {
    assert.deepEqual(await violationsOf(page, { tags: RULES, without }), [], what);
    await page.emulateMedia({ colorScheme: 'light' });
    assert.deepEqual(await violationsOf(page, { rules: ['color-contrast'] }), [], `${what}, light`);
    await page.emulateMedia({ colorScheme: 'dark' });
}

describe('axe finds nothing', () => {
    test('start page', async () => {
        const page = await stage.page();
        await page.locator('[data-example]').first().waitFor();
        await page.locator('[data-scene]').first().waitFor();
        await check(page, 'start page');
        await closePage(page);
    });

    test('editor with a node, a material, a light, the camera', async () => {
        const page = await stage.page({ scene });
        await settled(page);
        await check(page, 'nothing selected');
        await row(page, 'ball').click();
        await page.getByTestId('inspector').waitFor();
        await check(page, 'a node');
        await page.locator('[data-resource=clay] .resource-pick').click();
        await check(page, 'a material');
        await page.locator('[data-resource=sun] .resource-pick').click();
        await check(page, 'a light');
        await page.getByRole('button', { name: 'Camera', exact: true }).click();
        await check(page, 'the camera');
        await closePage(page);
    });

    test('the equation of a parametric surface, found and refused', async () => {
        const document = { format: 'fieldcast/1', root: { id: 'it', type: 'implicit' } };
        const page = await stage.page({ scene: await stage.scene(document) });
        page.expected = /status of 422/;
        await settled(page);
        await row(page, 'it').click();
        await page.getByRole('button', { name: 'From a parametric surface' }).click();
        await page.getByText('proved to be exact').waitFor();
        await check(page, 'an equation that is found');
        await page.getByRole('textbox', { name: 'z =' }).fill('t+');
        await page.getByRole('dialog').locator('mark').waitFor();
        await check(page, 'an error in a part');
        await closePage(page);
    });

    test('volumes, backdrop, render, another output, a picture as a file', async () => {
        const misty = {
            ...SCENE,
            volumes: [{ id: 'mist', type: 'box' }],
            environment: { type: 'image', fog: 0.01, floor: true },
        };
        const page = await stage.page({ scene: await stage.scene(misty) });
        await settled(page);
        await page.locator('[data-resource=mist] .resource-pick').click();
        await check(page, 'a volume');
        await page.getByRole('button', { name: 'Backdrop' }).click();
        await page.getByRole('button', { name: 'Upload …' }).waitFor();
        await check(page, 'what is around');
        await page.getByRole('button', { name: 'Render', exact: true }).click();
        await check(page, 'render');
        await page.getByTestId('outputs').click();
        await page.getByRole('menuitemradio', { name: /^Normals/ }).waitFor();
        await check(page, 'menu of outputs', ['region']);
        await page.getByRole('menuitemradio', { name: /^Normals/ }).click();
        await page.getByRole('button', { name: 'Back to the colours' }).waitFor();
        await page.getByRole('menu').waitFor({ state: 'detached' });
        await check(page, 'another output');
        await page.keyboard.press('Control+Shift+S');
        await page.getByRole('dialog').waitFor();
        await check(page, 'a picture as a file');
        await closePage(page);
    });

    test('models, primitives, shaders and their code; points', async () => {
        const own = await stage.scene(OWN);
        const page = await stage.page({ scene: own });
        await settled(page);
        await page.locator('[data-resource=egg] .resource-pick').click();
        await page.getByRole('button', { name: 'More of radius' }).click();
        await page.getByRole('spinbutton', { name: 'default of radius' }).waitFor();
        await check(page, 'a primitive');
        await page.getByRole('button', { name: 'Edit code' }).click();
        await page.locator('.cm-content').click();
        await page.keyboard.press('Control+a');
        await page.keyboard.insertText('float sdf(vec3 p) {\n    return 1 +;\n}');
        await page.getByTestId('broken').waitFor();
        await check(page, 'code with an error');
        await page.locator('.cm-content').click();
        await page.keyboard.press('Control+z');
        await page.getByTestId('broken').waitFor({ state: 'detached' });
        await page.locator('[data-resource=veined] .resource-pick').click();
        await check(page, 'a material of a shader of the scene');
        await page.locator('[data-resource=pawn] .resource-pick').click();
        await check(page, 'a model');
        await row(page, 'one').click();
        await check(page, 'an instance');
        await row(page, 'shape').click();
        await page.getByRole('button', { name: /^point 1:/ }).waitFor();
        await check(page, 'points');
        await closePage(page);
    });

    test('gallery of materials', async () => {
        const page = await stage.page({ scene });
        await settled(page);
        await row(page, 'ball').click();
        await page.locator('[data-param=material]').getByRole('button', { name: 'New material' }).click();
        await page.locator('.gallery-tile').first().waitFor();
        /* What floats may lie over parts of controls. */
        await check(page, 'gallery', ['region', 'target-size']);
        await page.keyboard.press('Escape');
        await closePage(page);
    });

    test('graph', async () => {
        const page = await stage.page({ scene: await stage.scene(), height: 1000 });
        await settled(page);
        await page.keyboard.press('Alt+1');
        await page.locator('[data-card="root"]').waitFor();
        await check(page, 'the graph');
        await row(page, 'ball').click();
        await page.locator('[data-card="ball"][data-selected]').waitFor();
        await check(page, 'a card that is selected');
        await page.getByRole('button', { name: 'Fold pair' }).click();
        await page.locator('[data-card="ring"]').waitFor({ state: 'detached' });
        await page.getByRole('button', { name: 'Reduce' }).click();
        await page.getByRole('button', { name: 'Reduce' }).click();
        await page.getByRole('button', { name: 'Reduce' }).click();
        await page.locator('.graph-flow[data-far="2"]').waitFor();
        await check(page, 'cards from afar');
        await closePage(page);
    });

    test('palettes, keys, statistics, menus', async () => {
        const page = await stage.page({ scene });
        await settled(page);
        for (const keys of ['Shift+A', 'Control+k', '?', 'F1']) {
            await page.keyboard.press(keys);
            await page.getByRole('dialog').waitFor();
            await check(page, keys);
            await page.keyboard.press('Escape');
            await page.getByRole('dialog').waitFor({ state: 'detached' });
        }
        await page.getByTestId('statistics').click();
        await page.locator('.stats-table').getByText('march').waitFor();
        await check(page, 'statistics');
        await page.keyboard.press('Escape');
        await row(page, 'crate').click({ button: 'right' });
        await page.getByRole('menu').waitFor();
        /* A menu floats over all regions. */
        await check(page, 'menu of a node', ['region']);
        await page.keyboard.press('Escape');
        await closePage(page);
    });
});

/** What stands beyond the sides of the window. */
const spill = (page) =>
    page.evaluate(() => {
        const outside = [...document.querySelectorAll('button, input, a, [role=treeitem]')]
            .filter((one) => one.checkVisibility())
            .map((one) => ({ one, box: one.getBoundingClientRect() }))
            .filter(({ box }) => box.width > 0)
            .filter(({ box }) => box.right > innerWidth + 0.5 || box.left < -0.5)
            .map(({ one }) => one.outerHTML.slice(0, 120));
        const { scrollWidth, clientWidth } = document.documentElement;
        return { outside, scrolls: scrollWidth > clientWidth };
    });

/** Opens a tab of a narrow window; a wide one shows all of them. */
async function openTab(page, name) {
    const tab = page.getByRole('tab', { name });
    if ((await tab.count()) > 0) {
        await tab.click();
    }
}

describe('sizes', () => {
    const holdsAll = async (page, what) => assert.deepEqual(await spill(page), { outside: [], scrolls: false }, what);

    for (const [width, height] of [
        [1200, 800],
        [900, 700],
        [400, 800],
        [320, 640],
    ]) {
        test(`the start page, ${width} × ${height}`, async () => {
            const page = await stage.page({ width, height });
            await page.locator('[data-example]').first().waitFor();
            await holdsAll(page);
        });

        test(`editor, reference, code, a picture as a file, gallery, graph, ${width} × ${height}`, async () => {
            const page = await stage.page({ scene: await stage.scene(OWN), width, height });
            await holdsAll(page, 'editor');
            await page.keyboard.press('F1');
            await page.locator('.reference-link').first().waitFor();
            await holdsAll(page, 'reference');
            await page.keyboard.press('Escape');
            await page.getByTestId('reference').waitFor({ state: 'detached' });

            await page.keyboard.press('Control+Shift+S');
            await page.getByRole('dialog').getByRole('button', { name: 'Download' }).waitFor();
            await holdsAll(page, 'a picture as a file');
            await page.keyboard.press('Escape');
            await page.getByRole('dialog').waitFor({ state: 'detached' });

            await openTab(page, 'Looks');
            await page.getByRole('button', { name: 'Add a material' }).click();
            await page.locator('.gallery-tile').first().waitFor();
            await holdsAll(page, 'gallery');
            const box = await page.getByTestId('gallery').boundingBox();
            assert.ok(box.x >= 0 && box.x + box.width <= width && box.y >= 0 && box.y + box.height <= height);
            await page.keyboard.press('Escape');
            await page.getByTestId('gallery').waitFor({ state: 'detached' });

            await page.locator('[data-resource=egg] .resource-pick').click();
            await openTab(page, 'Edit');
            await page.getByRole('button', { name: 'Edit code' }).click();
            await page.locator('.cm-content').waitFor();
            await holdsAll(page, 'code');

            await page.keyboard.press('Alt+1');
            await page.locator('.graph-head').waitFor();
            await page.locator('[data-card="root"]').waitFor();
            const head = await page.locator('.graph-head').boundingBox();
            assert.ok(head.x >= 0 && head.x + head.width <= width);
        });
    }

    test('a phone shows tree, forms and looks in one sheet', async () => {
        const page = await stage.page({ scene, width: 400, height: 800 });
        await row(page, 'ball').click();
        await page.getByRole('tab', { name: 'Edit' }).click();
        await page.getByRole('spinbutton', { name: 'radius', exact: true }).waitFor();
        await page.getByRole('tab', { name: 'Looks' }).click();
        await page.locator('[data-resource=clay]').waitFor();
        await check(page, 'sheet');
        await closePage(page);
    });
});

test('F6 goes round the regions and back', async () => {
    const page = await stage.page({ scene });
    const region = () =>
        page.evaluate(
            () => document.activeElement.closest('[data-region]')?.dataset.region ?? null,
        );
    const seen = [];
    for (let i = 0; i < 5; i += 1) {
        await page.keyboard.press('F6');
        seen.push(await region());
    }
    assert.deepEqual(seen, ['Tools', 'Scene', 'Picture', 'Inspector', 'Status']);
    await page.keyboard.press('Shift+F6');
    assert.equal(await region(), 'Inspector');
    await closePage(page);
});

test('what is chosen is in sight, what is named has one ring, texts over the picture can be read', async () => {
    const page = await stage.page({ scene: await stage.scene(OWN), theme: 'light', width: 1024, height: 640 });
    await row(page, 'it').click();
    await page.keyboard.press('Shift+H');
    await page.getByTestId('isolated').waitFor();
    assert.deepEqual(await lookAt(page), []);
    await row(page, 'it').press('F2');
    await page.locator('.tree-rename').waitFor();
    assert.deepEqual(await lookAt(page), []);
    await page.keyboard.press('Escape');
    await page.getByRole('tab', { name: 'Looks' }).click();
    await page.getByRole('button', { name: 'Write a shader' }).first().click();
    await page.locator('.cm-content').waitFor();
    await page.locator('[data-resource=shader-1][data-selected]').waitFor();
    assert.deepEqual(await lookAt(page), []);
    await closePage(page);
});

test('a palette on a phone tells that its question goes on', async () => {
    const page = await stage.page({ scene, width: 390, height: 844, touch: true });
    const twist = await page.locator('.tree-twist').first().boundingBox();
    assert.ok(Math.min(twist.width, twist.height) >= 24, `a finger finds ${JSON.stringify(twist)}`);
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').waitFor();
    assert.deepEqual(await lookAt(page), []);
    await closePage(page);
});

test('the theme can be chosen and is kept', async () => {
    const page = await stage.page({ scene, theme: 'light' });
    const background = () =>
        page.evaluate(() => getComputedStyle(document.querySelector('.bar')).backgroundColor);
    const light = await background();
    const button = page.getByRole('button', { name: /^Theme/ });
    await button.click();
    await page.locator('html[data-theme=light]').waitFor();
    await button.click();
    await page.locator('html[data-theme=dark]').waitFor();
    const dark = await background();
    assert.notEqual(dark, light);
    await page.reload();
    await page.locator('[role=treeitem]').first().waitFor();
    assert.equal(await background(), dark);
    await closePage(page);
});
