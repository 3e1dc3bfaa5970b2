// SPDX-License-Identifier: MIT
// What a machine can say of a page as it stands: texts that are cut off, controls that lie over each
// other or outside of the window, colours that are hard to read.
import { violationsOf } from '../axe.mjs';

const SLACK = 1.5; // CSS pixels that a rounded place may be off
const LAP = 3.5; // controls may share a rim of so many pixels

/* The functions that follow run in the page: `page` is what this one answers. */
function tools({ SLACK, LAP }) {
    const parentsOf = (one) => {
        const list = [];
        for (let parent = one.parentElement; parent; parent = parent.parentElement) {
            list.push(parent);
        }
        return list;
    };
    const intersect = (a, b) => ({
        left: Math.max(a.left, b.left),
        top: Math.max(a.top, b.top),
        right: Math.min(a.right, b.right),
        bottom: Math.min(a.bottom, b.bottom),
    });
    /* Of discs. */
    const apart = (a, b) => {
        const [dx, dy] = [a.left + a.right - b.left - b.right, a.top + a.bottom - b.top - b.bottom];
        return Math.hypot(dx, dy) > a.right - a.left + b.right - b.left - 2 * LAP;
    };
    const exceeds = ({ left, top, right, bottom }, by) => right - left > by && bottom - top > by;
    return {
        SLACK,
        parentsOf,
        nameOf(one) {
            const words = (one.getAttribute('aria-label') ?? one.textContent ?? '').trim().slice(0, 48);
            return `${one.tagName.toLowerCase()}${[...one.classList].map((name) => `.${name}`).join('')} “${words}”`;
        },
        /* What lies in a view that is moved by hand may be out of sight. */
        isSeen: (one) =>
            !one.closest('.react-flow__viewport') &&
            !one.matches('[role=separator], [aria-hidden=true] *, input[aria-hidden=true]') &&
            !one.closest('.unseen, [data-base-ui-focus-guard]') &&
            one.checkVisibility({ opacityProperty: true, visibilityProperty: true }),
        isEmpty: (box) => !exceeds(box, SLACK),
        overlap: (a, b) => exceeds(intersect(a, b), LAP) && !(a.round && b.round && apart(a, b)),
        scrolls: (value) => value === 'auto' || value === 'scroll',
        hides: (value) => value === 'hidden' || value === 'clip',
        isOutside: ({ left, top, right, bottom }) =>
            right > innerWidth + SLACK || left < -SLACK || bottom > innerHeight + SLACK || top < -SLACK,
        /* The part of an element that its scrolling parents leave in sight. */
        shownPart(one) {
            let box = one.getBoundingClientRect();
            for (const parent of parentsOf(one)) {
                const { overflowX, overflowY } = getComputedStyle(parent);
                if (overflowX !== 'visible' || overflowY !== 'visible') {
                    box = intersect(box, parent.getBoundingClientRect());
                }
            }
            return box;
        },
    };
}

/* Texts that a parent cuts off without saying so by an ellipsis, and without a way to scroll. */
function cutTexts({ SLACK, parentsOf, nameOf, isSeen, scrolls, hides }) {
    const faultOf = (text) => {
        const own = text.parentElement;
        const range = document.createRange();
        range.selectNodeContents(text);
        const box = range.getBoundingClientRect();
        let [movesX, movesY] = [false, false];
        for (const parent of [own, ...parentsOf(own)]) {
            const style = getComputedStyle(parent);
            const edge = parent.getBoundingClientRect();
            movesX ||= scrolls(style.overflowX);
            movesY ||= scrolls(style.overflowY);
            if (style.textOverflow === 'ellipsis' || style.webkitLineClamp !== 'none') {
                return null;
            }
            const wide = hides(style.overflowX) && !movesX && (box.right > edge.right + SLACK || box.left < edge.left - SLACK);
            const high = hides(style.overflowY) && !movesY && (box.bottom > edge.bottom + SLACK || box.top < edge.top - SLACK);
            if (wide || high) {
                return `text is cut off: ${nameOf(own)} by ${nameOf(parent).split(' ')[0]}`;
            }
        }
        const outside = !movesX && (box.right > innerWidth + SLACK || box.left < -SLACK);
        return outside ? `text is outside of the window: ${nameOf(own)}` : null;
    };
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let text = walker.nextNode(); text; text = walker.nextNode()) {
        const own = text.parentElement;
        if (text.data.trim() && isSeen(own) && !own.closest('.cm-editor, pre')) {
            found.push(faultOf(text));
        }
    }
    return found.filter((fault) => fault !== null);
}

