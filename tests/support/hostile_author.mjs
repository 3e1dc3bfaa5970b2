// SPDX-License-Identifier: MIT
// An author who sends texts of code (hostile_code.mjs) one after the other, each as a live edit.
import { ask, until } from './daemon.mjs';
import { isShade } from './hostile_code.mjs';
import { Live } from './live.mjs';

const SHAPE = '/primitives/blob/code';
const SHADE = '/shaders/paint/code';
const GOOD_SHAPE = 'float sdf(vec3 p) { return length(p) - radius; }';
const GOOD_SHADE = 'vec3 shade(FragmentProperties properties) { return vec3(1.0); }';
const DOCUMENT = {
    format: 'fieldcast/1',
    primitives: { blob: { params: [{ name: 'radius', type: 'float', default: 0.5 }], code: GOOD_SHAPE } },
    shaders: { paint: { code: GOOD_SHADE } },
    materials: { red: { shader: 'paint' } },
    root: { id: 'b', type: 'field', material: 'red', params: { primitive: 'blob' } },
};

/** Opens a scene with good code, and waits for its picture. */
export async function openAuthor(daemon, scene) {
    await ask(daemon, 'POST', `/v1/scenes?id=${scene}`, DOCUMENT);
    const author = await Live.open(daemon, scene);
    author.look();
    await author.nextFrame();
    return author;
}

/** Where a text goes. */
export const placeOf = (code) => (isShade(code) ? SHADE : SHAPE);

/**
 * What the author is told of a text: it cannot be drawn, or the edit itself is refused; or it is shown.
 * `whole`: as it stays, by whatever draws in the end, not only while a program is compiled.
 */
export async function verdictOf(author, code, { whole = false } = {}) {
    const from = author.messages.length;
    const frames = author.frames.length;
    const edit = author.set(placeOf(code), code);
    const told = (type, more) => author.messages.slice(from).find((m) => m.type === type && Object.entries(more).every(([key, value]) => m[key] === value));
    return until(() => {
        const rejected = told('rejected', { edit });
        const error = told('notice', { level: 'error' });
        const applied = told('applied', { edit });
        const shown = applied && author.frames.slice(frames).some((frame) => frame.revision >= applied.revision && !frame.stale && (frame.lossless || !whole));
        return (rejected && { refused: rejected }) || (error && { refused: error }) || (shown && { shown });
    }, 'a verdict');
}

/** Puts good code where a text was that cannot be drawn. */
export async function goBack(author, place) {
    const from = author.messages.length;
    author.set(place, place === SHAPE ? GOOD_SHAPE : GOOD_SHADE);
    await author.next('notice', { level: 'info', code: 'compiled', place }, from);
}
