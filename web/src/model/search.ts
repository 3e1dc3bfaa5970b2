/* SPDX-License-Identifier: MIT */
/* Finding things by a few words: every word has to occur, and where it occurs says how well. */

/* What is searched of a thing, the best first: its name, synonyms, its kind, a description. */
export interface Searched {
    readonly name: string;
    readonly words?: string;
    readonly kind?: string;
    readonly doc?: string;
}

function pointsOf(word: string, { name, words = "", kind = "", doc = "" }: Searched): number {
    const title = name.toLowerCase().replaceAll("_", " ");
    if (title.startsWith(word)) {
        return title === word ? 9 : 8;
    }
    if (title.includes(word)) {
        return 6;
    }
    if (
        words
            .toLowerCase()
            .split(/\s+/)
            .some((one) => one.startsWith(word))
    ) {
        return 4;
    }
    if (kind.toLowerCase().includes(word)) {
        return 2;
    }
    return doc.toLowerCase().includes(word) ? 1 : 0;
}

/* Those that fit, best first; all of them, in their order, where nothing is asked for. */
export function search<T>(
    items: readonly T[],
    query: string,
    of: (item: T) => Searched,
): readonly T[] {
    const words = query
        .toLowerCase()
        .split(/[\s_]+/)
        .filter(Boolean);
    if (words.length === 0) {
        return items;
    }
    return items
        .map((item) => {
            const points = words.map((word) => pointsOf(word, of(item)));
            const total = points.includes(0) ? 0 : points.reduce((sum, one) => sum + one, 0);
            return { item, total };
        })
        .filter(({ total }) => total > 0)
        .sort((a, b) => b.total - a.total)
        .map(({ item }) => item);
}
