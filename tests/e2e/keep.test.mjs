// SPDX-License-Identifier: MIT
// Nothing that a user types, clicks or selects is lost: undo from inside a field, Backspace over a
// label, ranges of rows, menus and clicks while the server is slow, several nodes at once.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { ask, standStill, until } from '../support/daemon.mjs';
import {
    documentWhen,
    dragBy,
    field,
    nodeIn,
    picture,
    row,
    rows,
    SCENE,
    settled,
    useStage,
    valueIs,
    waitForSaved,
} from './stage.mjs';

const stage = useStage({ coarse: true });
let page;
let id;

async function open(options = {}) {
    id = await stage.scene(options.document);
    page = await stage.page({ scene: id, width: 1440, height: 900, ...options });
}

const when = (holds, what) => documentWhen(stage, id, holds, what);
const now = async () => JSON.parse(await stage.document(id));
const radiusOf = (document, node = 'ball') => nodeIn(document, node).params?.radius;
const selected = () =>
    page
        .locator('[data-node][aria-selected=true]')
        .evaluateAll((all) => all.map((one) => one.dataset.node).sort());
const selectedIs = (...wanted) =>
    page.waitForFunction(
        (ids) =>
            [...document.querySelectorAll('[data-node][aria-selected=true]')]
                .map((one) => one.dataset.node)
                .sort()
                .join() === ids,
        wanted.sort().join(),
    );

/** The middle of a shape in the picture. */
async function pointOf(x, y) {
    const box = await picture(page).boundingBox();
    return [box.x + x * box.width, box.y + y * box.height];
}
const BALL = [0.335, 0.6];

/** The picture is not that of the view any more: what is under the pointer has to be asked. */
async function lookAside() {
    await picture(page).focus();
    await page.keyboard.press('ArrowRight');
    await page.locator('[data-testid=outlines][data-guide=""]').waitFor({ state: 'attached' });
}

/** Holds the server still while `act` runs. */
async function stopped(act) {
    try {
        await standStill(stage.daemon.pid);
        await act();
    } finally {
        process.kill(stage.daemon.pid, 'SIGCONT');
    }
}

