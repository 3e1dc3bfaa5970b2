// SPDX-License-Identifier: MIT
// Every panel, dialog, menu and state of the page: its name, and how to come there. Of a group the
// states come in a row on one page; `alone` has a page and a copy of the scene for itself.
import path from 'node:path';
import { field, picture, row } from '../stage.mjs';
import { algebraStates } from './algebra.mjs';
import { handStates } from './hands.mjs';
import { CODED, EMPTY, STUDIO } from './scene.mjs';
import { textStates } from './text.mjs';

const examples = new URL('../../../protocol/examples/', import.meta.url).pathname;

/* --- ways --- */

const tab = async (page, name) => {
    const found = page.getByRole('tab', { name, exact: true });
    if ((await found.count()) > 0) {
        await found.click();
    }
};
const inspector = (page) => tab(page, 'Edit');

async function select(page, ...ids) {
    await tab(page, 'Nodes');
    for (const [i, id] of ids.entries()) {
        await row(page, id).click(i > 0 ? { modifiers: ['Control'] } : {});
    }
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

async function resource(page, name) {
    await tab(page, 'Looks');
    await page.locator(`[data-resource="${name}"] .resource-pick`).click();
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

async function setup(page, name) {
    await tab(page, 'Looks');
    await page.getByRole('button', { name, exact: true }).click();
    await inspector(page);
    await page.getByTestId('inspector').waitFor();
}

const bottom = (page) =>
    page.getByTestId('inspector').evaluate((one) => one.scrollTo(0, one.scrollHeight));
const key = (keys) => (page) => page.keyboard.press(keys);
const popup = (page, role = 'menu') => page.getByRole(role).first().waitFor();

async function search(page, keys, text) {
    await page.keyboard.press(keys);
    await page.getByRole('combobox').fill(text);
}

async function openCode(page) {
    await resource(page, 'egg');
    await page.getByRole('button', { name: 'Edit code' }).click();
    await page.locator('.cm-content').waitFor();
}

async function write(page, text) {
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(text);
}

const WRONG = 'float sdf(vec3 p) {\n    float d = length(p);\n    return d - radios;\n}\n';

async function middle(page, x = 0.5, y = 0.5) {
    const box = await picture(page).boundingBox();
    return [box.x + x * box.width, box.y + y * box.height];
}

async function setRadius(page, text) {
    await select(page, 'ball');
    await field(page, 'radius').fill(text);
    await field(page, 'radius').press('Enter');
}

/* As the server says it. */
const STAYS = 'The last good picture stays.';
const TOO_SLOW = `This code took over 2 s to compile here (limit 2 s). ${STAYS}`;
const CRASHED = `Compiling this code ended the render process. ${STAYS}`;

const LATER = 'It is not drawn until it is edited or tried again.';
const LEFT_OUT = `Drawing the smallest part of this scene took over 0.9 s here (limit 0.5 s). ${LATER}`;
const ENDED = `Drawing this scene ended the render process. ${LATER}`;

const BINARY_FLAGS = 6;
const LOSSLESS = 4;
const STALE = 8;
const isFrame = (message) => typeof message !== 'string';

/* --- the page with the scenes --- */

const file = (name, text) => ({ name, mimeType: 'application/json', buffer: Buffer.from(text) });

async function choose(page, button, files) {
    const asked = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: button }).click();
    await (await asked).setFiles(files);
}

const SPHERES = '{"scene": [{"type": "Primitives/Sphere"}]}';
const BROKEN = '{\n  "model": {"type": "Primitives/Sphere" 5}\n}\n';

