// SPDX-License-Identifier: MIT
// Tabs of a browser that are used by one page after another. In a tab that has shown the editor the
// browser has read and compiled the page's scripts: the next page there takes two thirds of the time
// of the processors that the first page of a new tab takes.
const EVENTS = ['request', 'websocket', 'pageerror', 'console', 'response', 'dialog', 'download', 'filechooser'];
const PREFERENCES = JSON.stringify({ hintsDone: ['drag', 'click'] });
const COARSE = 2;

/** The page asks for so many times fewer pixels in each direction, and magnifies the pictures. */
function coarsenPictures(times) {
    const { prototype } = ResizeObserverEntry;
    const { get } = Object.getOwnPropertyDescriptor(prototype, 'devicePixelContentBoxSize');
    Object.defineProperty(prototype, 'devicePixelContentBoxSize', {
        get() {
            return get.call(this).map(({ inlineSize, blockSize }) => ({ inlineSize: inlineSize / times, blockSize: blockSize / times }));
        },
    });
}

function keepPreferences(preferences) {
    const key = 'fieldcast.preferences';
    localStorage.getItem(key) ?? localStorage.setItem(key, preferences);
}

function hidePointerLock() {
    delete Element.prototype.requestPointerLock;
}

/** What is fixed when a tab is opened. `touch`: it has fingers. The other three as of openStage and of its pages. */
async function openTab(browser, { touch, coarse, whole, hints }) {
    const context = await browser.newContext({ hasTouch: touch, acceptDownloads: true });
    if (!hints) {
        await context.addInitScript(keepPreferences, PREFERENCES);
    }
    if (coarse) {
        await context.addInitScript(coarsenPictures, COARSE);
    }
    if (!whole) {
        await context.addInitScript(hidePointerLock);
    }
    const page = await context.newPage();
    page.setDefaultTimeout(0);
    return page;
}

/** Leaves a document of the daemon's, which nothing is seen of, without what the page has stored. */
async function clear(page, idle) {
    const context = page.context();
    for (const other of context.pages().filter((one) => one !== page)) {
        await other.close();
    }
    await context.clearPermissions();
    await page.unrouteAll({ behavior: 'ignoreErrors' });
    await page.mouse.move(-1, -1);
    await page.goto(idle);
    await page.evaluate(() => {
        localStorage.clear();
        sessionStorage.clear();
    });
}

export class Tabs {
    /** `idle()`: the address of a document that tabs show between two pages. */
    constructor(browser, idle) {
        this.browser = browser;
        this.idle = idle;
        this.free = new Map(); // by what is fixed: pages
        this.kindOf = new WeakMap(); // of a page that is in use
    }

    /** Undefined: there is none. A tab that was closed since is none. */
    takeFree(kind) {
        const pages = (this.free.get(kind) ?? []).filter((page) => !page.isClosed());
        const taken = pages.pop();
        this.free.set(kind, pages);
        return taken;
    }

    /** A page without a document and without listeners. */
    async take({ width, height, theme, touch = false, coarse = false, whole = false, hints = false }) {
        const fixed = { touch, coarse, whole, hints };
        const kind = JSON.stringify(fixed);
        const page = this.takeFree(kind) ?? (await openTab(this.browser, fixed));
        this.kindOf.set(page, kind);
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ colorScheme: theme, reducedMotion: 'reduce' });
        return page;
    }

    isOut(page) {
        return this.kindOf.has(page) && !page.isClosed();
    }

    /** Ends a page. Its tab is closed where it does not reach the daemon any more. */
    async giveBack(page) {
        const kind = this.kindOf.get(page);
        this.kindOf.delete(page);
        EVENTS.forEach((event) => page.removeAllListeners(event));
        try {
            await clear(page, this.idle());
        } catch {
            await page.context().close();
            return;
        }
        this.free.set(kind, [...(this.free.get(kind) ?? []), page]);
    }
}
