// SPDX-License-Identifier: MIT
// States of what finds equations: parametric surfaces, Groebner bases.
import { umbrella } from './scene.mjs';

const proved = (page) => page.locator('.surface-badge:not([data-proof="busy"])').waitFor();

async function workbench(page) {
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill('groebner');
    await page.keyboard.press('Enter');
    await page.getByRole('dialog', { name: 'Groebner bases' }).waitFor();
}

async function make(page, example, state = 'done') {
    await workbench(page);
    if (example) {
        await page.getByRole('combobox', { name: 'Examples' }).click();
        await page.getByRole('option', { name: example }).click();
    }
    await page.getByRole('button', { name: 'Make the basis' }).click();
    await page.locator(`[role=status][data-state=${state}]`).waitFor();
}

/** `select`: a way of states.mjs. */
export const algebraStates = ({ select }) => [
    ['equation of a parametric surface', async (page) => {
        await select(page, 'umbrella');
        await proved(page);
    }, { scene: umbrella('x^2 = y^2*z') }],
    ['equation that does not fit', async (page) => {
        await select(page, 'umbrella');
        await proved(page);
    }, { scene: umbrella('x^2 = y^2*z + 0.1') }],
    ['parametric surface, dialog', async (page) => {
        await select(page, 'umbrella');
        await page.getByRole('button', { name: 'Change…' }).click();
        await page.getByText('proved to be exact').waitFor();
    }, { scene: umbrella('x^2 = y^2*z') }],
    ['workbench', workbench],
    ['workbench, elimination', (page) => make(page, /Sphere/)],
    ['workbench, division', (page) => make(page, /Twisted cubic/)],
    ['workbench, many steps', (page) => make(page, /Five cyclic/)],
    ['workbench, error', async (page) => {
        await workbench(page);
        await page.getByRole('textbox', { name: 'Polynomials' }).fill('x^2 + y\nx*(y + 1');
        await page.getByRole('button', { name: 'Make the basis' }).click();
        await page.locator('[role=status][data-state=failed]').waitFor();
    }],
];