const START = [
    ['start', (page) => page.locator('[data-example] img:not([hidden])').nth(3).waitFor()],
    ['start, examples', (page) => page.getByTestId('examples').evaluate((one) => one.scrollIntoView())],
    ['start, search', (page) => page.getByPlaceholder('Search scenes and examples').fill('glass')],
    ['start, nothing found', (page) => page.getByPlaceholder('Search scenes and examples').fill('xyzzy')],
    ['start, menu of a scene', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await popup(page);
    }],
    ['start, rename', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await page.getByRole('menuitem', { name: 'Rename' }).click();
        await page.getByLabel(/^New name of/).waitFor();
    }],
    ['start, deleted', async (page) => {
        await page.locator('[data-scene] .icon-button').first().click();
        await page.getByRole('menuitem', { name: 'Delete' }).click();
        await page.getByRole('button', { name: 'Undo' }).waitFor();
    }, { clean: (page) => page.getByRole('button', { name: 'Undo' }).click() }],
    ['start, keys', async (page) => {
        await page.keyboard.press('?');
        await popup(page, 'dialog');
    }],
    ['start, drop', async (page) => {
        await page.locator('.scenes').waitFor();
        await page.evaluate(() => {
            const data = new DataTransfer();
            data.items.add(new File(['{}'], 'scene.json', { type: 'application/json' }));
            for (const type of ['dragenter', 'dragover']) {
                document.querySelector('.scenes').dispatchEvent(
                    new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }),
                );
            }
        });
        await page.locator('.drop-cover').waitFor();
    }, { alone: true }],
    ['start, files refused', async (page) => {
        page.expected = /status of 4/;
        await choose(page, 'Upload', [file('main.json', SPHERES), file('broken.json', BROKEN)]);
        await page.getByTestId('import-fault').getByText(/^line 2/).waitFor();
    }, { alone: true }],
    ['start, which scene', async (page) => {
        page.expected = /status of 4/;
        await choose(page, 'Upload', [file('one.json', SPHERES), file('two.json', SPHERES)]);
        await page.getByRole('dialog', { name: 'Which scene?' }).waitFor();
    }, { alone: true }],
    ['start, no scenes yet', async (page) => {
        await page.route('**/v1/scenes', (route) => route.fulfill({ json: { scenes: [] } }));
        await page.reload();
        await page.locator('[data-example]').first().waitFor();
    }, { alone: true }],
    ['start, no answer', async (page) => {
        page.expected = /Failed to load|ERR_FAILED/;
        await page.route('**/v1/scenes', (route) => route.abort());
        await page.reload();
        await page.locator('.page-note').waitFor();
    }, { alone: true }],
];

/* --- the editor --- */

const FORMS = [
    ['editor', async () => {}],
    ['tooltip', async (page) => {
        await page.locator('[data-command="edit.undo"]').hover();
        await page.locator('.tip').waitFor();
    }],
    ['shape', (page) => select(page, 'ball')],
    ['shape with points', async (page) => {
        await select(page, 'outline');
        await page.getByRole('button', { name: /^point 1:/ }).waitFor();
    }],
    ['operation', (page) => select(page, 'jug')],
    ['modifier', (page) => select(page, 'pillar')],
    ['repetition', (page) => select(page, 'beads')],
    ['repetition about an axis', (page) => select(page, 'crown')],
    ['extrusion', (page) => select(page, 'solid')],
    ['instance of a model', (page) => select(page, 'pawn-1')],
    ['several nodes', (page) => select(page, 'ball', 'block')],
    ['many nodes', (page) => select(page, 'jug', 'pillar', 'beads', 'crown', 'solid', 'pawn-1', 'floor')],
    ['type of a node', async (page) => {
        await select(page, 'ball');
        await page.getByRole('combobox', { name: 'Type', exact: true }).click();
        await popup(page, 'listbox');
    }],
    ['not a number', async (page) => {
        await select(page, 'ball');
        await field(page, 'radius').fill('1,5 apples');
        await field(page, 'radius').press('Enter');
        await page.locator('.form-error').first().waitFor();
    }, { clean: async (page) => field(page, 'radius').press('Escape') }],
    ['material, phong', (page) => resource(page, 'clay')],
    ['material, blinn', (page) => resource(page, 'glaze')],
    ['material, standard', (page) => resource(page, 'gold')],
    ['material, unlit', (page) => resource(page, 'lamp')],
    ['material, checker', (page) => resource(page, 'tiles')],
    ['material, normals', (page) => resource(page, 'facing')],
    ['material, long name', (page) => resource(page, 'a-material-with-quite-a-long-name-for-a-narrow-list')],
    ['colour', async (page) => {
        await resource(page, 'clay');
        await page.locator('[data-param=diffuse] .colour-button').click();
        await page.getByLabel('diffuse Hex').waitFor();
    }],
    ['new material', async (page) => {
        await tab(page, 'Looks');
        await page.getByRole('button', { name: 'Add a material', exact: true }).first().click();
        await popup(page);
    }],
    ['new light', async (page) => {
        await tab(page, 'Looks');
        await page.getByRole('button', { name: 'Add a light', exact: true }).first().click();
        await popup(page);
    }],
    ['light, directional', (page) => resource(page, 'sun')],
    ['light, point', (page) => resource(page, 'window')],
    ['light, spot', (page) => resource(page, 'spot')],
    ['volume', (page) => resource(page, 'mist')],
    ['volume, end of the form', async (page) => {
        await resource(page, 'mist');
        await bottom(page);
    }],
    ['model', (page) => resource(page, 'pawn')],
    ['camera', (page) => setup(page, 'Camera')],
    ['backdrop', (page) => setup(page, 'Backdrop')],
    ['backdrop, end of the form', async (page) => {
        await setup(page, 'Backdrop');
        await bottom(page);
    }],
    ['render', (page) => setup(page, 'Render')],
    ['render, end of the form', async (page) => {
        await setup(page, 'Render');
        await bottom(page);
    }],
    ['resources, end of the lists', async (page) => {
        await tab(page, 'Looks');
        await page.locator('.resources').evaluate((one) => one.scrollTo(0, one.scrollHeight));
    }],
];