describe('number fields', () => {
    test('undo and redo act from inside a field, after Enter and after arrows', async () => {
        await open();
        await row(page, 'ball').click();
        const radius = field(page, 'radius');
        await radius.fill('0.7');
        await radius.press('Enter');
        await when((d) => radiusOf(d) === 0.7, 'the typed value');
        await radius.press('Control+z');
        await when((d) => radiusOf(d) === 1, 'the value before');
        await valueIs(radius, '1');
        await radius.press('Control+Shift+z');
        await when((d) => radiusOf(d) === 0.7, 'the value again');
        await valueIs(radius, '0.7');
        await radius.press('ArrowUp');
        await when((d) => radiusOf(d) === 0.75, 'one step up');
        await radius.press('Control+z');
        await when((d) => radiusOf(d) === 0.7, 'the step undone');
        /* What is being typed is the field's own to undo. */
        await radius.pressSequentially('12');
        await radius.press('Control+z');
        await waitForSaved(page);
        assert.equal(radiusOf(await now()), 0.7);
        await radius.press('Escape');
        await valueIs(radius, '0.7');
    });

    test('undo acts from inside the sheet of a colour', async () => {
        await open();
        await page.locator('[data-resource=clay] .resource-pick').click();
        await page.locator('[data-param=diffuse] .colour-button').click();
        const hex = page.getByLabel('diffuse Hex');
        await hex.fill('#0000ff');
        await hex.press('Enter');
        const colour = (d) => d.materials.clay.properties.diffuse.join();
        await when((d) => colour(d) === '0,0,1', 'blue');
        await hex.press('Control+z');
        await when((d) => colour(d) === '0.8,0.3,0.2', 'the colour before');
    });

    test('90 degrees stay 90 degrees, typed, wrapped and undone', async () => {
        await open();
        await row(page, 'ring').click();
        const x = field(page, 'rotation x');
        await x.fill('90');
        await x.press('Enter');
        const turn = (d) => nodeIn(d, 'ring').transform.rotation?.[0];
        await when((d) => turn(d) === Math.PI / 2, 'a quarter turn to the last bit');
        await row(page, 'ball').click();
        await row(page, 'ring').click({ modifiers: ['Control'] });
        await page.keyboard.press('b');
        const wrapped = await when(
            (d) => nodeIn(d, 'smooth_union-1')?.children.length === 2,
            'the smooth union',
        );
        assert.equal(turn(wrapped), Math.PI / 2);
        await row(page, 'ring').click();
        await valueIs(field(page, 'rotation x'), '90°');
    });

    test('a vector has room for five digits, and a tip for all', async () => {
        await open();
        await row(page, 'ball').click();
        const x = field(page, 'translation x');
        await x.fill('-1.234567');
        await x.press('Enter');
        await valueIs(x, '-1.23457');
        await row(page, 'ball').click();
        const fits = await x.evaluate((input) => input.scrollWidth <= input.clientWidth);
        assert.ok(fits, 'the number is cut off');
        await x.hover();
        assert.equal(await x.getAttribute('title'), '', 'what is seen needs no tip');
        const y = field(page, 'translation y');
        await ask(stage.daemon, 'PATCH', `/v1/scenes/${id}`, [
            { op: 'set', at: '/nodes/ball/transform/translation', value: [-1.23457, -123456.7, 0] },
        ]);
        await valueIs(y, '-123457');
        assert.equal(await y.evaluate((input) => getComputedStyle(input).textOverflow), 'ellipsis');
        await y.hover();
        assert.equal(await y.getAttribute('title'), '-123456.7');
    });

    test('three pasted or typed numbers fill x, y and z', async () => {
        await open();
        await row(page, 'ball').click();
        const place = (d) => nodeIn(d, 'ball').transform.translation;
        for (const [text, wanted] of [
            ['0.1 0.6 0.2', [0.1, 0.6, 0.2]],
            ['[1,2,3]', [1, 2, 3]],
            ['4, 5, 6\n', [4, 5, 6]],
        ]) {
            await field(page, 'translation y').focus();
            await page.evaluate((pasted) => {
                const data = new DataTransfer();
                data.setData('text/plain', pasted);
                document.activeElement.dispatchEvent(
                    new ClipboardEvent('paste', {
                        clipboardData: data,
                        bubbles: true,
                        cancelable: true,
                    }),
                );
            }, text);
            await when((d) => place(d).join() === wanted.join(), `the place ${wanted}`);
            await valueIs(field(page, 'translation z'), String(wanted[2]));
        }
        await field(page, 'translation x').fill('7 8 9');
        await field(page, 'translation x').press('Enter');
        await when((d) => place(d).join() === '7,8,9', 'the typed place');
    });
});

describe('Backspace', () => {
    test('over a label it resets the value; over the inspector it never deletes', async () => {
        await open();
        await row(page, 'ball').click();
        await row(page, 'ball').focus();
        await page.locator('[data-param=radius] .form-label').hover();
        await page.keyboard.press('Backspace');
        await when((d) => radiusOf(d) === undefined, 'the default radius');
        await page.keyboard.press('Backspace');
        await page.getByText('Delete removes the selected nodes').waitFor();
        await page.locator('.inspector-head').hover();
        await page.keyboard.press('Backspace');
        await page.keyboard.press('Control+d');
        await when((d) => nodeIn(d, 'ball-1'), 'a later edit');
        assert.ok(nodeIn(await now(), 'ball'));
        await picture(page).hover({ position: { x: 5, y: 200 } });
        await page.keyboard.press('Backspace');
        await when((d) => !nodeIn(d, 'ball-1'), 'the deleted copy');
    });

    test('what is deleted is told, with Undo beside it', async () => {
        await open();
        const before = await stage.document(id);
        await row(page, 'pair').click();
        await page.keyboard.press('Delete');
        await when((d) => !nodeIn(d, 'pair'), 'the deleted group');
        const notice = page.locator('.notice', { hasText: 'Pair deleted' });
        await notice.getByRole('button', { name: 'Undo' }).click();
        await when((d) => nodeIn(d, 'pair'), 'the group again');
        assert.equal(await stage.document(id), before);
        await notice.waitFor({ state: 'detached' });
        await selectedIs('pair');
    });
});

