/* SPDX-License-Identifier: MIT */
/* A polynomial as it is printed: powers are raised, products have no sign. */
import { Fragment } from "react";

const POWER = /\^(\d+)/;
const THIN_SPACE = "\u2009";

export function Polynomial({ text }: { text: string }) {
    /* Every second part is an exponent. */
    const parts = text.replaceAll("*", THIN_SPACE).split(POWER);
    return parts.map((part, i) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: parts have no other name
        <Fragment key={i}>{i % 2 ? <sup>{part}</sup> : part}</Fragment>
    ));
}