const CODED_FORMS = [
    ['field', (page) => select(page, 'egg-1')],
    ['node, end of the form', async (page) => {
        await select(page, 'egg-1');
        await bottom(page);
    }],
    ['material, own shader', (page) => resource(page, 'veined')],
    ['menu of a resource', async (page) => {
        await resource(page, 'egg');
        await page.getByRole('button', { name: 'More actions' }).click();
        await popup(page);
    }],
    ['primitive', async (page) => {
        await resource(page, 'egg');
        await page.getByRole('button', { name: 'More of radius' }).click();
        await page.getByRole('spinbutton', { name: 'default of radius' }).waitFor();
    }],
    ['shader', (page) => resource(page, 'marble')],
];

const MATTER = { shader: 'standard', properties: { base_color: [0.6, 0.24, 0.13], roughness: 0.6 } };
const GOLD = { shader: 'standard', properties: { base_color: [1, 0.77, 0.34], metallic: 1, roughness: 0.2 } };
const made = (name, kind, root, materials = { clay: MATTER }) => ({
    kind,
    document: { format: 'fieldcast/1', name, materials, root: { material: Object.keys(materials)[0], ...root } },
});
const MUG = {
    type: 'difference',
    children: [
        { type: 'smooth_union', params: { k: 0.1 }, children: [
            { type: 'round_cylinder' },
            { type: 'torus', transform: { translation: [0.6, 0, 0], rotation: [1.57, 0, 0], scale: 0.45 } },
        ] },
        { type: 'cylinder', params: { radius: 0.4 }, transform: { translation: [0, 0.2, 0] } },
    ],
};
const LIBRARY = [
    made('Mug', 'model', MUG),
    made('Ring of beads', 'model', { type: 'torus' }, { gold: GOLD }),
    made('A model with quite a long name for a narrow card', 'model', { type: 'box' }),
    made('Gold leaf', 'material', { type: 'sphere' }, { gold: GOLD }),
    made('Old clay', 'material', { type: 'sphere' }),
    made('Heart', 'primitive', { type: 'implicit', params: { equation: '(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3 = 0' } }),
];

/** Puts things into the library, all of which are drawn before they are looked at. */
async function fillLibrary(page) {
    await page.evaluate(async (entries) => {
        const { entries: old } = await (await fetch('/v1/library')).json();
        const headers = { 'Content-Type': 'application/json' };
        const body = JSON.stringify({ format: 'fieldcast-library/1', entries });
        if (old.length === 0) {
            await fetch('/v1/library', { method: 'POST', headers, body });
        }
    }, LIBRARY);
}

async function library(page) {
    await fillLibrary(page);
    await page.locator('.bar-name .button').click();
    await page.getByRole('menuitem', { name: 'My library' }).click();
    await page.getByTestId('library').waitFor();
    await page.locator('[data-testid=library] img:not([hidden])').nth(3).waitFor();
}

/** The dialog that makes a primitive, with some numbers of the jug chosen. */
async function primitive(page, ...numbers) {
    await tab(page, 'Nodes');
    await row(page, 'jug').click({ button: 'right' });
    await page.getByRole('menuitem', { name: 'Make a primitive of it …' }).click();
    await page.getByTestId('primitive').waitFor();
    for (const name of numbers) {
        await page.getByRole('checkbox', { name: `${name} is a parameter` }).click();
    }
}

