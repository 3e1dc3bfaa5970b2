/* SPDX-License-Identifier: MIT */
/* Colours of code: GLSL with the spellings of HLSL, and the names that the document declares. */
import { HighlightStyle, type StreamParser } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const words = (text: string): ReadonlySet<string> => new Set(text.split(/\s+/));

const KEYWORDS = words("break const continue do else false for if in inout out return true while");
const TYPES =
    /^(void|bool|u?int|float|half|[biu]?vec[234]|mat[234](x[234])?|(bool|u?int|float|half)[1234](x[1234])?|FragmentProperties|Primitive3D|Surface)$/;
const FUNCTIONS = words(
    `abs acos acosh all any asin asinh atan atan2 atanh ceil checker clamp cos cosh cross degrees
    determinant distance dot equal exp exp2 faceforward fbm floor fma fmod frac fract greaterThan
    greaterThanEqual hash inverse inversesqrt isinf isnan length lerp lessThan lessThanEqual log
    log10 log2 mad matrixCompMult max min mix mod mul noise normalize not notEqual outerProduct pow
    radians rcp reflect refract round roundEven rsqrt saturate sdf shade sign sin sinh smoothstep
    sqrt step stripes tan tanh transpose triplanar trunc`,
);

/* `declared` is asked anew for each word: declarations change while code is open. */
export function shaderLanguage(
    declared: () => ReadonlySet<string>,
): StreamParser<{ inside: boolean }> {
    return {
        name: "glsl",
        startState: () => ({ inside: false }),
        languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } } },
        token: (stream, state) => {
            if (state.inside || stream.match("/*")) {
                state.inside = !stream.match(/^.*?\*\//);
                if (state.inside) {
                    stream.skipToEnd();
                }
                return "comment";
            }
            if (stream.eatSpace()) {
                return null;
            }
            if (stream.match("//")) {
                stream.skipToEnd();
                return "comment";
            }
            if (stream.sol() && stream.match("#")) {
                stream.skipToEnd();
                return "meta";
            }
            if (
                stream.match(/^(0[xX][\da-fA-F]+[uU]?|(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?[fFhHuU]?)/)
            ) {
                return "number";
            }
            if (stream.match(/^[A-Za-z_]\w*/)) {
                return kindOf(stream.current(), declared());
            }
            stream.next();
            return null;
        },
    };
}

function kindOf(word: string, declared: ReadonlySet<string>): string | null {
    if (declared.has(word)) {
        return "variableName.special";
    }
    if (KEYWORDS.has(word)) {
        return "keyword";
    }
    if (TYPES.test(word)) {
        return "typeName";
    }
    return FUNCTIONS.has(word) ? "variableName.function" : null;
}

/* The colours stand in code.css. */
export const shaderColours = HighlightStyle.define([
    { tag: tags.comment, class: "code-comment" },
    { tag: tags.keyword, class: "code-keyword" },
    { tag: tags.typeName, class: "code-type" },
    { tag: tags.number, class: "code-number" },
    { tag: tags.meta, class: "code-keyword" },
    { tag: tags.special(tags.variableName), class: "code-declared" },
    { tag: tags.function(tags.variableName), class: "code-function" },
]);
