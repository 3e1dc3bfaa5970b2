// SPDX-License-Identifier: MIT
// The process of the algebra that a daemon has started, and what keeps it busy.
import fs from 'node:fs';

const DIGITS = '739184620583';
/** One of twelve, as long as numbers are that are not rounded. */
export const longNumber = (i) => `0.${DIGITS.slice(i)}${DIGITS.slice(0, i)}317`;
/** Degree 18 with coefficients of some thousand bits: longer than all that a test does meanwhile. */
export const SLOW_SURFACE = {
    x: `s^3*t^3+${longNumber(0)}*s-2t^2+${longNumber(1)}s^2*t`,
    y: `2s^3*t^3+${longNumber(2)}s^3-t+${longNumber(3)}s*t-${longNumber(4)}t^3*s^2`,
    z: `s^3*t^3-${longNumber(5)}t^3+s^2+${longNumber(6)}s*t^2`,
};

export const isAlgebra = (pid) => {
    try {
        return fs.readFileSync(`/proc/${pid}/cmdline`, 'utf8').split('\0')[0].endsWith('fieldcast-algebra');
    } catch {
        return false;
    }
};

export function algebraOf(daemon) {
    const threads = fs.readdirSync(`/proc/${daemon.pid}/task`);
    const children = threads.flatMap((id) => fs.readFileSync(`/proc/${daemon.pid}/task/${id}/children`, 'utf8').split(' '));
    return children.filter((pid) => pid && isAlgebra(pid));
}