const DIALOGS = [
    ['primitive', (page) => primitive(page)],
    ['primitive, chosen', (page) => primitive(page, 'Jug smoothness', 'Ball radius', 'Block size')],
    ['primitive, wrong', async (page) => {
        await primitive(page, 'Ball radius');
        const name = page.getByLabel('Name of the parameter for radius');
        await name.fill('2 wide');
        await name.press('Enter');
        await page.locator('.primitive .form-error').waitFor();
    }],
    ['primitive, made', async (page) => {
        await primitive(page, 'Jug smoothness', 'Ball radius', 'Block size');
        await page.getByRole('button', { name: 'Make primitive' }).click();
        await inspector(page);
        await page.locator('[data-param="ball_radius"]').waitFor();
    }, { alone: true }],
    ['primitive, model', async (page) => {
        await primitive(page, 'Jug smoothness', 'Ball radius', 'Block size');
        await page.getByRole('button', { name: 'Make primitive' }).click();
        await inspector(page);
        await page.locator('[data-param="ball_radius"]').waitFor();
        await resource(page, 'Jug');
        await page.locator('.settings-row').first().waitFor();
    }, { alone: true }],
    ['library', library],
    ['library, search', async (page) => {
        await library(page);
        await page.getByTestId('library').getByRole('textbox').fill('gold');
    }],
    ['library, menu', async (page) => {
        await library(page);
        await page.getByRole('button', { name: 'Actions for Mug' }).click();
        await popup(page);
    }],
    ['library, empty', async (page) => {
        await page.route('**/v1/library', (route) => route.fulfill({ json: { entries: [] } }));
        await page.locator('.bar-name .button').click();
        await page.getByRole('menuitem', { name: 'My library' }).click();
        await page.getByText('Nothing here yet.').waitFor();
    }, { alone: true }],
    ['library, saved', async (page) => {
        await tab(page, 'Nodes');
        await row(page, 'pillar').click({ button: 'right' });
        await page.getByRole('menuitem', { name: 'Save to My library' }).click();
        await page.locator('.notice[data-code="library"]').waitFor();
    }, { clean: (page) => page.locator('.notice[data-code="library"]').getByRole('button', { name: 'Undo' }).click() }],
    ['library, add', async (page) => {
        await fillLibrary(page);
        await page.keyboard.press('Shift+A');
        await page.locator('[data-type="library"]').last().scrollIntoViewIfNeeded();
        await page.locator('[data-type="library"] img:not([hidden])').nth(2).waitFor();
    }],
    ['library, materials', async (page) => {
        await fillLibrary(page);
        await tab(page, 'Looks');
        await page.getByRole('button', { name: 'Add a material', exact: true }).first().click();
        await page.locator('.gallery [data-entry] img:not([hidden])').first().waitFor();
    }],
    ['add', key('Shift+A'), {}],
    ['add, search', (page) => search(page, 'Shift+A', 'donut')],
    ['add, nothing found', (page) => search(page, 'Shift+A', 'xyzzy')],
    ['add beside a cut', async (page) => {
        await select(page, 'jug');
        await search(page, 'Shift+A', 'cone');
    }],
    ['wrap', async (page) => {
        await select(page, 'ball');
        await tab(page, 'Nodes');
        await row(page, 'ball').focus();
        await page.keyboard.press('w');
        await popup(page, 'dialog');
    }],
    ['commands', key('Control+k')],
    ['commands, search', (page) => search(page, 'Control+k', 'look')],
    ['commands, not there', (page) => search(page, 'Control+k', 'mesh')],
    ['commands, nothing found', (page) => search(page, 'Control+k', 'xyzzy')],
    ['keys', key('?')],
    ['reference', key('F1')],
    ['reference, a type', async (page) => {
        await select(page, 'crown');
        await page.keyboard.press('F1');
    }],
    ['picture as a file', async (page) => {
        await page.keyboard.press('Control+Shift+S');
        await page.getByRole('dialog').getByRole('button', { name: 'Download' }).waitFor();
    }],
    ['menu of the scene', async (page) => {
        await page.locator('.bar-name .button').click();
        await popup(page);
    }],
    ['name of the scene', async (page) => {
        await page.locator('.bar-name .button').click();
        await page.getByRole('menuitem', { name: 'Rename' }).click();
        await page.locator('.bar-name-input').waitFor();
    }],
    ['menu of a node', async (page) => {
        await tab(page, 'Nodes');
        await row(page, 'jug').click({ button: 'right' });
        await popup(page);
    }],
    ['landing of a shape', async (page) => {
        await search(page, 'Shift+A', 'cone');
        await page.locator('[data-type="cone"]').last().hover();
        await page.locator('[data-way="blend"]').click();
        await page.locator('[data-type="cone"]').last().hover();
        await page.mouse.down();
        const [x, y] = await middle(page, 0.47, 0.36);
        await page.mouse.move(x - 6, y, { steps: 3 });
        await page.mouse.move(x, y);
        await page.getByTestId('trial').locator('img').waitFor();
    }, { wide: true, clean: async (page) => {
        await page.mouse.move(5, 5, { steps: 2 });
        await page.mouse.up();
    } }],
    ['what is here', async (page) => {
        await page.mouse.click(...(await middle(page, 0.48, 0.45)), { button: 'right' });
        await page.getByRole('menuitem', { name: 'What is here' }).click();
        await page.getByRole('menu', { name: 'What is here' }).getByRole('menuitem').nth(1).waitFor();
    }],
    ['menu in the picture', async (page) => {
        await page.mouse.click(...(await middle(page)), { button: 'right' });
        await page.getByRole('menu').getByText('Duplicate').waitFor();
    }],
    ['outputs', async (page) => {
        await page.getByTestId('outputs').click();
        await popup(page);
    }],
    ['statistics', async (page) => {
        await page.getByTestId('statistics').click();
        await page.locator('.stats-table').first().waitFor();
    }],
    ['name of a node', async (page) => {
        await tab(page, 'Nodes');
        await row(page, 'jug').dblclick();
        await page.locator('.tree-rename').waitFor();
    }],
    ['tree, filter', async (page) => {
        await tab(page, 'Nodes');
        await page.locator('.tree-filter input').first().fill('ball');
    }, { clean: (page) => page.locator('.tree-filter input').first().fill('') }],
    ['tree, nothing found', async (page) => {
        await tab(page, 'Nodes');
        await page.locator('.tree-filter input').first().fill('xyzzy');
        await page.locator('.empty-note').first().waitFor();
    }, { clean: (page) => page.locator('.tree-filter input').first().fill('') }],
    ['aiming', async (page) => {
        await setup(page, 'Camera');
        await field(page, 'aperture').fill('0.05');
        await field(page, 'aperture').press('Enter');
        await page.locator('.inspector-acts .button').nth(2).click();
        await page.locator('.view-aim .view-hint').waitFor();
    }],
    ['isolated', async (page) => {
        await select(page, 'jug');
        await tab(page, 'Nodes');
        await row(page, 'jug').focus();
        await page.keyboard.press('Shift+H');
        await page.getByTestId('isolated').waitFor();
    }, { clean: (page) => page.getByRole('button', { name: 'Show all' }).click() }],
    ['section', async (page) => {
        await page.getByTestId('picture').focus();
        await page.keyboard.press('k');
        await page.getByTestId('section-arrow').waitFor();
    }, { clean: (page) => page.getByTestId('section').getByRole('button', { name: 'Show all' }).click() }],
    ['panels hidden', key('Control+\\'), { clean: key('Control+\\') }],
];

