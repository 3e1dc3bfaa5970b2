/* SPDX-License-Identifier: MIT */
/* MathML as elements of React: those that the server makes, with the attributes that it gives. */
import { createElement, type ReactNode } from "react";

const ELEMENTS = "math mrow mfrac msup msub msqrt mroot mspace mi mn mo".split(" ");
const ATTRIBUTES = "displaystyle form lspace rspace separator stretchy width".split(" ");

function nodeOf(node: Node): ReactNode {
    if (!(node instanceof Element)) {
        return node.nodeType === Node.TEXT_NODE ? node.textContent : null;
    }
    if (!ELEMENTS.includes(node.localName)) {
        return null;
    }
    const attributes = [...node.attributes].filter(({ name }) => ATTRIBUTES.includes(name));
    return createElement(
        node.localName,
        Object.fromEntries(attributes.map(({ name, value }) => [name, value])),
        ...[...node.childNodes].map(nodeOf),
    );
}

/* What is not well-formed, or no MathML, is nothing. */
export function mathmlNode(text: string): ReactNode {
    const { documentElement } = new DOMParser().parseFromString(text, "application/xml");
    return documentElement.localName === "math" ? nodeOf(documentElement) : null;
}