/* Values without an ellipsis; words of buttons, which have to be read, even with one. */
function cutValues({ SLACK, nameOf, isSeen }) {
    const wordsWidth = (one) => {
        const context = document.createElement('canvas').getContext('2d');
        const { fontWeight, fontSize, fontFamily } = getComputedStyle(one);
        context.font = `${fontWeight} ${fontSize} ${fontFamily}`;
        return context.measureText(one.placeholder).width;
    };
    const isShort = (one) => isSeen(one) && one.scrollWidth > one.clientWidth + SLACK;
    const values = [...document.querySelectorAll('input:not([type=checkbox]), textarea')].filter(
        (one) => isShort(one) && one !== document.activeElement && getComputedStyle(one).textOverflow !== 'ellipsis',
    );
    const buttons = [...document.querySelectorAll('.segment, .button, .menu-text, .tabs button')].filter(isShort);
    return [
        ...[...document.querySelectorAll('input:placeholder-shown')]
            .filter((one) => isSeen(one) && getComputedStyle(one).textOverflow !== 'ellipsis' && wordsWidth(one) > one.clientWidth)
            .map((one) => `words are cut off: ${nameOf(one)} ${one.placeholder}`),
        ...values.map((one) => `value is cut off: ${nameOf(one)} ${one.value}`),
        ...buttons.map((one) => `words are shortened: ${nameOf(one)}`),
    ];
}

/* Texts on glass, which is dark in both themes: what is behind it, nobody can compute. */
function darkOnGlass({ nameOf, isSeen }) {
    const LIGHT = 140; // of 255
    const isDark = (one) => {
        const [red, green, blue] = getComputedStyle(one).color.match(/[\d.]+/g).map(Number);
        return Math.max(red, green, blue) < LIGHT;
    };
    const onAccent = (one) => one.closest('[data-look=primary], .outputs[data-other]') !== null;
    return [...document.querySelectorAll('.glass, .glass button, .glass span')]
        .filter((one) => isSeen(one) && one.textContent.trim() !== '' && !onAccent(one) && isDark(one))
        .map((one) => `dark text on glass: ${nameOf(one)}`);
}

/* What was chosen is to be seen in its list, whole. */
function clippedChoices({ SLACK, nameOf, isSeen, shownPart }) {
    const CHOSEN = '.resource-row[data-selected], [aria-current=true], .tree-row[aria-selected=true]:focus';
    return [...document.querySelectorAll(CHOSEN)]
        .filter((one) => isSeen(one) && shownPart(one).bottom - shownPart(one).top < one.offsetHeight - SLACK)
        .map((one) => `what is chosen is not in sight: ${nameOf(one)}`);
}

/* A field that draws its own ring has no second one around it. */
function doubleRings({ nameOf }) {
    const one = document.activeElement;
    const { outlineStyle, boxShadow } = getComputedStyle(one);
    return outlineStyle !== 'none' && /inset/.test(boxShadow) && one.matches('input')
        ? [`two rings around the focus: ${nameOf(one)}`]
        : [];
}

/* A drag over the page marks no words of it; what is marked in a field counts as collapsed. */
function markedTexts() {
    const marks = getSelection();
    const own = document.activeElement.closest('[contenteditable]') !== null;
    return marks.isCollapsed || own ? [] : [`words are marked: ${marks.toString().trim().slice(0, 48)}`];
}

/* The dot of a changed value stands beside its name. */
function strayDots({ nameOf, isSeen }) {
    const SLACK_DOT = 4;
    const middleOf = (one) => (one.getBoundingClientRect().top + one.getBoundingClientRect().bottom) / 2;
    return [...document.querySelectorAll('.form-row > .form-reset')]
        .filter((one) => isSeen(one))
        .filter((one) => Math.abs(middleOf(one) - middleOf(one.parentElement.querySelector('.form-label'))) > SLACK_DOT)
        .map((one) => `dot is not beside its name: ${nameOf(one)}`);
}

