// SPDX-License-Identifier: MIT
// The daemon dies while somebody edits: the picture stays, edits wait, nothing is lost.
import assert from 'node:assert/strict';
import { once } from 'node:events';
import net from 'node:net';
import { after, before, test } from 'node:test';
import { makeDirectory, removeDirectory, startDaemon } from '../support/daemon.mjs';
import {
    closePage,
    difference,
    documentWhen,
    drawnPixels,
    field,
    keepsOff,
    nodeIn,
    openStage,
    pictureChanged,
    pixels,
    row,
    settled,
    valueIs,
    waitForSaved,
} from './stage.mjs';

const data = makeDirectory();
let stage;
let again = null;
before(async () => {
    stage = await openStage({ data });
});
after(async () => {
    await stage.close();
    await again?.stop();
    removeDirectory(data);
});

/** Takes connections at a port and says nothing, until `asked` has looked at what a page makes of it. */
async function besideSilence(port, asked) {
    const silent = net.createServer();
    const sockets = [];
    silent.on('connection', (socket) => sockets.push(socket));
    silent.listen(port, '127.0.0.1');
    await once(silent, 'connection');
    try {
        await asked();
    } finally {
        sockets.forEach((socket) => socket.destroy());
        silent.close();
    }
    await once(silent, 'close');
}

test('edits made while the daemon is away arrive when it is back', async () => {
    const id = await stage.scene();
    const page = await stage.page({ scene: id, width: 1440, height: 900 });
    await row(page, 'ball').click();
    await field(page, 'radius').fill('1.1');
    await field(page, 'radius').press('Enter');
    await settled(page);
    const last = await drawnPixels(page, stage, id);

    const { port } = stage.daemon;
    await stage.daemon.kill('SIGKILL');
    await page.getByTestId('strip').getByText('Offline').waitFor();
    assert.equal(difference(await pixels(page), last), 0, 'the last frame stays');
    await keepsOff(page.getByTestId('strip'), [page.locator('.crumbs'), page.locator('.hand-tools'), page.locator('.outputs')]);

    for (const [name, value] of [
        ['radius', '1.25'],
        ['translation x', '-2'],
        ['translation y', '0.5'],
    ]) {
        await field(page, name).fill(value);
        await field(page, name).press('Enter');
    }
    await page.getByText('Offline, 3 edits waiting').waitFor();
    assert.equal(await page.locator('.notice').count(), 0, 'it is told in one place');
    await valueIs(field(page, 'radius'), '1.25');

    await besideSilence(port, async () => {
        await page.evaluate(() => new Promise((done) => setTimeout(done, 300)));
        assert.equal(await page.getByTestId('state').getAttribute('data-state'), 'offline');
        assert.equal(await page.getByTestId('strip').isVisible(), true);
    });
    again = await startDaemon({ data, args: ['--port', String(port), ...stage.args] });
    stage.daemon.url = again.url;
    const back = await documentWhen(
        stage,
        id,
        (document) => nodeIn(document, 'ball').transform.translation[1] === 0.5,
        'the edits',
    );
    assert.equal(nodeIn(back, 'ball').params.radius, 1.25);
    assert.deepEqual(nodeIn(back, 'ball').transform.translation, [-2, 0.5, 0]);
    await page.getByTestId('strip').waitFor({ state: 'detached' });
    await waitForSaved(page);
    await pictureChanged(page, last, 'the picture to follow');
    const answer = await fetch(`${stage.daemon.url}/v1/scenes/${id}`);
    assert.equal(answer.headers.get('etag'), '"5"', 'each edit once');
    /* The browser itself reports sockets that it could not open. */
    page.problems = page.problems.filter((text) => !/WebSocket|ERR_CONNECTION_(REFUSED|RESET)/.test(text));
    await closePage(page);
});
