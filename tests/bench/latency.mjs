// SPDX-License-Identifier: MIT
// From an input in chromium to the picture that answers it, on loopback: p50 and p95 in
// milliseconds, and bytes per frame. Prints one JSON object. "camera": steps of an orbit, each
// frame against the view that it shows, as the page itself measures it. "number": single numeric
// edits, from the key to the frame of that revision.
import { ask } from '../support/daemon.mjs';
import { dragBy, field, openStage, picture, row, settled } from '../e2e/stage.mjs';

const EXAMPLES = ['first-steps', 'csg', 'snowman'];
// Windows whose pictures are about 640×360 and 1280×720.
const SIZES = [
    [1216, 433],
    [1858, 793],
];
const ORBIT_STEPS = 150;
const EDITS = 40;

const percentile = (values, share) => {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? null;
};
const round = (x) => (x === null ? null : Math.round(x * 10) / 10);
const summary = (p50, p95) => ({ p50_ms: round(p50), p95_ms: round(p95) });

/** What the sheet of statistics copies. */
async function statistics(page) {
    await page.evaluate(() => {
        navigator.clipboard.writeText = async (text) => {
            window.copied = text;
        };
    });
    await page.getByTestId('statistics').click();
    await page.getByRole('button', { name: 'Copy as JSON' }).click();
    const text = await page.waitForFunction(() => window.copied);
    await page.keyboard.press('Escape');
    return JSON.parse(await text.jsonValue()).statistics;
}

async function orbit(page) {
    await dragBy(page, picture(page), 240, 30, { steps: ORBIT_STEPS });
    const numbers = await statistics(page);
    await settled(page);
    return {
        ...summary(numbers.photonP50, numbers.photonP95),
        bytes_per_frame: Math.round(numbers.bytesPerFrame),
    };
}

/** One key, one edit, one frame of its revision; then the next. */
async function edits(page) {
    const sphere = page.locator('[data-type=sphere]').first();
    await row(page, await sphere.getAttribute('data-node')).click();
    await field(page, 'radius').focus();
    const times = await field(page, 'radius').evaluate(async (input, count) => {
        const pill = document.querySelector('[data-testid=state]');
        const frameOf = (revision) =>
            new Promise((shown) => {
                const watch = new MutationObserver(() => {
                    if (Number(pill.dataset.revision) >= revision) {
                        watch.disconnect();
                        shown(performance.now());
                    }
                });
                watch.observe(pill, { attributes: true });
            });
        const all = [];
        for (let i = 0; i < count; i += 1) {
            const next = frameOf(Number(pill.dataset.revision) + 1);
            const start = performance.now();
            const key = i % 2 === 0 ? 'ArrowUp' : 'ArrowDown';
            input.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
            all.push((await next) - start);
        }
        return all;
    }, EDITS);
    return summary(percentile(times, 0.5), percentile(times, 0.95));
}

async function measure(stage, example, [width, height]) {
    const scene = `${example}-${width}`;
    await ask(stage.daemon, 'POST', `/v1/scenes?id=${scene}`, { from: `example:${example}` });
    const page = await stage.page({ scene, width, height });
    await settled(page);
    const box = await picture(page).boundingBox();
    const camera = await orbit(page);
    const number = await edits(page);
    await page.context().close();
    return { example, width: box.width, height: box.height, camera, number };
}

const stage = await openStage({ whole: true });
try {
    const runs = [];
    for (const example of EXAMPLES) {
        for (const size of SIZES) {
            runs.push(await measure(stage, example, size));
        }
    }
    console.log(JSON.stringify({ runs }));
} finally {
    await stage.close();
}
