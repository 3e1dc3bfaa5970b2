// SPDX-License-Identifier: MIT
// States of the inspector's forms and of the lists: rows of states.mjs.
import { field, row } from '../stage.mjs';
import { bottom, inspector, popup, resource, select, setup, tab } from './ways.mjs';

export const FORMS = [
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
    ['colour from the picture', async (page) => {
        await resource(page, 'clay');
        await page.locator('[data-param=diffuse] .colour-button').click();
        await page.getByLabel('diffuse Hex').waitFor();
        await page.getByRole('button', { name: 'Take from the picture' }).click();
    }],
    ['new material', async (page) => {
        await tab(page, 'Looks');
        await page.getByRole('button', { name: 'Add a material', exact: true }).first().click();
        await page.locator('.gallery [data-preset] img').nth(9).waitFor();
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
    ['backdrop, a picture', async (page) => {
        await setup(page, 'Backdrop');
        await page.getByRole('radio', { name: 'image' }).click();
        await page.locator('.asset').waitFor();
    }, { alone: true }],
    ['backdrop, fog and floor', async (page) => {
        await setup(page, 'Backdrop');
        await field(page, 'fog density').fill('0.05');
        await field(page, 'fog density').press('Enter');
        await page.getByRole('switch', { name: 'floor shown' }).click();
        await bottom(page);
    }, { alone: true }],
    ['camera, orthographic', async (page) => {
        await setup(page, 'Camera');
        await page.getByRole('radio', { name: 'orthographic' }).click();
        await field(page, 'height').waitFor();
    }, { alone: true }],
    ['part of a model', async (page) => {
        await resource(page, 'pawn');
        await page.getByRole('button', { name: 'Edit its parts' }).click();
        await inspector(page);
    }],
    ['materials of a node', async (page) => {
        await select(page, 'ball');
        await page.getByRole('combobox', { name: 'material', exact: true }).click();
        await popup(page, 'listbox');
    }],
    ['material tried', async (page) => {
        await select(page, 'pillar');
        await page.getByRole('button', { name: 'New material' }).click();
        await page.locator('[data-preset] img').nth(3).waitFor();
        await page.locator('[data-preset]').nth(3).hover();
        await page.getByTestId('trial').waitFor();
    }, { alone: true }],
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

export const CODED_FORMS = [
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
    ['primitive with code', async (page) => {
        await resource(page, 'egg');
        await page.getByRole('button', { name: 'More of radius' }).click();
        await page.getByRole('spinbutton', { name: 'default of radius' }).waitFor();
    }],
    ['shader', (page) => resource(page, 'marble')],
];