const CHANGES = [
    ['hidden', async (page) => {
        await select(page, 'jug');
        await tab(page, 'Nodes');
        await row(page, 'jug').focus();
        await page.keyboard.press('h');
        await row(page, 'jug').and(page.locator('[data-hidden]')).waitFor();
    }],
    ['deleted', async (page) => {
        await select(page, 'pillar');
        await tab(page, 'Nodes');
        await row(page, 'pillar').focus();
        await page.keyboard.press('Delete');
        await page.locator('.notice', { hasText: 'deleted' }).waitFor();
    }],
    ['several messages', async (page) => {
        await select(page, 'ball');
        await page.keyboard.press('Escape');
        page.tell({ type: 'notice', level: 'info', code: 'note', message: 'A scene took the render process too long. It is started anew; pictures come back in a moment.' });
        page.tell({ type: 'notice', level: 'warning', code: 'other', message: 'The disk is nearly full: 12 MiB are left for scenes.' });
        page.tell({ type: 'notice', level: 'error', code: 'refused', message: '600 visible shapes are above the maximum 512 that can be drawn.', place: '/nodes/jug' });
        await page.locator('.notice').nth(2).waitFor();
    }],
    ['waiting', async () => {}, { hold: isFrame, fresh: true }],
    ['behind', async (page) => {
        page.hold = isFrame;
        await setRadius(page, '0.5');
        await setRadius(page, '0.45');
        await page.locator('[data-testid=state][data-state=behind]').waitFor();
    }],
    ['compiling', async (page) => {
        page.hold = isFrame;
        page.tell({ type: 'compiling', revision: 2, over: false, elapsed_ms: 3000, expected_ms: 6000 });
        await page.locator('[data-testid=state][data-state=compiling]').waitFor();
    }],
    ['moving', async (page) => {
        const [x, y] = await middle(page);
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 60, y + 20, { steps: 6 });
        page.keepMoving(x + 60, y + 20);
        await page.locator('[data-testid=state][data-state=moving]').waitFor();
    }, { clean: (page) => page.restHand() }],
    ['refining', async (page) => {
        await page.locator('[data-testid=state][data-state=refining]').waitFor();
    }, { hold: (message) => isFrame(message) && (message[BINARY_FLAGS] & LOSSLESS) !== 0, fresh: true }],
    ['too slow', async (page) => {
        await setRadius(page, '0.5');
        page.change = stale;
        page.tell({ type: 'notice', level: 'error', code: 'too_slow', place: '/primitives/egg/code', measured: 4100, limit: 2000, message: TOO_SLOW });
        await turn(page);
        await page.locator('[data-testid=state][data-state=givenUp]').waitFor();
    }, { scene: CODED }],
    ['crashed', async (page) => {
        page.change = stale;
        page.tell({ type: 'notice', level: 'error', code: 'crashed', place: '/primitives/egg/code', message: CRASHED });
        await turn(page);
        await page.locator('[data-testid=state][data-state=givenUp]').waitFor();
    }, { scene: CODED }],
    ['left out', async (page) => {
        page.tell({ type: 'notice', level: 'error', code: 'scene_left_out', reason: 'too_slow', place: '/nodes/root', measured: 900, limit: 500, message: LEFT_OUT });
        await page.locator('[data-testid=state][data-state=givenUp]').waitFor();
    }, { hold: isFrame, fresh: true }],
    ['left out after a picture', async (page) => {
        page.hold = isFrame;
        await turn(page);
        page.tell({ type: 'notice', level: 'error', code: 'scene_left_out', reason: 'crashed', place: '/nodes/root', message: ENDED });
        await page.locator('[data-testid=state][data-state=givenUp]').waitFor();
    }],
    ['deleted by somebody else', async (page) => {
        await select(page, 'pillar');
        await page.ask('PATCH', [{ op: 'remove', at: '/nodes/pillar' }]);
        await page.locator('.notice[data-code=lost]').waitFor();
    }],
    ['another author', async (page) => {
        await setRadius(page, '0.4');
        await page.locator('[data-testid=saved][data-state=saved]').waitFor();
        await page.ask('PATCH', [{ op: 'set', at: '/nodes/ball/params/radius', value: 0.6 }]);
        await page.waitForFunction(() => document.querySelector('[data-param=radius] input')?.value === '0.6');
        await page.locator('[data-command="edit.undo"]').click();
        await page.locator('.notice[data-code=overwritten]').waitFor();
    }],
    ['offline', async (page) => {
        page.expected = /WebSocket|ERR_/;
        page.cut();
        await page.getByTestId('strip').getByText('Offline').waitFor();
        await setRadius(page, '0.5');
        await setRadius(page, '0.45');
        await page.getByText('Offline, 2 edits waiting').waitFor();
    }],
    ['refused', async (page) => {
        page.tell({ type: 'bye', reason: 'replaced' });
        page.cut();
        await page.getByTestId('strip').waitFor();
    }],
    ['carried row', async (page) => {
        await tab(page, 'Nodes');
        const from = await row(page, 'crown').boundingBox();
        const to = await row(page, 'pillar').boundingBox();
        await page.mouse.move(from.x + 60, from.y + from.height / 2);
        await page.mouse.down();
        await page.mouse.move(to.x + 60, to.y + 3, { steps: 8 });
        await page.mouse.move(to.x + 64, to.y + 2, { steps: 3 });
    }, { clean: (page) => page.mouse.up() }],
];

