/* SPDX-License-Identifier: MIT */
/* The registry as the server describes it (`x-fieldcast` of schema.json): types, parameters,
 * defaults, limits. What values they accept is in values.ts. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "./json.ts";
import type { SurfaceValue } from "./surface.ts";

export type ParamType =
    | "float"
    | "int"
    | "bool"
    | "vec2"
    | "vec3"
    | "vec4"
    | "bvec3"
    | "ivec2"
    | "ivec3"
    | "ivec4"
    | "color"
    | "enum"
    | "text"
    | "material"
    | "points" /* of the plane: [[x, y], …]; min to max of them */
    | "code" /* GLSL, several lines */
    | "equation" /* an equation in x, y and z, several lines */
    | "surface" /* a parametric surface (surface.ts) */
    | "model" /* the name of a model of the document, or "" */
    | "function" /* the name of one of its primitives, or "" */
    | "asset" /* the id of an uploaded file, or "" */
    | "rows" /* parameters that a document declares: DeclaredRow[] */;

export type Unit = "length" | "angle" | "degrees";

/* One value of a record: what stands at a place in a document. */
export type Value =
    | number
    | boolean
    | string
    | readonly number[]
    | readonly boolean[]
    | readonly (readonly number[])[]
    | readonly DeclaredRow[]
    | SurfaceValue;

/* A parameter as a document declares it; declared.ts makes a Param of it. */
export interface DeclaredRow extends JsonObject {
    readonly name: string;
    readonly type: string;
    readonly default?: Json;
    /* Of a model: the place in its tree; its default is what is there. */
    readonly sets?: string;
    readonly range?: readonly [number, number];
    readonly doc?: string;
}

/* The values of a record that are set; what is absent has its default. */
export interface Values {
    readonly [name: string]: Value;
}

/* The value of another row of the record that makes a row matter; `not`: any other value does. */
export interface Condition {
    readonly name: string;
    readonly value: Value;
    /* It is this value, is another, or is an equation or a surface that has this letter. */
    readonly test: "=" | "!=" | "~";
}

export interface Param {
    readonly name: string;
    readonly type: ParamType;
    readonly unit: Unit | null;
    readonly default: Value;
    readonly min: number | null;
    readonly max: number | null;
    readonly aboveMin: boolean;
    readonly nonzero: boolean;
    /* One number may stand for three equal ones. */
    readonly uniform: boolean;
    /* Any length but 0. */
    readonly direction: boolean;
    readonly step: number | null;
    readonly choices: readonly string[];
    readonly main: boolean;
    /* The heading that it stands under; "": none. */
    readonly group: string;
    /* Null: it matters always. */
    readonly when: Condition | null;
    /* What is shown for 0: "auto"; "": 0 is a number like others. */
    readonly zero: string;
    /* What it shares with rows of other shaders; "": nothing. */
    readonly means: string;
    /* Where its handles are in the node's space: expressions of its record; "": nowhere. */
    readonly handle: string;
    readonly doc: string;
}

export interface TypeRow {
    readonly type: string;
    readonly doc: string;
    readonly params: readonly Param[];
}

export interface NodeType extends TypeRow {
    readonly group: string;
    readonly exactness: string;
    readonly words: string;
    /* Where its formula comes from. */
    readonly source: string;
    readonly children: "none" | "one" | "many";
}

/* An output of the renderer, a level of quality, or a stage of a frame. */
export interface NamedRow {
    readonly name: string;
    readonly doc: string;
}

/* How numbers become colours: from 0 to the greatest, evenly. */
export interface Scale {
    readonly colors: readonly string[];
    readonly greatest: number;
}

export interface Output extends NamedRow {
    /* It has a picture form, not only numbers. */
    readonly picture: boolean;
    readonly scale: Scale | null;
}

export interface Limit {
    readonly name: string;
    readonly value: number;
    readonly unit: string;
    readonly doc: string;
}

export interface Schema {
    readonly nodes: readonly NodeType[];
    readonly lights: readonly TypeRow[];
    readonly volumes: readonly TypeRow[];
    readonly shaders: readonly TypeRow[];
    readonly node: readonly Param[];
    readonly transform: readonly Param[];
    readonly camera: readonly Param[];
    readonly environment: readonly Param[];
    readonly render: readonly Param[];
    /* The members of a question about an ideal. */
    readonly ideal: readonly Param[];
    /* How the equation of a parametric surface is found. */
    readonly implicitize: readonly Param[];
    /* What a document's own distance functions, shaders and models consist of. */
    readonly primitive: readonly Param[];
    readonly shader: readonly Param[];
    readonly model: readonly Param[];
    /* Types that their parameters may have. */
    readonly declared: readonly ParamType[];
    readonly outputs: readonly Output[];
    readonly levels: readonly NamedRow[];
    readonly stages: readonly NamedRow[];
    readonly limits: readonly Limit[];
}

