/* SPDX-License-Identifier: MIT */
/* JSON as a text that people edit: where each value stands, what is wrong and where, and printing
 * as the server prints. */
import { isObject, type Json } from "./json.ts";

/* From the first character to behind the last. */
export interface Span {
    readonly from: number;
    readonly to: number;
}

/* A value and where it stands. */
export interface Located extends Span {
    readonly json: Json;
    /* Of an object: by name, with the place of the name. */
    readonly members: ReadonlyMap<string, { readonly key: Span; readonly value: Located }>;
    /* Of a list. */
    readonly items: readonly Located[];
}

export interface SyntaxFault extends Span {
    readonly message: string;
}

export type ParsedText =
    | { readonly ok: true; readonly value: Located }
    | { readonly ok: false; readonly fault: SyntaxFault };

class Fault extends Error {
    readonly fault: SyntaxFault;
    constructor(from: number, to: number, message: string) {
        super(message);
        this.fault = { from, to, message };
    }
}

const SPACE = /[ \t\n\r]*/y;
const NUMBER = /-?(0|[1-9]\d*)(\.\d+)?([eE][-+]?\d+)?/y;
const STRING = /"(?:[^"\\\p{Cc}]|\\(?:["\\/bfnrt]|u[\da-fA-F]{4}))*"/uy;
const WORD = /[A-Za-z_][\w]*|[^\s{}[\]",:]+/y;
const WORDS: ReadonlyMap<string, Json> = new Map<string, Json>([
    ["true", true],
    ["false", false],
    ["null", null],
]);
const NO_MEMBERS: Located["members"] = new Map();
/* Nesting that the server reads. */
const DEPTH = 160;

class Parser {
    readonly #text: string;
    #at = 0;
    #depth = 0;

    constructor(text: string) {
        this.#text = text;
    }

    document(): Located {
        const value = this.#value("the document");
        this.#space();
        if (this.#at < this.#text.length) {
            throw this.#fault("nothing may follow the document");
        }
        return value;
    }

    #take(pattern: RegExp): string | null {
        pattern.lastIndex = this.#at;
        const found = pattern.exec(this.#text)?.[0];
        this.#at += found?.length ?? 0;
        return found ?? null;
    }

    #space(): void {
        this.#take(SPACE);
    }

    /* At what stands here: a word, a character, or the end of the text. */
    #fault(message: string): Fault {
        const from = this.#at;
        const word = this.#take(WORD);
        const to = Math.min(this.#text.length, from + Math.max(1, word?.length ?? 1));
        return new Fault(from, to, message);
    }

    #next(): string {
        this.#space();
        return this.#text[this.#at] ?? "";
    }

    #value(what: string): Located {
        const first = this.#next();
        const from = this.#at;
        if (first === "{" || first === "[") {
            this.#depth++;
            if (this.#depth > DEPTH) {
                throw this.#fault(`more levels than the maximum ${DEPTH}`);
            }
            const value = first === "{" ? this.#object(from) : this.#list(from);
            this.#depth--;
            return value;
        }
        return this.#scalar(from, first, what);
    }

    #scalar(from: number, first: string, what: string): Located {
        const leaf = (json: Json): Located => ({
            from,
            to: this.#at,
            json,
            members: NO_MEMBERS,
            items: [],
        });
        if (first === '"') {
            return leaf(this.#string());
        }
        const number = this.#take(NUMBER);
        if (number !== null && !/[\w.]/.test(this.#text[this.#at] ?? "")) {
            return leaf(Number(number));
        }
        this.#at = from;
        const word = this.#take(WORD) ?? "";
        if (WORDS.has(word)) {
            return leaf(WORDS.get(word) ?? null);
        }
        this.#at = from;
        throw this.#fault(word === "" ? `${what} is missing` : `${word} is no value of JSON`);
    }

    #string(): string {
        const from = this.#at;
        const text = this.#take(STRING);
        if (text === null) {
            const line = this.#text.indexOf("\n", from);
            const to = line < 0 ? this.#text.length : line;
            throw new Fault(from, to, "this text does not end, or holds what no text may");
        }
        return JSON.parse(text) as string;
    }

    /* "," or the end of an object or a list; says whether more comes. */
    #more(end: string): boolean {
        const next = this.#next();
        if (next !== "," && next !== end) {
            throw this.#fault(`expected , or ${end}`);
        }
        this.#at++;
        if (next === "," && this.#next() === end) {
            throw this.#fault(`nothing follows the comma before ${end}`);
        }
        return next === ",";
    }

    #list(from: number): Located {
        const items: Located[] = [];
        this.#at++;
        if (this.#next() === "]") {
            this.#at++;
        } else {
            do {
                items.push(this.#value("a value of the list"));
            } while (this.#more("]"));
        }
        const json = items.map((item) => item.json);
        return { from, to: this.#at, json, members: NO_MEMBERS, items };
    }

    #object(from: number): Located {
        const members = new Map<string, { key: Span; value: Located }>();
        this.#at++;
        if (this.#next() === "}") {
            this.#at++;
        } else {
            do {
                this.#member(members);
            } while (this.#more("}"));
        }
        const json = Object.fromEntries(
            [...members].map(([name, { value }]) => [name, value.json]),
        );
        return { from, to: this.#at, json, members, items: [] };
    }

    #member(members: Map<string, { key: Span; value: Located }>): void {
        if (this.#next() !== '"') {
            throw this.#fault("expected a name in quotes");
        }
        const from = this.#at;
        const name = this.#string();
        const key = { from, to: this.#at };
        if (members.has(name)) {
            throw new Fault(key.from, key.to, `"${name}" stands here twice`);
        }
        if (this.#next() !== ":") {
            throw this.#fault(`expected : behind "${name}"`);
        }
        this.#at++;
        members.set(name, { key, value: this.#value(`the value of "${name}"`) });
    }
}

export function parseText(text: string): ParsedText {
    try {
        return { ok: true, value: new Parser(text).document() };
    } catch (error) {
        if (error instanceof Fault) {
            return { ok: false, fault: error.fault };
        }
        throw error;
    }
}

/* --- printing: protocol/json_print.c --- */

const LINE_WIDTH = 96;

/* At most lists of scalars inside: may stand on one line. */
function isFlat(json: Json): boolean {
    return Object.values(json as object).every(
        (item) => !isObject(item) && (!Array.isArray(item) || item.every(isScalar)),
    );
}

function isScalar(json: Json): boolean {
    return json === null || typeof json !== "object";
}

function printLine(json: Json): string {
    if (Array.isArray(json)) {
        return `[${json.map(printLine).join(", ")}]`;
    }
    if (isObject(json)) {
        const members = Object.entries(json).map(
            ([name, value]) => `${JSON.stringify(name)}: ${printLine(value ?? null)}`,
        );
        return `{${members.join(", ")}}`;
    }
    return JSON.stringify(json);
}

/* In UTF-8, as the server counts. */
export function bytesOf(line: string): number {
    let bytes = 0;
    for (const character of line) {
        const code = character.codePointAt(0) ?? 0;
        bytes += code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    }
    return bytes;
}

function printAt(json: Json, indent: string): string {
    const items = isScalar(json) ? [] : Object.entries(json as object);
    if (items.length === 0) {
        return printLine(json);
    }
    if (isFlat(json)) {
        const line = printLine(json);
        if (bytesOf(line) + indent.length <= LINE_WIDTH) {
            return line;
        }
    }
    const inner = `${indent}  `;
    const list = Array.isArray(json);
    const lines = items.map(
        ([name, value]) =>
            `${inner}${list ? "" : `${JSON.stringify(name)}: `}${printAt(value, inner)}`,
    );
    return `${list ? "[" : "{"}\n${lines.join(",\n")}\n${indent}${list ? "]" : "}"}`;
}

/* The text that the server prints of the same values; it ends with a line's end. */
export function printText(json: Json): string {
    return `${printAt(json, "")}\n`;
}
