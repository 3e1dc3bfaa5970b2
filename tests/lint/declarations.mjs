// SPDX-License-Identifier: MIT
// Where the declarations at the beginning of a C function end: a blank line follows them.
const NO_TYPE = /^(return|goto|else|case|break|continue|if|for|while|switch|do|default)\b/;
const DECLARATION =
    /^(?:(?:static|const|volatile|extern) )*(?:(?:struct|enum|union) \w+|(?:(?:unsigned|signed|long|short) )*\w+)(?: const)?(?: \*+(?:const )?| )(?:\w+|\(\*\w+\)\([^)]*\))(?:\[[^\]]*\])*(?:;|,|\s*=|$)/;
const UNUSED = /^\(void\)\w+;/;

const bare = (line) => line.replace(/"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'/g, '0').replace(/\/\*.*?\*\//g, '');

/** Behind the declaration that begins at a line: the first line that ends it outside of all brackets. */
function behind(lines, from, end) {
    let depth = 0;
    for (let at = from; at < end; at += 1) {
        const text = bare(lines[at]);
        depth += (text.match(/[([{]/g) ?? []).length - (text.match(/[)\]}]/g) ?? []).length;
        if (depth === 0 && text.trimEnd().endsWith(';')) {
            return at + 1;
        }
    }
    return end;
}

/**
 * The line that should be blank and is not, counted from 0; -1: none. `first` and `last`: those of the
 * function. What is marked as unused counts as declared.
 */
export function missingBlank(lines, first, last) {
    const opening = lines.findIndex((line, at) => at >= first && line === '{');
    if (opening < 0 || opening > last) {
        return -1;
    }
    let at = opening + 1;
    let declared = false;
    for (; at < last; ) {
        const text = lines[at].trim();
        const isDeclaration = !NO_TYPE.test(text) && DECLARATION.test(text);
        if (!isDeclaration && !UNUSED.test(text)) {
            break;
        }
        declared ||= isDeclaration;
        at = behind(lines, at, last);
    }
    return declared && at < last && lines[at].trim() !== '' ? at : -1;
}