describe('ranges of rows', () => {
    test('Shift and a click take all rows from the first to the last', async () => {
        await open();
        await row(page, 'ball').click();
        await row(page, 'ring').click({ modifiers: ['Shift'] });
        await selectedIs('ball', 'crate', 'pair', 'ring');
        await row(page, 'crate').click({ modifiers: ['Shift'] });
        await selectedIs('ball', 'crate');
        await row(page, 'pole').click();
        await row(page, 'pair').click({ modifiers: ['Shift'] });
        await selectedIs('pair', 'ring', 'pole');
    });

    test('a range begins at what was selected in the picture', async () => {
        await open();
        await settled(page);
        const [x, y] = await pointOf(...BALL);
        await page.mouse.click(x, y);
        await selectedIs('ball');
        await row(page, 'pair').click({ modifiers: ['Shift'] });
        await selectedIs('ball', 'crate', 'pair');
        await page.keyboard.press('d');
        await when((d) => nodeIn(d, 'difference-1')?.children.length === 3, 'the difference');
    });

    test('Shift and arrows widen and narrow', async () => {
        await open();
        await row(page, 'crate').click();
        await page.keyboard.press('Shift+ArrowDown');
        await page.keyboard.press('Shift+ArrowDown');
        await selectedIs('crate', 'pair', 'ring');
        await page.keyboard.press('Shift+ArrowUp');
        await selectedIs('crate', 'pair');
        await page.keyboard.press('Shift+ArrowUp');
        await page.keyboard.press('Shift+ArrowUp');
        await selectedIs('ball', 'crate');
        await page.keyboard.press('ArrowUp');
        await selectedIs('root');
    });
});

describe('focus', () => {
    const focusIs = (wanted) =>
        page.waitForFunction((one) => document.activeElement?.dataset.node === one, wanted);

    test('follows the selection: after adding, deleting and undo', async () => {
        await open();
        await row(page, 'ball').click();
        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill('donut');
        await page.locator('[role=option][data-type=torus][aria-selected=true]').waitFor();
        await page.keyboard.press('Enter');
        await selectedIs('torus-1');
        await focusIs('torus-1');
        await page.keyboard.press('ArrowDown');
        await selectedIs('crate');
        await page.keyboard.press('Delete');
        await selectedIs('pair');
        await focusIs('pair');
        await page.keyboard.press('Control+z');
        await selectedIs('crate');
        await focusIs('crate');
        await page.keyboard.press('ArrowUp');
        await selectedIs('torus-1');
        await focusIs('torus-1');
    });
});