const turn = async (page) => {
    await picture(page).focus();
    await page.keyboard.press('ArrowLeft');
};

function stale(message) {
    if (isFrame(message)) {
        message[BINARY_FLAGS] |= STALE;
    }
    return message;
}

const CODE = [
    ['code', async (page) => {
        await openCode(page);
        await page.locator('.code-state[data-good]').waitFor();
    }],
    ['code with an error', async (page) => {
        await openCode(page);
        await write(page, WRONG);
        await page.getByTestId('broken').waitFor();
        await page.locator('.code-state[data-bad]').waitFor();
    }],
    ['code, too slow', async (page) => {
        await openCode(page);
        page.tell({ type: 'notice', level: 'error', code: 'too_slow', place: '/primitives/egg/code', measured: 4100, limit: 2000, message: TOO_SLOW });
        await page.locator('.notice').first().waitFor();
    }],
    ['code, begin', async (page) => {
        await tab(page, 'Looks');
        await page.getByRole('button', { name: 'Write a shader' }).first().click();
        await page.locator('.cm-content').waitFor();
    }],
    ['outputs, steps', async (page) => {
        await page.getByTestId('outputs').click();
        await page.getByRole('menuitemradio', { name: /^Steps/ }).click();
        await page.getByTestId('legend').waitFor();
        await page.getByRole('menu').waitFor({ state: 'detached' });
    }],
];

