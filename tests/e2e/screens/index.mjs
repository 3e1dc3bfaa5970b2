// SPDX-License-Identifier: MIT
// One page with all pictures, by name, and what was found wrong below each.
import fs from 'node:fs';
import path from 'node:path';

const escape = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

const figure = ({ file, name, variant, found }) => `<figure>
<a href="${file}"><img loading="lazy" src="${file}" alt="${escape(`${name}, ${variant}`)}"></a>
<figcaption>${escape(variant)}${found.map((line) => `<br><b>${escape(line)}</b>`).join('')}</figcaption>
</figure>`;

const STYLE = `body { font: 14px system-ui; margin: 24px; background: #888; }
section { margin-block-end: 32px; }
div { display: flex; flex-wrap: wrap; gap: 16px; align-items: start; }
figure { margin: 0; max-inline-size: 100%; }
img { max-block-size: 480px; max-inline-size: 100%; display: block; }
b { color: #900; }`;

/** `order`: the names of the states. */
export function writeIndex(folder, shots, order) {
    const names = order.filter((name) => shots.some((shot) => shot.name === name));
    const sections = names.map((name) => {
        const own = shots.filter((shot) => shot.name === name).sort((a, b) => (a.variant < b.variant ? -1 : 1));
        return `<section><h2>${escape(name)}</h2><div>${own.map(figure).join('\n')}</div></section>`;
    });
    const wrong = shots.filter(({ found }) => found.length > 0).length;
    fs.writeFileSync(
        path.join(folder, 'index.html'),
        `<!doctype html><html lang="en"><meta charset="utf-8"><title>Screens</title><style>${STYLE}</style>
<h1>${shots.length} pictures, ${wrong} with something wrong</h1>
${sections.join('\n')}
</html>\n`,
    );
}