describe('while the server is slow', () => {
    test('an undo can be redone before the server has answered', async () => {
        await open();
        const radius = field(page, 'radius');
        const button = (name, off) =>
            page.locator(`[data-command="edit.${name}"]${off ? '[aria-disabled]' : ':not([aria-disabled])'}`).waitFor();
        await row(page, 'ball').click();
        await stopped(async () => {
            await radius.fill('0.7');
            await radius.press('Enter');
            await radius.press('Control+z');
            await button('undo', true);
            await radius.press('Control+Shift+z');
            await button('redo', true);
            await radius.press('Control+z');
            await radius.press('Control+Shift+z');
            await button('undo', false);
        });
        await waitForSaved(page);
        assert.equal(radiusOf(await now()), 0.7);
    });

    test('the menu is there at once, names follow, and it is not cut off', async () => {
        await open();
        await settled(page);
        const box = await picture(page).boundingBox();
        const menu = page.getByRole('menu');
        await stopped(async () => {
            await lookAside();
            const [x, y] = await pointOf(...BALL);
            await page.mouse.click(x, y, { button: 'right' });
            await menu.getByText('Looking what is here').waitFor();
            const at = await menu.boundingBox();
            assert.ok(Math.abs(at.x - x) < 12 && at.y >= 0, `the menu is at ${at.x} ${at.y}`);
        });
        await menu.getByText('ball', { exact: true }).waitFor();
        await selectedIs('ball');
        await page.keyboard.press('Escape');
        await menu.waitFor({ state: 'detached' });
        await page.mouse.click(box.x + box.width / 3, box.y + box.height - 6, { button: 'right' });
        await menu.waitFor();
        await menu.getByText('Looking what is here').waitFor({ state: 'detached' });
        const inside = await menu.evaluate((one) => {
            const { top, bottom, left, right } = one.getBoundingClientRect();
            const fits = one.scrollHeight <= one.clientHeight + 1;
            return top >= 0 && left >= 0 && bottom <= innerHeight && right <= innerWidth && fits;
        });
        assert.ok(inside, 'the menu is cut off');
        await page.keyboard.press('Escape');
    });

    test('the pill says that the picture is not what is looked at', async () => {
        await open();
        await settled(page);
        const state = (name) => page.locator(`[data-testid=state][data-state=${name}]`).waitFor();
        const speed = page.getByTestId('statistics');
        await speed.getByText('idle').waitFor();
        await stopped(async () => {
            await page.keyboard.press('z');
            await state('drawing');
            await speed.getByText('less than 1 fps').waitFor();
            await page.keyboard.press('Shift+Z');
            await state('final');
            await picture(page).focus();
            await page.keyboard.press('Num7'.replace('Num', 'Numpad'));
            await state('drawing');
        });
        await state('final');
        for (let i = 0; i < 2; i += 1) {
            await page.keyboard.press('Home');
        }
        await state('final');
    });

    test('a late answer to a closed menu changes nothing and takes no keys', async () => {
        await open();
        await settled(page);
        const menu = page.getByRole('menu');
        await stopped(async () => {
            const [x, y] = await pointOf(...BALL);
            await page.mouse.click(x, y, { button: 'right' });
            await menu.waitFor();
            await page.keyboard.press('Escape');
            await menu.waitFor({ state: 'detached' });
            await row(page, 'crate').click();
        });
        await page.keyboard.press('h');
        await when((d) => nodeIn(d, 'crate').visible === false, 'the hidden crate');
        await page.locator('.view-asked').waitFor({ state: 'detached' });
        assert.deepEqual(await selected(), ['crate']);
        assert.equal(await menu.count(), 0);
    });

    test('every click counts, in its order, and shows that it was taken', async () => {
        await open();
        await settled(page);
        const [x, y] = await pointOf(...BALL);
        const [u] = await pointOf(1 - BALL[0], 0);
        await stopped(async () => {
            await lookAside();
            await page.mouse.click(x, y);
            await page.locator('.view-asked').first().waitFor();
            await page.keyboard.down('Shift');
            await page.mouse.click(u, y);
            await page.keyboard.up('Shift');
        });
        await selectedIs('ball', 'crate');
        await page.locator('.view-asked').waitFor({ state: 'detached' });
    });
});