async function graph(page) {
    await page.keyboard.press('Alt+1');
    await page.locator('[data-card]').first().waitFor();
}

/** Takes hold of what a locator finds first, and keeps it. */
async function hold(page, found, dx, dy) {
    const box = await found.first().boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + dx, box.y + dy, { steps: 4 });
    await page.locator('.graph-say').waitFor();
}

const GRAPH = [
    ['graph', graph],
    ['graph, a node', async (page) => {
        await graph(page);
        await page.keyboard.press('F6');
        await page.locator('[data-card]').first().locator('header').click();
    }],
    ['graph, a wire held', async (page) => {
        await graph(page);
        await hold(page, page.locator('[data-grab="output"]'), -40, 60);
    }],
    ['graph, all of it', async (page) => {
        await graph(page);
        await page.getByRole('button', { name: 'Show the whole graph' }).click();
    }],
    ['graph and code', async (page) => {
        await openCode(page);
        await graph(page);
    }, { scene: CODED }],
];

const example = (name) => path.join(examples, `${name}.json`);

const OTHERS = [
    ['empty scene', async (page) => page.locator('.view-empty').waitFor(), { scene: EMPTY }],
    ['empty scene, Looks', async (page) => {
        await page.locator('.view-empty').waitFor();
        await tab(page, 'Looks');
    }, { scene: EMPTY }],
    ['hints', async (page) => page.locator('.view-hint').first().waitFor(), { scene: STUDIO, hints: true }],
    ['no such scene', async (page) => {
        page.expected = /404|WebSocket/;
        await page.getByTestId('strip').waitFor();
    }, { scene: null, path: '/s/nowhere' }],
    ['example, still life', async () => {}, { scene: example('still-life') }],
    ['example, duck', async () => {}, { scene: example('duck') }],
];

const rows = (group, list, more = {}) =>
    list.map(([name, go, options = {}]) => ({ group, name, go, ...more, ...options }));

/** `alone`: a page for itself; `tampered`: what the server says can be held back and added to. */
export const STATES = [
    ...rows('start', START, { scene: null }),
    ...rows('forms', FORMS, { scene: STUDIO }),
    ...rows('forms with code', CODED_FORMS, { scene: CODED }),
    ...rows('dialogs', DIALOGS, { scene: STUDIO }),
    ...rows('changes', CHANGES, { scene: STUDIO, alone: true, tampered: true }),
    ...rows('code', CODE, { scene: CODED, alone: true, tampered: true }),
    ...rows('hands', handStates({ select, middle, resource }), { scene: STUDIO, alone: true }),
    ...rows('algebra', algebraStates({ select }), { scene: STUDIO, alone: true }),
    ...rows('graph', GRAPH, { scene: STUDIO, alone: true }),
    ...rows('text', textStates({ select, tab, graph }), { scene: STUDIO, alone: true }),
    ...rows('others', OTHERS, { alone: true }),
];
