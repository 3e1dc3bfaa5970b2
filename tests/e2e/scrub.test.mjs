// SPDX-License-Identifier: MIT
// Number fields are dragged with a locked pointer, in the browser that users have.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { closePage, documentWhen, dragBy, field, nodeIn, row, useStage, waitForSaved } from './stage.mjs';

const stage = useStage({ whole: true });
const WIDTH = 1200;
const isLocked = (page, locked) =>
    page.waitForFunction((want) => (document.pointerLockElement !== null) === want, locked);

test('a drag of a number goes on past the edge of the window, and lets the pointer go', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id, width: WIDTH });
    await row(page, 'ball').click();
    const x = field(page, 'translation x');
    const box = await x.boundingBox();
    await dragBy(page, x, 20, 0, { leave: true });
    await isLocked(page, true);
    const edge = await x.inputValue();
    await page.mouse.move(box.x + WIDTH, box.y, { steps: 8 });
    await page.mouse.up();
    await isLocked(page, false);
    await waitForSaved(page);
    const dragged = (d) => nodeIn(d, 'ball').transform.translation[0];
    const after = await documentWhen(stage, id, (d) => dragged(d) !== -1.5, 'the drag');
    assert.ok(dragged(after) > Number(edge) + 1, `${dragged(after)} after ${edge}`);
    await closePage(page);
});
