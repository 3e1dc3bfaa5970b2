// SPDX-License-Identifier: MIT
// Documents of very many nodes, of which one is visible.

const GROUP = 100;

/** The text of a document of `count` nodes at least. */
export function largeDocument(count) {
    const children = [];
    for (let i = 0; children.length * (GROUP + 1) + 1 < count; i += GROUP) {
        children.push({
            id: `group-${i}`,
            type: 'group',
            children: Array.from({ length: GROUP }, (_, k) => ({
                id: `node-${i + k}`,
                type: 'sphere',
                visible: i + k === 0,
                transform: { translation: [k, i / GROUP, 0.5] },
            })),
        });
    }
    return JSON.stringify({ format: 'fieldcast/1', root: { id: 'root', type: 'union', children } });
}
