// SPDX-License-Identifier: MIT
// States in which something has changed, waits or went wrong, and of the code: rows of states.mjs.
import { picture, row } from '../stage.mjs';
import { CODED } from './scene.mjs';
import { middle, openCode, select, setRadius, tab, write } from './ways.mjs';

/* As the server says it. */
const STAYS = 'The last good picture stays.';
const TOO_SLOW = `This code took over 2 s to compile here (limit 2 s). ${STAYS}`;
const CRASHED = `Compiling this code ended the render process. ${STAYS}`;

const LATER = 'It is not drawn until it is edited or tried again.';
const LEFT_OUT = `Drawing the smallest part of this scene took over 0.9 s here (limit 0.5 s). ${LATER}`;
const ENDED = `Drawing this scene ended the render process. ${LATER}`;

const WRONG = 'float sdf(vec3 p) {\n    float d = length(p);\n    return d - radios;\n}\n';

const BINARY_FLAGS = 6;
const LOSSLESS = 4;
const STALE = 8;
const isFrame = (message) => typeof message !== 'string';

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

export const CHANGES = [
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
        const from = await row(page, 'pillar').boundingBox();
        const to = await row(page, 'jug').boundingBox();
        await page.mouse.move(from.x + 60, from.y + from.height / 2);
        await page.mouse.down();
        await page.mouse.move(to.x + 60, to.y + 3, { steps: 8 });
        await page.mouse.move(to.x + 64, to.y + 2, { steps: 3 });
        await page.locator('.tree-line').waitFor();
    }, { clean: (page) => page.mouse.up() }],
];

export const CODE = [
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
    ['outputs, normals', async (page) => {
        await page.getByTestId('outputs').click();
        await page.getByRole('menuitemradio', { name: /^Normals/ }).click();
        await page.getByRole('menu').waitFor({ state: 'detached' });
    }],
    ['outputs, steps', async (page) => {
        await page.getByTestId('outputs').click();
        await page.getByRole('menuitemradio', { name: /^Steps/ }).click();
        await page.getByTestId('legend').waitFor();
        await page.getByRole('menu').waitFor({ state: 'detached' });
    }],
];
