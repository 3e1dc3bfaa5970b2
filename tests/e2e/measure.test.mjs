// SPDX-License-Identifier: MIT
// Distances between two clicks: equal to those of the points that rays meet, and no edit.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from '../support/daemon.mjs';
import { picture, settled, useStage } from './stage.mjs';

const EYE = [0, 0, 10];
const ball = (id, x, radius) => ({ id, type: 'sphere', params: { radius }, transform: { translation: [x, 0, 0] } });
const DOCUMENT = {
    format: 'fieldcast/1',
    camera: { position: EYE, target: [0, 0, 0], fov: 45 },
    render: { samples: 1 },
    root: { id: 'root', type: 'union', children: [ball('left', -1.5, 1), ball('right', 1.8, 0.8)] },
};

const stage = useStage();
let page;

/** Where a ray through a pixel of the picture meets a ball, in the scene. */
function meets(box, x, y, centre, radius) {
    const scale = Math.tan(Math.PI / 8) / (box.height / 2);
    const along = [(x - box.width / 2) * scale, (box.height / 2 - y) * scale, -1];
    const size = Math.hypot(...along);
    const d = along.map((c) => c / size);
    const to = EYE.map((c, i) => c - [centre, 0, 0][i]);
    const b = to.reduce((sum, c, i) => sum + c * d[i], 0);
    const t = -b - Math.sqrt(b * b - (to.reduce((sum, c) => sum + c * c, 0) - radius * radius));
    return EYE.map((c, i) => c + t * d[i]);
}

const figures = async () => {
    const text = await page.getByTestId('measured').innerText();
    return (text.match(/-?\d+(\.\d+)?/g) ?? []).map(Number);
};

test('two clicks tell a distance and its parts; the third begins anew; Esc leaves', async () => {
    const id = await stage.scene(DOCUMENT);
    page = await stage.page({ scene: id });
    await settled(page);
    const before = await stage.document(id);
    const box = await picture(page).boundingBox();
    const unit = box.height / 2 / Math.tan(Math.PI / 8) / 10;
    const [a, b] = [[-1.3, 0.4], [1.9, -0.2]].map(([x, y]) => [Math.round(box.width / 2 + unit * x) + 0.5, Math.round(box.height / 2 - unit * y) + 0.5]);
    const click = ([x, y]) => page.mouse.click(box.x + x, box.y + y);
    await page.getByRole('button', { name: 'Measure distances' }).click();
    await page.getByText('Click where to measure from').waitFor();
    await click([20, 100]); // nothing is there
    await click(a);
    await page.getByText('Click where to measure to').waitFor();
    await click(b);
    await until(async () => (await figures()).length === 4, 'the figures');
    const [from, to] = [meets(box, ...a, -1.5, 1), meets(box, ...b, 1.8, 0.8)];
    const by = to.map((c, i) => c - from[i]);
    const told = await figures();
    [Math.hypot(...by), ...by].forEach((wanted, i) => assert.ok(Math.abs(told[i] - wanted) < 0.004, `${told} for ${wanted}`));

    const line = page.locator('.measured-line circle');
    const ends = await line.evaluateAll((all) => all.map((one) => [Number(one.getAttribute('cx')), Number(one.getAttribute('cy'))]));
    [a, b].forEach((spot, i) => assert.ok(Math.hypot(ends[i][0] - spot[0], ends[i][1] - spot[1]) < 1, `${ends[i]} at ${spot}`));
    await picture(page).focus();
    await page.keyboard.press('ArrowRight');
    await until(async () => Math.abs(Number(await line.first().getAttribute('cx')) - ends[0][0]) > 3, 'the line to turn with the picture');

    await page.keyboard.press('Home');
    await settled(page);
    await click([box.width / 2 + 1.8 * unit, box.height / 2]);
    await page.getByText('Click where to measure to').waitFor();
    assert.equal(await line.count(), 1);
    await page.keyboard.press('Escape');
    await page.getByTestId('measured').waitFor({ state: 'detached' });
    assert.equal(await stage.document(id), before);
    assert.equal(await page.locator('[role=treeitem][aria-selected=true]').count(), 0, 'nothing was selected');
});
