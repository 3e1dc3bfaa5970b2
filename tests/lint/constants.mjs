// SPDX-License-Identifier: MIT
// Locals of C functions that are written only where they are declared have to be const. The rule holds for
// numbers, truth values and enumerators. It leaves out structs, because a function that gets an array in a
// struct may write it, and pointers, because a function may change what a struct points to.
const SCALAR =
    /^(?:(?:unsigned|signed|long|short) )*(?:bool|char|short|int|long|unsigned|float|double|\w+_t|GL(?:u?int|enum|sizei|sizeiptr|float|boolean)|enum \w+) (?=\w+ = )/;

const blanks = (text) => text.replace(/[^\n]/g, ' ');

/** C without comments and texts, each character in its place. */
function bareCode(text) {
    return text.replace(/\/\*[^]*?\*\/|\/\/.*|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'/g, blanks);
}

/** Where the character `stop` stands outside of brackets, from a place on; -1: their end comes first. */
function outside(code, from, stop) {
    let depth = 0;
    for (let at = from; at < code.length; at += 1) {
        if (depth === 0 && stop.includes(code[at])) {
            return at;
        }
        depth += '([{'.includes(code[at]) ? 1 : ')]}'.includes(code[at]) ? -1 : 0;
        if (depth < 0) {
            return -1;
        }
    }
    return -1;
}

/** The names that a declaration gives a value to; none where it declares anything else. */
function namesOf(declarators) {
    const names = [];
    for (let at = 0; at < declarators.length; ) {
        const comma = outside(declarators, at, ',');
        const end = comma < 0 ? declarators.length : comma;
        const [, name] = /^\s*(\w+)\s*=[^=]/.exec(declarators.slice(at, end)) ?? [];
        if (!name) {
            return [];
        }
        names.push(name);
        at = end + 1;
    }
    return names;
}

const isWritten = (name, code) =>
    new RegExp(`\\b${name}\\s*(?:=(?!=)|[-+*/%&|^]=|<<=|>>=|\\+\\+|--|\\[.*\\] =(?!=))|(?:\\+\\+|--|(?<!&)&)${name}\\b`).test(code);

/**
 * The declarations that want a const: [{ at, names }] with the place of the type. Formatted code has a
 * function's braces alone in the first column. The file's macros may write locals of any function.
 */
export function missingConst(text) {
    const code = bareCode(text);
    const macros = (code.match(/^#define (?:.*\\\n)*.*/gm) ?? []).join('\n');
    const found = [];
    for (const { 0: body, index } of code.matchAll(/^\{$[^]*?^\}$/gm)) {
        for (const { 0: indent, index: line } of body.matchAll(/^ +(?=\w)/gm)) {
            const at = index + line + indent.length;
            const type = SCALAR.exec(code.slice(at, at + 200));
            const end = type ? outside(code, at, ';') : -1;
            if (end > 0) {
                const names = namesOf(code.slice(at + type[0].length, end));
                const block = outside(code, end, '}');
                if (names.length > 0 && !names.some((name) => isWritten(name, code.slice(end, block) + macros))) {
                    found.push({ at, names });
                }
            }
        }
    }
    return found;
}
