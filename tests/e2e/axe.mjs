// SPDX-License-Identifier: MIT
// What axe finds wrong with a page as it stands.
import { createRequire } from 'node:module';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { source } = require('axe-core');

/* In the page. Focus guards of Base UI are left aside: they pass the focus on in the moment they get it. */
async function look({ inside, tags, rules, without }) {
    const { violations } = await window.axe.run(
        { include: [[inside]], exclude: [['[data-base-ui-focus-guard]']] },
        {
            runOnly: rules ? { type: 'rule', values: rules } : { type: 'tag', values: tags },
            rules: Object.fromEntries(without.map((rule) => [rule, { enabled: false }])),
            resultTypes: ['violations'],
        },
    );
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, any }) => `${id}: ${target} ${any[0]?.message ?? ''}`));
}

export const TAGS = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'];

/** Each fault in words. `rules` alone, or those with one of the `tags`, `without` some; `inside` of an element. */
export async function violationsOf(page, { inside = 'html', tags = TAGS, rules, without = [] } = {}) {
    if (!(await page.evaluate(() => 'axe' in window))) {
        await page.evaluate(source);
    }
    return page.evaluate(look, { inside, tags, rules, without });
}
