// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// MathML of the server becomes elements of the page, and nothing else does.
import { createElement } from "react";
import { renderToStaticMarkup } from "react-dom/server";
import { expect, test } from "vitest";
import { mathmlNode } from "../src/ui/fields/mathml.ts";

const shown = (text: string) =>
    renderToStaticMarkup(createElement("div", null, mathmlNode(text))).slice(5, -6);
const math = (inner: string) =>
    `<math xmlns="http://www.w3.org/1998/Math/MathML" displaystyle="true">${inner}</math>`;

test("elements and attributes stay", () => {
    const inner =
        '<mrow><mi>x</mi><mo form="infix" lspace="0" rspace="0.17em">&lt;</mo><mspace width="1em"></mspace></mrow>';
    expect(shown(math(inner))).toBe(`<math displaystyle="true">${inner}</math>`);
});

test("what is unknown is left out", () => {
    expect(shown(math("<mi>x</mi><script>1</script><mtext>2</mtext>"))).toBe(
        '<math displaystyle="true"><mi>x</mi></math>',
    );
    expect(shown(math('<mi onclick="alert()" style="color: red" href="//x">x</mi>'))).toBe(
        '<math displaystyle="true"><mi>x</mi></math>',
    );
});

test("no MathML and what is not well-formed is nothing", () => {
    expect(shown("<b>x</b>")).toBe("");
    expect(shown("<math><mi>x</math>")).toBe("");
    expect(shown("")).toBe("");
});
