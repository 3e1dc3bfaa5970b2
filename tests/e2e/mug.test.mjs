// SPDX-License-Identifier: MIT
// A mug from an empty scene, as somebody new would make it: by clicks, drags and keys, without typing
// a number. Each act is counted; the list of them is the walk.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { closePage, documentWhen, dragBy, nodeIn, picture, row, settled, useStage } from './stage.mjs';

const MOST_ACTS = 19;

const stage = useStage({ coarse: true });

test(`a mug takes at most ${MOST_ACTS} acts`, async () => {
    const page = await stage.page({ width: 1440, height: 900 });
    await page.getByRole('button', { name: 'New scene' }).first().click();
    await page.locator('[role=treeitem]').first().waitFor();
    const id = new URL(page.url()).pathname.split('/').at(-1);
    const acts = [];
    const act = async (words, what) => {
        acts.push(words);
        await what();
    };
    const document = (holds, what) => documentWhen(stage, id, holds, what);
    const only = (d, type) => {
        const find = (node) => (node.type === type ? node : (node.children ?? []).map(find).find(Boolean));
        return find(d.root);
    };

    /** The parts of the gizmo and the handles, in pixels of the window. */
    const grip = async (isIt, what) => {
        const parts = async () => JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');
        await settled(page);
        await until(async () => (await parts()).some(isIt), what);
        const { at } = (await parts()).find(isIt);
        const box = await picture(page).boundingBox();
        return { x: box.x + at.x, y: box.y + at.y };
    };
    const middle = () => grip((part) => part.motion === 'move' && part.axis === null, 'the middle');
    const handle = (name) => grip((part) => part.handle?.includes(name), `the handle ${name}`);
    /** From one place of the way from the middle to another, as a share of the way to the grip. */
    const pull = async (from, share) => {
        const { x, y } = await middle();
        await page.mouse.move(from.x, from.y);
        await page.mouse.down();
        await page.mouse.move(x + (from.x - x) * share, y + (from.y - y) * share, { steps: 6 });
        await page.mouse.up();
    };
    const tile = (type) => page.locator(`[role=option][data-type=${type}]`).first();
    const add = async (words, type, way) => {
        await act(`Shift+A: add ${words}`, () => page.keyboard.press('Shift+A'));
        await tile(type).waitFor();
        if (way) {
            await act(`as: ${way}`, () => page.locator(`[data-way=${way}]`).click());
        }
        await act(`click ${type}`, () => tile(type).click());
        await document((d) => only(d, type), type);
    };

    await add('the body', 'round_cylinder');
    await add('what hollows it', 'cylinder', 'carve');
    const { transform: tool } = only(await document(Boolean), 'cylinder');
    assert.ok(tool.scale[0] < 0.9 && tool.translation[1] > 0.1, 'a tool that leaves walls and a bottom');
    await act('click the cut in the tree', () => row(page, 'smooth_difference-1').click());
    await add('the handle', 'link', 'blend');
    await document((d) => only(d, 'link').transform.translation[0] > 0.3, 'a handle at the side');
    await act('drag it shorter', async () => pull(await handle('length'), 0.3));
    await document((d) => only(d, 'link').params?.length < 0.4, 'a shorter handle');
    await act('open the backdrop', () => page.getByRole('button', { name: 'Backdrop' }).click());
    await act('switch the floor on', () => page.getByRole('switch', { name: 'floor shown' }).click());
    await document((d) => d.environment?.floor, 'a floor');
    const height = page.getByRole('spinbutton', { name: 'floor height' });
    await act('drag it below the mug', () => dragBy(page, height, -500, 0));
    await document((d) => d.environment.floor_height < -0.4, 'a floor below');
    await act('open the gallery', () => page.getByRole('button', { name: 'Add a material' }).click());
    const give = async (preset, node) => {
        await act(`drag ${preset} onto ${node}`, () => page.locator(`[data-preset=${preset}]`).dragTo(row(page, node)));
        await document((d) => nodeIn(d, node).material?.startsWith(preset), `${node} of ${preset}`);
    };
    await give('ceramic', 'smooth_union-1');
    await give('cobalt', 'cylinder-1');
    await give('terracotta', 'link-1');
    await act('open the lights', () => page.getByRole('button', { name: 'Add a light' }).click());
    await act('click Point', () => page.getByRole('menuitem', { name: 'Point' }).click());

    const made = await document((d) => d.lights.length === 2, 'two lights');
    await settled(page);
    console.log(acts.map((words, i) => `# ${i + 1}. ${words}`).join('\n'));
    assert.equal(Object.keys(made.materials).length, 3);
    assert.ok(acts.length <= MOST_ACTS, `${acts.length} acts`);
    if (process.env.MUG_PICTURE) {
        await page.screenshot({ path: process.env.MUG_PICTURE });
    }
    await closePage(page);
});