describe('several nodes at once', () => {
    async function two() {
        await open();
        await row(page, 'crate').click();
        await row(page, 'ball').click({ modifiers: ['Control'] });
    }

    test('the inspector says how many, and where they differ', async () => {
        await two();
        const inspector = page.getByTestId('inspector');
        await inspector.getByRole('heading', { name: '2 nodes' }).waitFor();
        await valueIs(field(page, 'translation x'), '');
        assert.equal(await field(page, 'translation x').getAttribute('placeholder'), 'mixed');
        await valueIs(field(page, 'translation y'), '0');
        await page.getByRole('combobox', { name: 'material' }).getByText('mixed').waitFor();
        await inspector.getByRole('button', { name: 'crate' }).click();
        await selectedIs('crate');
    });

    const placeOf = (d, node) => nodeIn(d, node).transform.translation;

    test('a drag changes each from where it is, typing sets all', async () => {
        await two();
        const before = await now();
        await dragBy(page, field(page, 'translation x'), 60, 0);
        const dragged = await when((d) => placeOf(d, 'ball')[0] !== -1.5, 'the drag');
        await waitForSaved(page);
        const after = await now();
        const far = placeOf(after, 'ball')[0] - placeOf(before, 'ball')[0];
        assert.ok(Math.abs(placeOf(after, 'crate')[0] - placeOf(before, 'crate')[0] - far) < 1e-5);
        assert.ok(dragged);
        const x = field(page, 'translation x');
        await x.fill('2');
        await x.press('Enter');
        await when(
            (d) => placeOf(d, 'ball')[0] === 2 && placeOf(d, 'crate')[0] === 2,
            'the same x for both',
        );
        await valueIs(x, '2');
        await x.press('Control+z');
        await x.press('Control+z');
        await when((d) => placeOf(d, 'crate')[0] === 1.5, 'both as they were');
        assert.deepEqual(placeOf(await now(), 'ball'), [-1.5, 0, 0]);
    });
});

describe('materials', () => {
    test('another shader keeps the colour, and says what it has no place for', async () => {
        const document = structuredClone(SCENE);
        document.materials.clay.properties = { diffuse: [0.1, 0.2, 0.9], specular: [1, 1, 1] };
        await open({ document });
        await page.locator('[data-resource=clay] .resource-pick').click();
        await page.getByRole('combobox', { name: 'Shader' }).click();
        await page.getByRole('option', { name: 'Standard' }).click();
        const standard = await when((d) => d.materials.clay.shader === 'standard', 'the shader');
        assert.deepEqual(standard.materials.clay.properties, { base_color: [0.1, 0.2, 0.9] });
        const notice = page.locator('.notice', { hasText: 'Standard has no specular' });
        await notice.getByRole('button', { name: 'Undo' }).click();
        await when((d) => d.materials.clay.properties.specular, 'all of it again');
    });
});

describe('what materials are', () => {
    test('every preset makes a material that the server takes, and opens it', async () => {
        await open();
        const add = page.getByRole('button', { name: 'Add a material' });
        await add.click();
        await page.locator('.gallery-tile').first().waitFor();
        const names = await page
            .locator('.gallery-tile')
            .evaluateAll((tiles) => tiles.map((tile) => tile.dataset.preset));
        assert.equal(names.length, 31);
        await page.keyboard.press('Escape');
        for (const name of names) {
            await page.getByTestId('gallery').waitFor({ state: 'detached' });
            await add.click();
            await page.locator(`[data-preset="${name}"]`).click();
            const wanted = name === 'clay' ? 'clay-1' : name;
            await when((d) => wanted in d.materials, `the material ${wanted}`);
            await page.locator(`[data-resource="${wanted}"][data-selected]`).waitFor();
            await page.locator('[data-param] .colour-button').first().waitFor();
        }
        assert.equal(await page.locator('.notice[data-level=error]').count(), 0);
    });

    test('what uses a material is named as people named it', async () => {
        const document = structuredClone(SCENE);
        document.root.children[0].name = 'Mug';
        await open({ document });
        await page.locator('[data-resource=clay] .resource-pick').click();
        await page.locator('.user-list').getByRole('button', { name: 'Mug' }).click();
        await selectedIs('ball');
    });
});

