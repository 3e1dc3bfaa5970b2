// SPDX-License-Identifier: MIT
// States of what finds equations: parametric surfaces, Groebner bases.
import { implicit, parametric, umbrella } from './scene.mjs';
import { bottom, select } from './ways.mjs';

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

export const ALGEBRA = [
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
        await page.getByRole('button', { name: 'Change …' }).click();
        await page.getByText('proved to be exact').waitFor();
    }, { scene: umbrella('x^2 = y^2*z') }],
    ['equation, the patch alone', async (page) => {
        await select(page, 'umbrella');
        await proved(page);
        await page.getByRole('button', { name: 'Keep only the patch' }).scrollIntoViewIfNeeded();
    }, { scene: umbrella('x^2 = y^2*z') }],
    ['equation, wrong', async (page) => {
        await select(page, 'equation');
        await page.getByRole('textbox', { name: 'equation' }).fill('x^2 + y^2 + z^2 = (1');
        await page.locator('.equation-mark').waitFor();
    }, { scene: implicit({ equation: 'x^2 + y^2 + z^2 = 1' }) }],
    ['quality, a pole', async (page) => {
        await select(page, 'equation');
        await page.locator('.quality-badge').hover();
        await page.locator('.tip').waitFor();
    }, { scene: implicit({ equation: '1/x = y + z' }) }],
    ['parametric surface, sampled', async (page) => {
        await select(page, 'surface');
        await page.locator('.quality-badge').waitFor();
        await page.locator('.patches-equation').waitFor();
        await bottom(page);
    }, { scene: parametric({ x: 'u*cos(4*v)', y: 'v', z: 'u*sin(4*v)', u: [-0.7, 0.7], v: [-1, 1] }) }],
    ['parametric surface, with an equation', async (page) => {
        await select(page, 'surface');
        await page.getByRole('button', { name: 'Make implicit' }).waitFor();
    }, { scene: parametric({ x: 's', y: 's^2 - t^2', z: 't', s: [-1, 1], t: [-1, 1] }) }],
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
