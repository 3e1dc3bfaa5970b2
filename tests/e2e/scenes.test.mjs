// SPDX-License-Identifier: MIT
// The start page: examples, files up and down, names, deleting with a way back.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { EXAMPLES } from '../support/counts.mjs';
import { ask, until } from '../support/daemon.mjs';
import { picturesIn, readDownload, SCENE, settled, useStage } from './stage.mjs';

const stage = useStage({ driver: 'null', coarse: true });
let page;

const scenes = async () => (await ask(stage.daemon, 'GET', '/v1/scenes')).scenes;
const card = (id) => page.locator(`[data-scene="${id}"]`);
const act = async (id, name, what) => {
    await card(id).getByRole('button', { name: `Actions for ${name}` }).click();
    await page.getByRole('menuitem', { name: what, exact: true }).click();
};

/* The browser itself reports the status of refused requests. */
/** At any time: the console may tell of one after the page has. */
const expectRefusals = () => {
    page.expected = /status of 4\d\d/;
};
const choose = async (button, files) => {
    const [chooser] = await Promise.all([
        page.waitForEvent('filechooser'),
        page.getByRole('button', { name: button }).click(),
    ]);
    await chooser.setFiles(files);
};
const json = (name, text) => ({ name, mimeType: 'application/json', buffer: Buffer.from(text) });

test('an example opens as a copy and shows a picture', async () => {
    page = await stage.page();
    await page.locator('[data-example=first-steps] button').click();
    await page.locator('[role=treeitem]').first().waitFor();
    await settled(page);
    const [scene] = await scenes();
    assert.match(page.url(), new RegExp(`/s/${scene.id}$`));
    assert.deepEqual(
        JSON.parse(await stage.document(scene.id)),
        await ask(stage.daemon, 'GET', '/v1/examples/first-steps'),
    );
    await page.getByRole('link', { name: 'All scenes' }).click();
    await card(scene.id).waitFor();
});

test('every example has a card; those in sight get a picture', async () => {
    page = await stage.page();
    const { examples } = await ask(stage.daemon, 'GET', '/v1/examples');
    assert.equal(examples.length, EXAMPLES);
    await page.locator('[data-example]').nth(examples.length - 1).waitFor();
    const groups = await page
        .locator('[data-group]')
        .evaluateAll((all) => all.map((one) => one.dataset.group));
    assert.deepEqual(groups, ['showpiece', 'lesson', 'shape', 'combine', 'modify', 'repeat', 'surface']);
    const lessons = examples.filter(({ group }) => group === 'lesson').map(({ id }) => id);
    assert.deepEqual(lessons, [
        'first-steps',
        'lecture-1-shapes',
        'lecture-2-booleans',
        'lecture-3-light',
        'lecture-4-transforms',
        'lecture-5-camera',
        'own-code',
    ]);
    for (const title of await page.locator('.scenes-group').allTextContents()) {
        assert.doesNotMatch(title, /examples\./, 'every group has a title');
    }
    const search = page.getByLabel('Search scenes and examples');
    await search.fill('lecture');
    await page.locator('[data-example=bend]').waitFor({ state: 'detached' });
    assert.deepEqual(
        await page
            .locator('[data-example]')
            .evaluateAll((all) => all.map((one) => one.dataset.example.split('-')[0])),
        new Array(5).fill('lecture'),
    );
    await search.fill('');
    await page.locator('[data-example=bend]').waitFor();
    for (const { id, name } of examples) {
        assert.ok((await page.locator(`[data-example="${id}"]`).textContent()).includes(name));
    }
    const { seen, shown } = await picturesIn(page, '[data-example]');
    assert.ok(seen > 3 && shown === seen, `${shown} of ${seen} pictures in sight`);
});

test('of many scenes the newest are shown; the search finds all of them', async () => {
    for (let i = 0; i < 12; i += 1) {
        await stage.scene({ ...SCENE, name: i === 0 ? 'Oldest of all' : `Room ${i}` });
    }
    page = await stage.page();
    const own = page.locator('[data-scene]');
    await until(async () => (await own.count()) === 8, 'eight cards');
    const { length } = await scenes();
    await page.getByLabel('Search scenes and examples').fill('oldest');
    await until(async () => (await own.count()) === 1, 'one card');
    await own.getByText('Oldest of all').waitFor();
    await page.getByLabel('Search scenes and examples').fill('');
    await page.getByRole('button', { name: `Show all ${length}` }).click();
    await until(async () => (await own.count()) === length, 'all cards');
    assert.equal(await page.locator('.scenes-all').count(), 0);
});

test('a picture drifts while it is pointed at, but not where motion is unwanted', async () => {
    page = await stage.page();
    const image = page.locator('[data-example] img:not([hidden])').first();
    await image.waitFor();
    const scale = () => image.evaluate((one) => getComputedStyle(one).scale);
    await image.hover();
    assert.equal(await scale(), 'none');
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    const first = await until(async () => (await scale()) !== 'none' && scale(), 'a picture that moves');
    assert.ok(Number(first) < 1.14, `${first}: not at once`);
    await until(async () => (await scale()) > first, 'a picture that goes on moving');
});

test('a new scene is empty and says what to do', async () => {
    page = await stage.page();
    await page.getByRole('button', { name: 'New scene' }).first().click();
    await page.getByRole('button', { name: 'Add a shape' }).click();
    await page.getByRole('combobox').fill('ball');
    await page.keyboard.press('Enter');
    await page.locator('[data-node=sphere-1]').waitFor();
    await page.getByText('This scene is empty.').waitFor({ state: 'detached' });
    const { lights } = JSON.parse(await stage.document(page.url().split('/').at(-1)));
    assert.equal(lights.length, 1, 'and the first shape stands in the light');
});

