// SPDX-License-Identifier: MIT
// A page that pictures are taken of: what the server says to it can be held back, changed and added
// to, so that states that pass, or that need something to go wrong, stand still.
import fs from 'node:fs';
import { ask } from '../../support/daemon.mjs';

const TIMEOUT_MS = 60_000;

const documentOf = (scene) => (typeof scene === 'string' ? JSON.parse(fs.readFileSync(scene, 'utf8')) : scene);

/* The page's own socket stands in the page, not in a worker, where it can be reached. With `delay`
 * every message is that many milliseconds on its way. */
async function tamper(page, state) {
    page.hold = state.hold ?? null;
    page.change = null;
    let cut = false;
    const sockets = [];
    const later = state.delay ? (act) => setTimeout(act, state.delay) : (act) => act();
    page.sent = [];
    await page.addInitScript(() => {
        delete HTMLCanvasElement.prototype.transferControlToOffscreen;
    });
    await page.routeWebSocket(/\/live$/, (socket) => {
        if (cut) {
            socket.close();
            return;
        }
        const server = socket.connectToServer();
        server.onMessage((message) => {
            if (!page.hold?.(message)) {
                later(() => socket.send(page.change ? page.change(message) : message));
            }
        });
        socket.onMessage((message) => {
            page.sent.push(JSON.parse(message));
            later(() => server.send(message));
        });
        sockets.push(socket);
    });
    page.tell = (message) => sockets.at(-1).send(JSON.stringify(message));
    page.pass = (message) => sockets.at(-1).send(message);
    page.cut = () => {
        cut = true;
        sockets.at(-1).close();
    };
}

/* Until nothing has changed for two looks, so that what fades in is there. */
async function quiet(page) {
    await page.evaluate(
        () =>
            new Promise((done) => {
                let frames = 0;
                let last = '';
                const look = () => {
                    const now = document.body.innerHTML.length + [...document.images].map(({ complete }) => complete).join();
                    frames = now === last ? frames + 1 : 0;
                    last = now;
                    return frames > 12 ? done() : requestAnimationFrame(look);
                };
                look();
            }),
    );
}

/* Back to where the next state begins. */
async function rest(page, state) {
    await state.clean?.(page);
    for (let i = 0; i < 6; i += 1) {
        const open = await page.evaluate(() => document.querySelector('.popup:not(.notice), .dialog, .bar-name-input, .tree-rename') !== null);
        const typed = await page.evaluate(() => document.activeElement?.matches('input, textarea') ?? false);
        if (!open && !typed && i > 1) {
            break;
        }
        await page.keyboard.press('Escape');
        await page.evaluate(() => document.activeElement?.matches('input') && document.activeElement.blur());
    }
    await page.mouse.move(1, 1);
    await page.evaluate(() => document.querySelectorAll('.panel-scroll, .resources, .scenes').forEach((one) => one.scrollTo(0, 0)));
    const find = page.getByPlaceholder('Search scenes and examples');
    if ((await find.count()) > 0) {
        await find.fill('');
        await find.blur();
    }
}

export async function openScreen(stage, state, { theme, width, height, touch }) {
    const context = await stage.browser.newContext({
        viewport: { width, height },
        colorScheme: theme,
        reducedMotion: 'reduce',
        hasTouch: touch === true,
        isMobile: touch === true,
    });
    if (!state.hints) {
        await context.addInitScript(() => {
            const preferences = JSON.stringify({ hintsDone: ['drag', 'click'] });
            localStorage.getItem('fieldcast.preferences') ?? localStorage.setItem('fieldcast.preferences', preferences);
        });
    }
    const page = await context.newPage();
    stage.heard();
    page.setDefaultTimeout(TIMEOUT_MS);
    page.problems = [];
    /* A picture may be asked for while its scene goes. */
    page.expected = state.scene === null ? /status of 404/ : undefined;
    page.on('pageerror', (error) => page.problems.push(String(error)));
    page.on('console', (message) => {
        if (['error', 'warning'].includes(message.type())) {
            page.problems.push(message.text());
        }
    });
    if (state.tampered) {
        await tamper(page, state);
    }
    if (state.script) {
        await page.addInitScript(state.script);
    }
    const id = state.scene ? await stage.scene(documentOf(state.scene)) : null;
    page.ask = (method, ops) => ask(stage.daemon, method, `/v1/scenes/${id}`, ops);
    let hand = null;
    page.keepMoving = (x, y) => {
        let by = 0;
        hand = setInterval(() => page.mouse.move(x + (by = 10 - by), y).catch(() => {}), 60);
    };
    page.restHand = async () => {
        clearInterval(hand);
        await page.mouse.up();
    };
    page.on('close', () => clearInterval(hand));
    /* So that lists of scenes stay short. */
    page.on('close', () => id !== null && ask(stage.daemon, 'DELETE', `/v1/scenes/${id}`).catch(() => {}));
    page.quiet = () => quiet(page);
    page.rest = (last) => rest(page, last);
    await page.goto(`${stage.daemon.url}${state.path ?? (id === null ? '/' : `/s/${id}`)}`);
    if (id !== null) {
        await page.locator('[role=treeitem]').first().waitFor();
        if (!state.fresh && state.scene.root?.children.length !== 0) {
            await page.locator('[data-testid=state]:is([data-state=refining], [data-state=final])').waitFor();
        }
    }
    stage.keep?.(page);
    return page;
}
