// SPDX-License-Identifier: MIT
// States of what lies over the picture: gizmo, handles, corners, grid, axes, icons, measure and probe:
// rows of states.mjs.
import { until } from '../../support/daemon.mjs';
import { picture } from '../stage.mjs';
import { middle, resource, select } from './ways.mjs';

const final = (page) => page.locator('[data-testid=state][data-state=final]').waitFor();

/** The parts that the page says that it drew. */
const parts = async (page) => JSON.parse((await page.getByTestId('hands').getAttribute('data-parts')) ?? '[]');

/** Waits for a part; answers its place in the window. */
async function part(page, is, what) {
    const { at } = await until(async () => (await parts(page)).find(is), what);
    const box = await picture(page).boundingBox();
    return { x: box.x + at.x, y: box.y + at.y };
}

const arrow = (page) => part(page, ({ motion, axis, plane }) => motion === 'move' && axis === 0 && !plane, 'the arrow along X');

/** Takes hold of a place and keeps it, some way on. */
async function hold(page, { x, y }, dx, dy) {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y + dy, { steps: 6 });
    await page.quiet();
}

async function command(page, words) {
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox').fill(words);
    await page.keyboard.press('Enter');
}

const up = (page) => page.mouse.up();

export const HANDS = [
    ['gizmo and handles', async (page) => {
        await select(page, 'ball');
        await final(page);
        await part(page, ({ look }) => look !== undefined, 'a handle');
    }],
    ['gizmo, turn', async (page) => {
        await select(page, 'pillar');
        await picture(page).focus();
        await page.keyboard.press('2');
        await part(page, ({ motion }) => motion === 'turn', 'a ring');
        await final(page);
    }],
    ['gizmo, scale', async (page) => {
        await select(page, 'block');
        await picture(page).focus();
        await page.keyboard.press('3');
        await part(page, ({ motion }) => motion === 'scale', 'a cube');
        await final(page);
    }],
    ['gizmo, held', async (page) => {
        await select(page, 'ball');
        await final(page);
        await hold(page, await arrow(page), 50, 10);
        await final(page);
    }, { clean: up }],
    ['gizmo, typed', async (page) => {
        await select(page, 'ball');
        await final(page);
        await page.mouse.move(...(await middle(page)));
        await picture(page).focus();
        for (const key of ['g', 'x', '.', '2']) {
            await page.keyboard.press(key);
        }
        await final(page);
    }, { clean: (page) => page.keyboard.press('Escape') }],
    ['handle, held', async (page) => {
        await select(page, 'ball');
        await final(page);
        await hold(page, await part(page, ({ look }) => look === 'dot', 'the radius'), 30, 8);
        await final(page);
    }, { clean: up }],
    ['corners of a flat shape', async (page) => {
        await select(page, 'outline');
        await part(page, ({ look }) => look === 'corner', 'a corner');
        await final(page);
    }],
    ['light in the picture', async (page) => {
        await page.ask('PATCH', [{ op: 'set', at: '/lights/spot/position', value: [0.9, 1.4, 0.8] }]);
        await resource(page, 'spot');
        await arrow(page);
        await final(page);
    }],
    ['measuring', async (page) => {
        await final(page);
        await command(page, 'measure distances');
        await page.mouse.click(...(await middle(page, 0.45, 0.5)));
        await page.getByText('Click where to measure to').waitFor();
        await page.mouse.click(...(await middle(page, 0.6, 0.62)));
        await page.locator('.measured-line circle').nth(1).waitFor();
    }],
    ['probe', async (page) => {
        await final(page);
        await command(page, 'under the pointer');
        await page.mouse.move(...(await middle(page, 0.5, 0.5)));
        await page.getByTestId('pointed').waitFor();
    }],
    ['grid off', async (page) => {
        await command(page, 'ground grid');
        await page.locator('[data-testid=grid][data-shown=""]').waitFor({ state: 'attached' });
        await final(page);
    }],
    ['axes, from above', async (page) => {
        await picture(page).focus();
        await page.keyboard.press('Numpad7');
        await page.locator('.axes-ball [data-view]:not([hidden])').first().hover();
        await final(page);
    }],
    ['icons of lights and camera', async (page) => {
        await picture(page).focus();
        await page.keyboard.press('Numpad3');
        for (let i = 0; i < 24; i += 1) {
            await page.keyboard.press('-');
        }
        await page.locator('[data-mark="camera"]').waitFor();
        await final(page);
    }],
    ['rectangle', async (page) => {
        await final(page);
        const [x, y] = await middle(page, 0.3, 0.35);
        await page.keyboard.down('Shift');
        await hold(page, { x, y }, 160, 110);
    }, { clean: async (page) => {
        await up(page);
        await page.keyboard.up('Shift');
    } }],
];