describe('palettes', () => {
    /** Presses keys one after the other, before the page can draw. */
    const press = (...keys) =>
        page.evaluate((all) => {
            for (const [key, ctrlKey, shiftKey] of all) {
                const code = `Key${key.toUpperCase()}`;
                const init = { key, code, ctrlKey, shiftKey, bubbles: true, cancelable: true };
                document.activeElement.dispatchEvent(new KeyboardEvent('keydown', init));
            }
        }, keys);

    test('keys that follow at once go into the search, and into no command', async () => {
        await open();
        await row(page, 'ball').click();
        await row(page, 'ball').focus();
        await press(['k', true, false], ['z'], ['h'], ['d'], ['Backspace']);
        const search = page.getByRole('combobox', { name: 'Search and commands' });
        await search.waitFor();
        await valueIs(search, 'zh');
        await page.keyboard.press('Escape');
        await page.getByRole('dialog').waitFor({ state: 'detached' });
        await row(page, 'ball').focus();
        await press(['A', false, true], ...[...'donut'].map((key) => [key]), ['Enter']);
        const d = await when((one) => nodeIn(one, 'torus-1'), 'the torus');
        assert.equal(nodeIn(d, 'ball').visible, undefined);
        await page.getByRole('dialog').waitFor({ state: 'detached' });
        await page.getByRole('button', { name: 'Output shown: Colour' }).waitFor();
    });

    test('what is not there is told', async () => {
        await open();
        await page.keyboard.press('Control+k');
        await page.getByRole('combobox', { name: 'Search and commands' }).fill('mesh');
        await page.getByText('There are no meshes').waitFor();
        await page.keyboard.press('Escape');
    });

    test('a setting of the backdrop is found by its name', async () => {
        await open();
        await page.keyboard.press('Control+k');
        await page.getByRole('combobox', { name: 'Search and commands' }).fill('floor');
        await page.locator('[data-entry=setup-environment-floor]').getByText('Backdrop').waitFor();
        await page.locator('[data-entry=setup-environment-floor]').click();
        await page.getByRole('switch', { name: 'floor shown' }).waitFor();
    });

    test('Escape closes a dialog, also where a tip is shown in it', async () => {
        await open();
        await page.keyboard.press('Control+Shift+S');
        const dialog = page.getByRole('dialog');
        await dialog.waitFor();
        await dialog.getByRole('button', { name: 'Close' }).hover();
        await page.locator('.tip').waitFor();
        await page.keyboard.press('Escape');
        await dialog.waitFor({ state: 'detached' });
    });
});

describe('by touch', () => {
    test('hints speak of taps, and a tapped shape opens its values', async () => {
        await open({ width: 390, height: 844, touch: true, hints: true });
        await settled(page);
        await page.getByRole('tab', { name: 'Edit' }).click();
        await page.getByText('Tap something in the picture').waitFor();
        await page.getByRole('tab', { name: 'Nodes' }).click();
        const box = await picture(page).boundingBox();
        await page.touchscreen.tap(box.x + box.width * 0.2, box.y + box.height / 2);
        await page.getByRole('tab', { name: 'Edit', selected: true }).waitFor();
        await page.getByTestId('inspector').waitFor();
        const { x, width } = await page.getByTestId('outputs').boundingBox();
        assert.ok(x + width <= 390, `the outputs end at ${x + width}`);
    });

    test('what moves below a finger that taps is not pressed', async () => {
        await open({ width: 390, height: 844, touch: true });
        await page.evaluate(() => {
            window.clicked = [];
            const tell = ({ target }) => window.clicked.push(target.ariaLabel ?? target.className);
            window.addEventListener('click', tell, true);
        });
        const grip = page.getByRole('button', { name: 'Panel height' });
        const height = async () => (await picture(page).boundingBox()).height;
        await page.getByRole('tab', { name: 'Edit' }).tap();
        const middle = await height();
        await grip.tap();
        await until(async () => (await height()) < middle, 'a tall sheet');
        await grip.tap();
        await until(async () => (await height()) > middle, 'a low sheet');
        await settled(page);
        const box = await picture(page).boundingBox();
        await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height * 0.8);
        await page.getByTestId('inspector').getByPlaceholder('pole').waitFor();
        await until(async () => (await height()) === middle, 'the values of what was tapped');
        await page.getByRole('tab', { name: 'Nodes' }).tap();
        assert.deepEqual(await page.evaluate(() => window.clicked.filter((one) => one !== 'tab')), ['Panel height', 'Panel height']);
    });
});

