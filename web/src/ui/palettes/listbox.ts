/* SPDX-License-Identifier: MIT */
/* A search field over a list or grid of options: arrows move, Enter takes, the field keeps the
 * focus (the ARIA combobox pattern). Rows of a grid are found by where the options stand. */
import { useEffect, useId, useRef, useState } from "react";

interface Listbox {
    active: number;
    listId: string;
    optionId: (index: number) => string;
    list: React.RefObject<HTMLDivElement | null>;
    hover: (index: number) => void;
    onKeyDown: (event: React.KeyboardEvent) => void;
}

/* `query` resets the place to the first option. */
export function useListbox(count: number, query: string, take: (index: number) => void): Listbox {
    const id = useId();
    const list = useRef<HTMLDivElement>(null);
    const [active, setActive] = useState(0);
    // biome-ignore lint/correctness/useExhaustiveDependencies: a new search starts at the top
    useEffect(() => setActive(0), [query]);
    const now = Math.min(active, Math.max(0, count - 1));
    const optionId = (index: number): string => `${id}-${index}`;
    const go = (index: number): void => {
        const next = Math.min(count - 1, Math.max(0, index));
        setActive(next);
        document.getElementById(optionId(next))?.scrollIntoView({ block: "nearest" });
    };
    return {
        active: now,
        listId: `${id}-list`,
        optionId,
        list,
        hover: setActive,
        onKeyDown: (event) => {
            const grid = list.current?.dataset.grid !== undefined;
            const next = target(event.key, now, grid, list.current);
            if (next !== null) {
                event.preventDefault();
                go(next);
            } else if (event.key === "Enter" && count > 0) {
                event.preventDefault();
                take(now);
            }
        },
    };
}

const PAGE = 8;

/* Where a key leads, possibly beyond the ends; null: it does not move. */
function target(key: string, from: number, grid: boolean, list: HTMLElement | null): number | null {
    switch (key) {
        case "ArrowDown":
            return vertical(list, from, 1);
        case "ArrowUp":
            return vertical(list, from, -1);
        case "PageDown":
            return from + PAGE;
        case "PageUp":
            return from - PAGE;
        case "ArrowRight":
            return grid ? from + 1 : null;
        case "ArrowLeft":
            return grid ? from - 1 : null;
        default:
            return null;
    }
}

/* The option above or below: of the nearest other row, the one nearest sideways. */
function vertical(list: HTMLElement | null, from: number, direction: 1 | -1): number {
    const options = [...(list?.querySelectorAll<HTMLElement>("[role='option']") ?? [])];
    const here = options[from]?.getBoundingClientRect();
    if (!here) {
        return from + direction;
    }
    let best = -1;
    let bestRow = Number.POSITIVE_INFINITY;
    let bestSide = Number.POSITIVE_INFINITY;
    options.forEach((option, index) => {
        const box = option.getBoundingClientRect();
        const row = (box.top - here.top) * direction;
        const side = Math.abs(box.left - here.left);
        if (row > 4 && (row < bestRow - 4 || (row < bestRow + 4 && side < bestSide))) {
            best = index;
            bestRow = row;
            bestSide = side;
        }
    });
    return best < 0 ? from : best;
}
