// SPDX-License-Identifier: MIT
// A parametric surface is drawn as it is typed, whatever its functions are. Meanwhile the server looks
// for its equation: it takes the surface's place in one edit, or the page says why there is none.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { ask } from '../support/daemon.mjs';
import { closePage, difference, documentWhen, field, nodeIn, pictureChanged, row, settled, stillPixels, useStage } from './stage.mjs';

const program = process.env.FIELDCAST ?? 'build/release/fieldcast';
const stage = useStage();

const check = (document) => spawnSync(program, ['check', '-'], { input: JSON.stringify(document), encoding: 'utf8' });
const part = (page, name) => page.getByRole('textbox', { name: `surface ${name}`, exact: true });
const status = (page, text) => page.locator('.patches-equation').getByText(text).waitFor();

async function type(page, texts) {
    for (const [name, text] of Object.entries(texts)) {
        await part(page, name).fill(text);
        await part(page, name).press('Enter');
    }
}

const UMBRELLA = { x: 's*t', y: 's', z: 't^2', s: [-1, 1], t: [-1.5, 1.5] };

/** `far`: times as far as usual, so that a picture that nobody looks at is drawn soon. */
async function open(params, far = 1) {
    const id = await stage.scene({
        format: 'fieldcast/1',
        camera: { position: [2, 1.5, 4].map((x) => far * x) },
        lights: [{ id: 'sun', type: 'directional', intensity: 3 }],
        render: { samples: 1 },
        root: { id: 'root', type: 'union', children: [{ id: 'it', type: 'parametric', params }] },
    });
    const page = await stage.page({ scene: id });
    page.expected = /422/; /* where there is no equation */
    await row(page, 'it').click();
    await part(page, 'x').waitFor();
    await settled(page);
    return { id, page };
}

test('a new one is seen at once, follows what is typed, and says where a text is wrong', async () => {
    const { id, page } = await open({});
    const nothing = await stillPixels(page);
    await type(page, { x: 's*cos(t)', y: 'a*t/4', z: 's*sin(t)' });
    await documentWhen(stage, id, (d) => nodeIn(d, 'it').params?.surface?.z === 's*sin(t)', 'all parts');
    await pictureChanged(page, nothing, 'the helicoid');
    await status(page, 'No equation: t stands inside and outside of sin, cos or tan: this surface is not algebraic. The sampled surface stays.');
    await page.getByText('Sampled: 1024 patches, off by').waitFor();
    await settled(page);
    const helicoid = await stillPixels(page);

    const set = await page.locator('.patches .typeset math').allTextContents();
    assert.deepEqual(set.map((line) => line.replace(/[\u2061\u2062]/g, '')), ['scost', 'at4', 'ssint'], 'each part is typeset');

    await field(page, 'a').fill('0.3');
    await page.keyboard.press('Enter');
    await pictureChanged(page, helicoid, 'the flatter helicoid');
    await field(page, 't to').fill('1');
    await page.keyboard.press('Enter');
    await documentWhen(stage, id, (d) => nodeIn(d, 'it').params.surface.t[1] === 1, 'the range');
    await settled(page);

    const good = await stillPixels(page);
    page.expected = /422|compile/;
    await part(page, 'x').fill('π*s + j');
    const mark = page.locator('.patches .equation-mark mark');
    await mark.waitFor();
    assert.equal(await mark.textContent(), 'j');
    assert.ok(difference(await stillPixels(page), good) <= 1, 'the last good picture stays');
    await part(page, 'x').press('Escape');
    await mark.waitFor({ state: 'detached' });
    await closePage(page);
});

test('its equation takes its place in one edit, with what proves it', async () => {
    const { id, page } = await open({ surface: { ...UMBRELLA, x: 'b*s*t' }, b: 2, thickness: 0.08 }, 8);
    await status(page, 'Degree 3, 2 terms; proved to be exact.');
    const before = await ask(stage.daemon, 'GET', `/v1/scenes/${id}`);
    await page.getByRole('button', { name: 'Make implicit' }).click();
    const made = await documentWhen(stage, id, (d) => nodeIn(d, 'it').type === 'implicit', 'an equation');
    const { equation, parametric, mode, thickness, size } = nodeIn(made, 'it').params;
    assert.match(equation, /^4\*y\^2\*z-x\^2 = 0$|^x\^2-4\*y\^2\*z = 0$/);
    assert.deepEqual(parametric, { ...UMBRELLA, x: '(2)*s*t' });
    assert.deepEqual([mode, thickness], ['sheet', 0.08]);
    for (const [i, most] of [3.08, 1.08, 2.33].entries()) {
        assert.ok(Math.abs(size[i] / 2 - most) < 0.1, `${size}`);
    }
    await page.locator('.surface-badge').getByText('Verified: degree 3, 2 terms').waitFor();
    const { status: code, stdout } = check(made);
    assert.match(stdout, /\/nodes\/it\/params\/parametric: verified: degree 3, 2 terms; the patch covers \d+ % of the implicit surface within the clip$/m);
    assert.equal(code, 0);

    await page.keyboard.press('Control+z');
    const back = await documentWhen(stage, id, (d) => nodeIn(d, 'it').type === 'parametric', 'one step back');
    assert.deepEqual(back.root, before.root);
    await closePage(page);
});

test('a curve and a degree that is too high say so', async () => {
    const { page } = await open({ surface: { x: 's', y: 's^2', z: 's^3', s: [0, 1], t: [0, 1] } }, 8);
    await status(page, /No equation: .*curve/);
    await type(page, { x: 's^9 + t', y: 't^9 - s*t', z: 's^8*t + t^2' });
    await status(page, /No equation: .*degree/);
    await closePage(page);
});