describe('words for numbers', () => {
    test('0 is "auto" where it stands for that, and comes back as 0', async () => {
        await open();
        await page.getByRole('button', { name: 'Render', exact: true }).click();
        const samples = field(page, 'occlusion samples');
        await valueIs(samples, 'auto');
        await samples.fill('3');
        await samples.press('Enter');
        await when((d) => d.render.occlusion_samples === 3, 'three samples');
        await samples.fill('auto');
        await samples.press('Enter');
        await when((d) => d.render.occlusion_samples === 0, 'as the level says');
        await valueIs(samples, 'auto');
    });

    test('a pressed button says what holds', async () => {
        await open();
        await row(page, 'ball').click();
        const link = page.getByRole('button', { name: 'Same on all axes' });
        assert.equal(await link.getAttribute('aria-pressed'), 'true');
        await link.click();
        await field(page, 'scale z').waitFor();
        assert.equal(await link.getAttribute('aria-pressed'), 'false');
    });
});

describe('adding', () => {
    const MUG = {
        format: 'fieldcast/1',
        name: 'Mug',
        root: {
            id: 'root',
            type: 'union',
            children: [
                {
                    id: 'mug',
                    name: 'Mug',
                    type: 'difference',
                    children: [
                        { id: 'outer', type: 'cylinder' },
                        { id: 'inner', type: 'sphere' },
                    ],
                },
            ],
        },
    };

    async function add(words) {
        await page.keyboard.press('Shift+A');
        await page.getByRole('combobox').fill(words);
        await page.locator('[role=option][data-type=torus][aria-selected=true]').waitFor();
    }

    test('beside a difference, or as a cut when that is chosen', async () => {
        await open({ document: MUG });
        await row(page, 'mug').click();
        await add('donut');
        const foot = page.locator('.palette-foot');
        await foot.getByText('Beside Mug.').waitFor();
        await page.keyboard.press('Enter');
        const beside = await when((d) => nodeIn(d, 'torus-1'), 'the torus');
        assert.deepEqual(
            beside.root.children.map((one) => one.id),
            ['mug', 'torus-1'],
        );
        assert.equal(nodeIn(beside, 'torus-1').name, 'Torus');
        await row(page, 'outer').click();
        await add('donut');
        const ways = foot.getByRole('group', { name: 'as:' });
        const edge = async () => (({ x, width }) => x + width)(await ways.boundingBox());
        const before = await edge();
        await foot.getByRole('button', { name: 'smooth cut' }).click();
        const words = foot.getByText('Cuts outer, in a new smooth difference.');
        assert.equal(await edge(), before, 'the ways stay where they are');
        assert.ok(await words.evaluate((one) => one.scrollWidth <= one.clientWidth), 'words that can be read');
        await page.keyboard.press('Escape');
        await row(page, 'mug').click();
        await add('donut');
        await foot.getByRole('button', { name: 'cut', exact: true }).click();
        await foot.getByText('Cuts Mug.').waitFor();
        await page.keyboard.press('Enter');
        await when((d) => nodeIn(d, 'mug').children.length === 3, 'the cut');
        assert.deepEqual(await rows(page), [
            'root',
            'mug',
            'outer',
            'inner',
            'torus-2',
            'torus-1',
        ]);
        await add('donut');
        assert.equal(
            await foot.locator('[aria-pressed=true]').getAttribute('data-way'),
            'cut',
        );
    });
});

test('the bar stays where it is while the scene is renamed', async () => {
    await open();
    const add = page.locator('[data-command="node.add"]');
    const before = await add.boundingBox();
    await page.locator('.bar-name .button').click();
    await page.getByRole('menuitem', { name: 'Rename' }).click();
    const input = page.getByRole('textbox', { name: 'Name of the scene' });
    await input.waitFor();
    assert.deepEqual(await add.boundingBox(), before);
    const named = await input.boundingBox();
    await input.fill('A table with a longer name');
    assert.ok((await input.boundingBox()).width > named.width + 50, 'it grows with the name');
    await input.press('Enter');
    await page.locator('.bar-name .button:focus', { hasText: 'A table with' }).waitFor();
    assert.equal(await page.getByRole('menu').count(), 0);
});
