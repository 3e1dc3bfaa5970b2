// SPDX-License-Identifier: MIT
// Plots as SVG, for pages in light and dark.

const WIDTH = 720;
const HEIGHT = 400;
const LEFT = 64;
const RIGHT = 150; // names of lines
const TOP = 24;
const BOTTOM = 44;
const COLORS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00']; // Okabe and Ito, 2008

const STYLE =
    'text{font:13px sans-serif;fill:#444}.grid{stroke:#8884;stroke-width:1}.line{fill:none;stroke-width:2}' +
    '@media(prefers-color-scheme:dark){text{fill:#ccc}}';

const escape = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;');
const text = (x, y, what, more = '') => `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${escape(what)}</text>`;

function svg(title, height, parts) {
    const head = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${height}" role="img">`;
    return `${[head, `<title>${escape(title)}</title>`, `<style>${STYLE}</style>`, ...parts, '</svg>'].join('\n')}\n`;
}

/** Powers of ten around the values. */
function decades(values) {
    const low = Math.floor(Math.log10(Math.min(...values)));
    const high = Math.ceil(Math.log10(Math.max(...values)));
    return Array.from({ length: high - low + 1 }, (_, i) => 10 ** (low + i));
}

/** `lines`: {name, points: [[x, y], ...]}, all above 0. Both axes are logarithmic. */
export function plotLines({ title, x, y, lines }) {
    const all = lines.flatMap(({ points }) => points);
    const ticks = [decades(all.map(([a]) => a)), decades(all.map(([, b]) => b))];
    const part = (axis, value) => Math.log10(value / ticks[axis][0]) / Math.log10(ticks[axis].at(-1) / ticks[axis][0]);
    const atX = (value) => LEFT + part(0, value) * (WIDTH - LEFT - RIGHT);
    const atY = (value) => HEIGHT - BOTTOM - part(1, value) * (HEIGHT - TOP - BOTTOM);
    const end = WIDTH - RIGHT;
    const floor = HEIGHT - BOTTOM;

    const grid = [
        ...ticks[0].map((t) => `<line class="grid" x1="${atX(t)}" x2="${atX(t)}" y1="${TOP}" y2="${floor}"/>`),
        ...ticks[1].map((t) => `<line class="grid" x1="${LEFT}" x2="${end}" y1="${atY(t)}" y2="${atY(t)}"/>`),
        ...ticks[0].map((t) => text(atX(t), floor + 18, t.toLocaleString('en'), 'text-anchor="middle"')),
        ...ticks[1].map((t) => text(LEFT - 8, atY(t) + 4, t.toLocaleString('en'), 'text-anchor="end"')),
        text((LEFT + end) / 2, HEIGHT - 8, x, 'text-anchor="middle"'),
        text(8, 14, y),
    ];
    // Names stand beside the ends of their lines, and below one another where these meet.
    let lowest = Number.NEGATIVE_INFINITY;
    const drawn = lines
        .map((line, i) => ({ ...line, color: COLORS[i % COLORS.length], at: atY(line.points.at(-1)[1]) }))
        .sort((a, b) => a.at - b.at)
        .flatMap(({ name, points, color, at }) => {
            lowest = Math.max(at + 4, lowest + 16);
            const path = points.map(([a, b]) => `${atX(a).toFixed(1)},${atY(b).toFixed(1)}`).join(' ');
            return [
                `<polyline class="line" stroke="${color}" points="${path}"/>`,
                text(atX(points.at(-1)[0]) + 10, lowest, name, `style="fill:${color}"`),
            ];
        });
    return svg(title, HEIGHT, [...grid, ...drawn]);
}

/** `bars`: {name, value, note}. */
export function plotBars({ title, bars }) {
    const most = Math.max(...bars.map(({ value }) => value));
    const scale = (WIDTH - LEFT - RIGHT - 40) / most;
    const parts = bars.flatMap(({ name, value, note }, i) => {
        const at = 12 + 36 * i;
        return [
            text(LEFT + 24, at + 18, name, 'text-anchor="end"'),
            `<rect x="${LEFT + 32}" y="${at}" width="${(scale * value).toFixed(1)}" height="26" rx="3" fill="${COLORS[0]}"/>`,
            text(LEFT + 40 + scale * value, at + 18, note),
        ];
    });
    return svg(title, 24 + 36 * bars.length, parts);
}
