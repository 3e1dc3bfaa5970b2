// SPDX-License-Identifier: MIT
// States with a dialog, a palette or a menu open, and of tools of the picture: rows of states.mjs.
import { field, row } from '../stage.mjs';
import { LIBRARY } from './library.mjs';
import { inspector, key, middle, popup, resource, search, select, setup, tab } from './ways.mjs';

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

export const DIALOGS = [
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
    ['parameters of a model', async (page) => {
        await resource(page, 'pawn');
        await page.getByRole('button', { name: 'Choose parameters …' }).click();
        await page.getByTestId('primitive').waitFor();
    }],
    ['axes, pivot and steps', async (page) => {
        await page.getByRole('button', { name: 'Axes, pivot and steps' }).click();
        await popup(page);
    }],
    ['shelf', async (page) => {
        await tab(page, 'Nodes');
        await row(page, 'pillar').click({ button: 'right' });
        await page.getByRole('menuitem', { name: 'Put on the shelf' }).click();
        await page.getByRole('treeitem', { name: /Shelf/ }).waitFor();
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
    ['keys to change', async (page) => {
        await page.keyboard.press('?');
        await page.getByRole('switch', { name: 'Change keys' }).click();
        await page.getByRole('button', { name: /^Hide or show:/ }).click();
        await page.keyboard.press('Shift+M');
    }],
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
