// SPDX-License-Identifier: MIT
// Looking around, changing numbers, isolating: the picture follows, undo is exact.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import {
    difference,
    documentWhen,
    dragBy,
    drawnPixels,
    field,
    nodeIn,
    picture,
    pictureChanged,
    pixels,
    pixelsLike,
    row,
    settled,
    useStage,
    valueIs,
    waitForSaved,
} from './stage.mjs';

const stage = useStage();
const open = (scene) => stage.page({ scene });
const radiusOf = (document) => nodeIn(document, 'ball').params.radius;

describe('looking around', () => {
    test('a drag, the wheel and the arrow keys change the picture', async () => {
        const page = await open(await stage.scene());
        await settled(page);
        let now = await pixels(page);
        await dragBy(page, picture(page), 120, -30);
        now = await pictureChanged(page, now, 'the picture to follow the drag');
        await page.mouse.wheel(0, -240);
        now = await pictureChanged(page, now, 'the picture to follow the wheel');
        await picture(page).focus();
        await page.keyboard.press('ArrowLeft');
        await pictureChanged(page, now, 'the picture to follow the key');
        await settled(page);
    });

    test('looking around changes no document', async () => {
        const id = await stage.scene();
        const before = await stage.document(id);
        const page = await open(id);
        await settled(page);
        const now = await pixels(page);
        await dragBy(page, picture(page), 90, 0);
        await pictureChanged(page, now, 'the picture to follow the drag');
        assert.equal(await stage.document(id), before);
    });
});

describe('numbers', () => {
    test('dragging one changes the picture during the drag; undo restores every byte', async () => {
        const id = await stage.scene();
        const page = await open(id);
        const before = await stage.document(id);
        await row(page, 'ball').click();
        await settled(page);
        const start = await pixels(page);
        await dragBy(page, field(page, 'radius'), 60, 0, { steps: 20, leave: true });
        await pictureChanged(page, start, 'the picture to follow the number');
        await page.mouse.up();
        const changed = await documentWhen(stage, id, (d) => radiusOf(d) > 1.2, 'the new radius');
        await waitForSaved(page);
        assert.equal(await field(page, 'radius').inputValue(), String(radiusOf(changed)));

        await page.keyboard.press('Control+z');
        await documentWhen(stage, id, (d) => radiusOf(d) === 1, 'the old radius');
        assert.equal(await stage.document(id), before, 'one undo takes back the whole drag');

        await page.keyboard.press('Control+Shift+z');
        await documentWhen(stage, id, (d) => radiusOf(d) === radiusOf(changed), 'the redone drag');
    });

    test('Escape during a drag restores the value', async () => {
        const id = await stage.scene();
        const page = await open(id);
        await row(page, 'ball').click();
        await dragBy(page, field(page, 'radius'), 50, 0, { leave: true });
        await documentWhen(stage, id, (d) => radiusOf(d) !== 1, 'the drag');
        await page.keyboard.press('Escape');
        await documentWhen(stage, id, (d) => radiusOf(d) === 1, 'the old radius');
        await page.mouse.up();
        await valueIs(field(page, 'radius'), '1');
    });

    test('expressions, arrows, ranges', async () => {
        const id = await stage.scene();
        const page = await open(id);
        await row(page, 'ball').click();
        const radius = field(page, 'radius');
        await radius.fill('1/3');
        await radius.press('Enter');
        await documentWhen(stage, id, (d) => radiusOf(d) === 0.333333, 'a third');
        await radius.fill('-2');
        await radius.press('Enter');
        await page.getByText(/-2 is /).waitFor();
        assert.equal(radiusOf(JSON.parse(await stage.document(id))), 0.333333);
        await radius.press('Escape');
        await page.getByText(/-2 is /).waitFor({ state: 'detached' });
        assert.equal(await radius.inputValue(), '0.333333');

        const turn = field(page, 'rotation y');
        await turn.fill('90');
        await turn.press('Enter');
        await documentWhen(
            stage,
            id,
            (d) => Math.abs((nodeIn(d, 'ball').transform.rotation?.[1] ?? 0) - Math.PI / 2) < 1e-5,
            'a quarter turn',
        );
        await valueIs(turn, '90°');
    });

    test('two hundred numeric edits arrive, and the picture follows', async () => {
        const id = await stage.scene();
        const page = await open(id);
        await row(page, 'ball').click();
        await settled(page);
        const before = await pixels(page);
        const x = field(page, 'translation x');
        await x.focus();
        for (let i = 0; i < 200; i += 1) {
            await page.keyboard.press(i % 100 < 60 ? 'ArrowUp' : 'ArrowDown');
        }
        await waitForSaved(page);
        const answer = await fetch(`${stage.daemon.url}/v1/scenes/${id}`);
        assert.equal(answer.headers.get('etag'), '"201"');
        /* Forty steps of a twentieth. */
        assert.deepEqual(nodeIn(await answer.json(), 'ball').transform.translation, [0.5, 0, 0]);
        await valueIs(x, '0.5');
        await settled(page);
        await pictureChanged(page, before, 'the ball at the right');
    });
});