const COMPONENTS: Record<ParamType, number> = {
    float: 1,
    int: 1,
    bool: 1,
    vec2: 2,
    vec3: 3,
    vec4: 4,
    bvec3: 3,
    ivec2: 2,
    ivec3: 3,
    ivec4: 4,
    color: 3,
    enum: 1,
    text: 0,
    material: 0,
    points: 0,
    code: 0,
    equation: 0,
    surface: 0,
    model: 0,
    function: 0,
    asset: 0,
    rows: 0,
};

/* Numbers in one value of this type: 1 to 4, or 0 for texts and lists. */
export function components(type: ParamType): number {
    return COMPONENTS[type];
}

const ZERO: Record<ParamType, Value> = {
    float: 0,
    int: 0,
    bool: false,
    vec2: [0, 0],
    vec3: [0, 0, 0],
    vec4: [0, 0, 0, 0],
    bvec3: [false, false, false],
    ivec2: [0, 0],
    ivec3: [0, 0, 0],
    ivec4: [0, 0, 0, 0],
    color: [0, 0, 0],
    enum: "",
    text: "",
    material: "",
    points: [],
    code: "",
    equation: "",
    surface: {},
    model: "",
    function: "",
    asset: "",
    rows: [],
};

/* What a value of a type is where nothing says otherwise. */
export function zeroOf(type: ParamType): Value {
    return ZERO[type] ?? 0;
}

/* A number without bounds, and what `part` says of it. */
export function numberParam(name: string, part: Partial<Param> = {}): Param {
    return {
        name,
        type: "float",
        unit: null,
        default: 0,
        min: null,
        max: null,
        aboveMin: false,
        nonzero: false,
        uniform: false,
        direction: false,
        step: null,
        choices: [],
        main: false,
        group: "",
        when: null,
        zero: "",
        means: "",
        handle: "",
        doc: "",
        ...part,
    };
}

/* "type=sky", "opacity!=1": a word, or a number or a truth as JSON writes it. */
function readCondition(text: string): Condition | null {
    const found = /^(\w+)(=|!=|~)(.+)$/.exec(text);
    const [, name = "", test, word = ""] = found ?? [];
    if (found === null) {
        return null;
    }
    const number = Number(word);
    const truth = word === "true" || word === "false";
    const value = truth ? word === "true" : Number.isNaN(number) ? word : number;
    return { name, value, test: test as Condition["test"] };
}

function readParam(json: JsonObject): Param {
    const type = textOf(json.type, "float") as ParamType;
    return {
        name: textOf(json.name),
        type,
        unit: typeof json.unit === "string" ? (json.unit as Unit) : null,
        default: (json.default as Value | undefined) ?? zeroOf(type),
        min: typeof json.min === "number" ? json.min : null,
        max: typeof json.max === "number" ? json.max : null,
        aboveMin: json.above_min === true,
        nonzero: json.nonzero === true,
        uniform: json.uniform === true,
        direction: json.direction === true,
        step: typeof json.step === "number" && json.step > 0 ? json.step : null,
        choices: listOf(json.choices).map((choice) => textOf(choice)),
        main: json.main === true,
        group: textOf(json.group),
        when: readCondition(textOf(json.when)),
        zero: textOf(json.zero),
        means: textOf(json.means),
        handle: textOf(json.handle),
        doc: textOf(json.doc),
    };
}

function readParams(json: Json | undefined): Param[] {
    return listOf(json).filter(isObject).map(readParam);
}

function readRow(json: JsonObject): TypeRow {
    return {
        type: textOf(json.type),
        doc: textOf(json.doc),
        params: readParams(json.params),
    };
}

function readNamed(json: JsonObject): NamedRow {
    return { name: textOf(json.name), doc: textOf(json.doc) };
}

function readScale(json: Json | undefined): Scale | null {
    return isObject(json)
        ? {
              colors: listOf(json.colors).map((color) => textOf(color)),
              greatest: numberOf(json.greatest),
          }
        : null;
}

function readWords(json: Json | undefined): string {
    return Array.isArray(json) ? json.map((word) => textOf(word)).join(" ") : textOf(json);
}

function readNodeType(json: JsonObject): NodeType {
    return {
        ...readRow(json),
        group: textOf(json.group),
        exactness: textOf(json.exactness),
        words: readWords(json.words),
        source: textOf(json.source),
        children: textOf(json.children, "many") as NodeType["children"],
    };
}