/* Controls outside of the window, under something else, or over each other. */
function lostControls({ parentsOf, nameOf, isSeen, isEmpty, overlap, scrolls, isOutside, shownPart }) {
    const CONTROLS =
        'button, a[href], input, textarea, select, [role=button], [role=option], [role=menuitem], ' +
        '[role=menuitemradio], [role=tab], [role=radio], [role=switch], [role=treeitem]';
    const LAYERS = '.popup, .tip, [role=separator], .dialog, .notices, .drop-cover, .scenes-bar, .leaving-list, .backdrop';
    const layerOf = (one) => one.closest(LAYERS) ?? document.body;
    const modal = document.querySelector('.backdrop') !== null;
    const canScroll = (one) => {
        const { overflowX, overflowY } = getComputedStyle(one);
        return scrolls(overflowX) || scrolls(overflowY);
    };
    /* Icons of what is in the scene lie where that is. */
    const areMarks = (...all) => all.every((one) => one?.matches('.view-mark'));
    /* What floats may cover what is below it; a message may not, but where that can be scrolled. */
    const mayCover = (at, one) => {
        const above = at?.closest(LAYERS);
        if (at?.closest('.leaving') && one.closest('.scenes')) {
            return true;
        }
        if (areMarks(at?.closest('button'), one)) {
            return true;
        }
        return above && !above.contains(one) && !above.classList.contains('notices') && !at.closest('.notice');
    };
    const found = [];
    const parts = [];
    for (const one of [...document.querySelectorAll(CONTROLS)].filter(isSeen)) {
        const round = getComputedStyle(one).borderRadius === '50%';
        const box = Object.assign(shownPart(one), { round });
        if (modal && layerOf(one) === document.body) {
            continue;
        }
        if (isEmpty(box)) {
            if (!parentsOf(one).some(canScroll) && one.getBoundingClientRect().width > 0) {
                found.push(`control cannot be seen: ${nameOf(one)}`);
            }
            continue;
        }
        const at = document.elementFromPoint((box.left + box.right) / 2, (box.top + box.bottom) / 2);
        const mine = at && (one.contains(at) || at.contains(one) || at.closest('label')?.contains(one));
        if (isOutside(box)) {
            found.push(`control is outside of the window: ${nameOf(one)}`);
        }
        if (!mine && !mayCover(at, one)) {
            found.push(`control is covered: ${nameOf(one)} by ${at ? nameOf(at) : 'nothing'}`);
        }
        for (const [other, its] of parts) {
            const besides = !other.contains(one) && !areMarks(other, one);
            if (besides && layerOf(one) === layerOf(other) && overlap(box, its)) {
                found.push(`controls overlap: ${nameOf(other)} and ${nameOf(one)}`);
            }
        }
        parts.push([one, box]);
    }
    return found;
}

function look(page) {
    const { scrollWidth, clientWidth } = document.documentElement;
    const wide = scrollWidth > clientWidth ? [`the page is ${scrollWidth - clientWidth} pixels too wide`] : [];
    const checks = [cutTexts, cutValues, darkOnGlass, clippedChoices, doubleRings, markedTexts, strayDots, lostControls];
    return [...new Set([...checks.flatMap((find) => find(page)), ...wide])];
}

const LOOK = `(() => {
    ${[tools, cutTexts, cutValues, darkOnGlass, clippedChoices, doubleRings, markedTexts, strayDots, lostControls, look].join('\n')}
    return look(tools(${JSON.stringify({ SLACK, LAP })}));
})()`;

/** What is wrong with a page now, in words. */
export async function check(page) {
    const problems = page.problems.filter((text) => !page.expected?.test(text));
    return [
        ...(await page.evaluate(LOOK)),
        ...(await violationsOf(page, { rules: ['color-contrast', 'target-size'] })),
        ...problems.map((text) => `console: ${text}`),
    ];
}