test('a document that goes down and up again is the same document', async () => {
    const id = await stage.scene();
    page = await stage.page({ scene: id });
    await page.getByRole('button', { name: 'Table', exact: true }).click();
    const [file] = await Promise.all([
        page.waitForEvent('download'),
        page.getByRole('menuitem', { name: 'Download JSON' }).click(),
    ]);
    assert.equal(file.suggestedFilename(), 'Table.json');
    const text = await readDownload(file);
    await page.getByRole('link', { name: 'All scenes' }).click();
    await choose('Upload', json('up.json', text));
    await page.waitForURL((url) => url.pathname.startsWith('/s/') && !url.pathname.endsWith(id));
    const copy = page.url().split('/').at(-1);
    assert.equal(await stage.document(copy), await stage.document(id));
});

test('a dropped file opens; a bad one is refused with its place', async () => {
    page = await stage.page();
    await page.locator('main').waitFor();
    const drop = (text) =>
        page.evaluate((content) => {
            const data = new DataTransfer();
            data.items.add(new File([content], 'dropped.json', { type: 'application/json' }));
            const target = document.querySelector('main');
            for (const type of ['dragover', 'drop']) {
                const init = { bubbles: true, cancelable: true, dataTransfer: data };
                target.dispatchEvent(new DragEvent(type, init));
            }
        }, text);
    const bad = structuredClone(SCENE);
    bad.root.children[0].params.radius = -1;
    await drop(JSON.stringify(bad));
    await page.getByText('/nodes/ball/params/radius').waitFor();
    await page.getByTestId('import-fault').getByText('dropped.json').waitFor();
    await page.getByTestId('import-fault').getByRole('button', { name: 'Close' }).click();
    expectRefusals();
    await drop(JSON.stringify(SCENE));
    await page.locator('[data-node=ball]').waitFor();
});

const SPHERES = '{"scene": [{"type": "Primitives/Sphere"}]}';

test('a folder of the other format becomes a scene; what was put right is told', async () => {
    page = await stage.page();
    await choose('Import a folder', fileURLToPath(new URL('../import/thesis', import.meta.url)));
    await page.locator('[role=treeitem]').first().waitFor();
    await page.getByText(/Cena1.json:8:1: read as a member/).waitFor();
    const { models, shaders } = JSON.parse(await stage.document(page.url().split('/').at(-1)));
    assert.ok(models.Esfera && shaders['Blend-Shader']);
    await page.locator('[data-resource=Esfera]').waitFor();
});

test('files that cannot be read say where; of several scenes one is chosen', async () => {
    page = await stage.page();
    const wrong = '{\n  "model": {"type": "Primitives/Sphere" 5}\n}\n';
    await choose('Upload', [json('main.json', SPHERES), json('broken.json', wrong)]);
    const fault = page.getByTestId('import-fault');
    await fault.getByText('broken.json').waitFor();
    await fault.getByText(/^line 2, column/).waitFor();
    await fault.getByText('"model": {"type": "Primitives/Sphere" 5}').waitFor();
    await fault.getByRole('button', { name: 'Close' }).click();
    expectRefusals();
    await choose('Upload', [json('one.json', SPHERES), json('two.json', SPHERES)]);
    await page.getByRole('dialog', { name: 'Which scene?' }).waitFor();
    await fault.getByRole('button', { name: 'two' }).click();
    await page.locator('[data-type=sphere]').waitFor();
    expectRefusals();
});

test('an address without a scene says so, without tools, and leads to the scenes', async () => {
    page = await stage.page();
    page.expected = /404|WebSocket/;
    await page.goto(`${stage.site}/s/nowhere`);
    await page.getByRole('heading', { name: /^There is no such scene/ }).waitFor();
    assert.equal(await page.getByRole('button').count(), 1);
    await page.getByRole('button', { name: 'All scenes' }).click();
    await page.getByRole('heading', { name: 'Your scenes' }).waitFor();
});

test('names of examples are whole on a phone', async () => {
    page = await stage.page({ width: 390, height: 844, touch: true });
    await page.locator('[data-example]').first().waitFor();
    const cut = await page
        .locator('[data-example] .card-name')
        .evaluateAll((all) => all.filter((one) => one.scrollHeight > one.clientHeight + 1).map((one) => one.textContent));
    assert.deepEqual(cut, []);
});

test('rename, duplicate, delete and take it back', async () => {
    const id = await stage.scene();
    page = await stage.page();
    await act(id, 'Table', 'Rename');
    await page.getByLabel('New name of Table').fill('Desk');
    await page.keyboard.press('Enter');
    await card(id).getByText('Desk').waitFor();
    assert.equal(JSON.parse(await stage.document(id)).name, 'Desk');
    const many = (await scenes()).length;
    expectRefusals(); // a picture may be asked for while its scene goes
    await act(id, 'Desk', 'Duplicate');
    await until(async () => (await scenes()).length === many + 1, 'the copy');
    await act(id, 'Desk', 'Delete');
    await card(id).waitFor({ state: 'detached' });
    await page.getByRole('button', { name: 'Undo' }).click();
    await card(id).waitFor();
    assert.ok((await scenes()).some((scene) => scene.id === id));
    await act(id, 'Desk', 'Delete');
    await until(async () => !(await scenes()).some((scene) => scene.id === id), 'the deletion');
});