describe('two pages', () => {
    test('each sees the edits of the other and undoes only its own', async () => {
        const id = await stage.scene();
        const [a, b] = [await open(id), await open(id)];
        await row(a, 'ball').click();
        await row(b, 'ball').click();
        await settled(b);
        const before = await pixels(b);
        await field(a, 'radius').fill('1.6');
        await field(a, 'radius').press('Enter');
        await b.waitForFunction(
            () => document.querySelector('[data-param=radius] input')?.value === '1.6',
        );
        await pictureChanged(b, before, "the other page's edit in the picture");
        await field(b, 'translation y').fill('0.5');
        await field(b, 'translation y').press('Enter');
        await documentWhen(
            stage,
            id,
            (d) => nodeIn(d, 'ball').transform.translation[1] === 0.5,
            "the second page's edit",
        );
        await row(a, 'ball').click();
        await a.keyboard.press('Control+z');
        const left = await documentWhen(stage, id, (d) => radiusOf(d) === 1, "the first's undo");
        assert.equal(nodeIn(left, 'ball').transform.translation[1], 0.5);
    });
});

test('a dragged number changes its own field and nothing else of the page', async () => {
    const page = await open(await stage.scene());
    await row(page, 'ball').click();
    await field(page, 'radius').hover();
    await settled(page);
    await page.evaluate(() => {
        window.touched = new Set();
        const outside = ['[data-testid=tree]', '.resources', '.crumbs'];
        for (const place of outside) {
            const options = { subtree: true, childList: true, attributes: true, characterData: true };
            /* Thumbnails come when they are drawn, and the dragged node has a new one in the end. */
            const tell = ({ type, target }) =>
                (target.closest ? target : target.parentElement)?.closest('.thumbnail') ||
                window.touched.add(`${place}: ${type} of ${target.outerHTML ?? target.data}`);
            new MutationObserver((records) => records.forEach(tell)).observe(
                document.querySelector(place),
                options,
            );
        }
        for (const one of document.querySelectorAll('[data-param]:not([data-param=radius])')) {
            new MutationObserver(() => window.touched.add(one.dataset.param)).observe(one, {
                subtree: true,
                childList: true,
                attributes: true,
                characterData: true,
            });
        }
    });
    const before = await field(page, 'radius').inputValue();
    await dragBy(page, field(page, 'radius'), 40, 0, { steps: 30 });
    assert.notEqual(await field(page, 'radius').inputValue(), before);
    assert.deepEqual(await page.evaluate(() => [...window.touched]), []);
});

test('what is isolated is this page’s alone, and no edit', async () => {
    const id = await stage.scene();
    const [page, other] = [await open(id), await open(id)];
    const before = await stage.document(id);
    await Promise.all([settled(page), settled(other)]);
    const [all, seen] = [await drawnPixels(page, stage, id), await drawnPixels(other, stage, id)];
    await row(page, 'pair').click();
    await page.keyboard.press('Shift+H');
    const pill = page.getByTestId('isolated');
    await pill.getByText('Isolated: pair').waitFor();
    await row(page, 'crate').and(page.locator('[data-apart]')).waitFor();
    assert.equal(await row(page, 'ring').and(page.locator('[data-apart]')).count(), 0);
    await row(page, 'pair').getByRole('img', { name: 'Isolated' }).waitFor();
    await pictureChanged(page, all, 'the picture of the pair alone');
    assert.equal(await stage.document(id), before);
    assert.equal(difference(await pixels(other), seen), 0, 'the other page shows all');
    await pill.getByRole('button', { name: 'Show all' }).click();
    await pill.waitFor({ state: 'detached' });
    const again = () => pixelsLike(page, all, 1, 'all of it again');
    await again();
    await row(page, 'crate').click();
    await page.keyboard.press('Shift+H');
    await pill.getByText('Isolated: crate').waitFor();
    await page.keyboard.press('Delete');
    await pill.waitFor({ state: 'detached' });
});
