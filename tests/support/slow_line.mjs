// SPDX-License-Identifier: MIT
// A line to a daemon, on which all that it says arrives later.
import net from 'node:net';

/** Passes connections on to `port`. Answers of the other side come `ms` later, in their order. */
export async function slowLine(port, ms) {
    const line = net.createServer((near) => {
        const far = net.connect(port, '127.0.0.1');
        far.on('data', (bytes) => setTimeout(() => near.write(bytes), ms));
        far.on('close', () => setTimeout(() => near.destroy(), ms));
        near.on('data', (bytes) => far.write(bytes));
        near.on('close', () => far.destroy());
        near.on('error', () => near.destroy());
        far.on('error', () => near.resetAndDestroy());
    });
    await new Promise((done) => line.listen(0, '127.0.0.1', done));
    line.unref();
    return `http://127.0.0.1:${line.address().port}`;
}