/* Reads schema.json, or its `x-fieldcast` member alone. */
export function readSchema(json: Json): Schema {
    const whole = isObject(json) ? json : {};
    const inner = whole["x-fieldcast"];
    const tables = isObject(inner) ? inner : whole;
    const resources = isObject(tables.resources) ? tables.resources : {};
    return {
        nodes: listOf(tables.nodes).filter(isObject).map(readNodeType),
        lights: listOf(tables.lights).filter(isObject).map(readRow),
        volumes: listOf(tables.volumes).filter(isObject).map(readRow),
        shaders: listOf(tables.shaders).filter(isObject).map(readRow),
        node: readParams(tables.node),
        transform: readParams(tables.transform),
        camera: readParams(tables.camera),
        environment: readParams(tables.environment),
        render: readParams(tables.render),
        ideal: readParams(tables.ideal),
        implicitize: readParams(tables.implicitize),
        primitive: readParams(resources.primitive),
        shader: readParams(resources.shader),
        model: readParams(resources.model),
        declared: listOf(resources.declared_types).map((type) => textOf(type) as ParamType),
        outputs: listOf(tables.outputs)
            .filter(isObject)
            .map((json) => ({
                ...readNamed(json),
                picture: json.picture === true,
                scale: readScale(json.scale),
            })),
        levels: listOf(tables.levels).filter(isObject).map(readNamed),
        stages: listOf(tables.stages).filter(isObject).map(readNamed),
        limits: listOf(tables.limits)
            .filter(isObject)
            .map((row) => ({
                name: textOf(row.name),
                value: numberOf(row.value),
                unit: textOf(row.unit),
                doc: textOf(row.doc),
            })),
    };
}

export const EMPTY_SCHEMA: Schema = readSchema({});

const nodesByType = new WeakMap<readonly NodeType[], ReadonlyMap<string, NodeType>>();

/* Asked for every row of a tree of thousands, so by a map. */
export function nodeType(schema: Schema, type: string): NodeType | null {
    let rows = nodesByType.get(schema.nodes);
    if (rows === undefined) {
        rows = new Map(schema.nodes.map((row) => [row.type, row]));
        nodesByType.set(schema.nodes, rows);
    }
    return rows.get(type) ?? null;
}

/* One side of a flat border, without an end. */
export const isEndless = (row: NodeType | null): boolean =>
    row?.params.some(({ direction }) => direction) === true;

export function shaderType(schema: Schema, type: string): TypeRow | null {
    return schema.shaders.find((row) => row.type === type) ?? null;
}

export function findParam(params: readonly Param[], name: string): Param | null {
    return params.find((param) => param.name === name) ?? null;
}

/* Outputs that a view can show. */
export function outputsShown(schema: Schema): readonly Output[] {
    return schema.outputs.filter(({ picture }) => picture);
}

export function limitOf(schema: Schema, name: string, fallback: number): number {
    return schema.limits.find((limit) => limit.name === name)?.value ?? fallback;
}

/* What holds at `param`: the set value or the default. */
export function valueIn(values: Values, param: Param): Value {
    return values[param.name] ?? param.default;
}

/* The names in an expression. */
export function wordsIn(text: string): readonly string[] {
    return text.match(/[A-Za-z_]\w*/g) ?? [];
}

/* Without those that it defines: k := 2; ... */
function freeWordsIn(text: string): readonly string[] {
    const defined = (text.match(/[A-Za-z_]\w*(?=\s*:=)/g) ?? []) as readonly string[];
    return wordsIn(text).filter((word) => !defined.includes(word));
}

function holds({ test, value }: Condition, given: Value): boolean {
    if (test === "~") {
        const texts = isObject(given) ? Object.values(given) : [given];
        return freeWordsIn(texts.join("; ")).includes(String(value));
    }
    return (given === value) === (test === "=");
}

/* Does it make a difference what stands at `param`? What it hangs on must matter itself. */
export function matters(params: readonly Param[], values: Values, param: Param): boolean {
    if (param.when === null) {
        return true;
    }
    const other = findParam(params, param.when.name);
    return (
        other === null ||
        (holds(param.when, valueIn(values, other)) && matters(params, values, other))
    );
}

/* Rows under their headings, in the order of the first of each; those under none come first. */
export function grouped(params: readonly Param[]): readonly (readonly [string, Param[]])[] {
    const groups = new Map<string, Param[]>([["", []]]);
    for (const param of params) {
        const group = groups.get(param.group) ?? [];
        groups.set(param.group, [...group, param]);
    }
    return [...groups].filter(([, rows]) => rows.length > 0);
}
