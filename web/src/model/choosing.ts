/* SPDX-License-Identifier: MIT */
/* Choosing which numbers of a subtree become parameters: what there is to choose from, what a chosen
 * one is at first, why it cannot be so, and the edits that come of it. */
import { whyNotIdentifier } from "./declaredParams.ts";
import {
    findResource,
    modelNamed,
    modelOf,
    nodeParams,
    preorder,
    type Resource,
    type SceneDocument,
    type SceneNode,
} from "./document.ts";
import type { Json } from "./json.ts";
import {
    allRows,
    placeOf,
    release,
    released,
    setRows,
    settingsOf,
    type Target,
    targetOf,
} from "./modelParams.ts";
import { makeModel } from "./models.ts";
import type { Operation } from "./operation.ts";
import type { ResourceEdit } from "./resources.ts";
import {
    components,
    type DeclaredRow,
    matters,
    type Param,
    type Schema,
    type Value,
    valueIn,
} from "./schema.ts";
import { usersOf } from "./usage.ts";
import { isWhole, numbersOf } from "./values.ts";

/* A field of a node that holds numbers or switches. */
export interface Field {
    /* All of it. */
    readonly target: Target;
    readonly param: Param;
    readonly value: Value;
    readonly parts: readonly Part[];
}

/* What of a field one parameter sets: all, or one component. */
export interface Part {
    readonly component: number | null;
    readonly type: string;
}

export interface Group {
    readonly node: SceneNode;
    readonly fields: readonly Field[];
}

export interface Choice {
    readonly name: string;
    readonly target: Target;
    readonly type: string;
    /* Null: its type has none. */
    readonly range: readonly [number, number] | null;
    readonly doc: string;
}

export const keyOf = (target: Target): string => placeOf({ ...target, component: null });

function partsOf(param: Param, value: Value): readonly Part[] {
    const count = components(param.type);
    const flags = param.type === "bvec3";
    const inner = flags ? "bool" : isWhole(param.type) ? "int" : "float";
    const one: Part = { component: null, type: param.type };
    if (count === 1) {
        return [one];
    }
    const each = Array.from({ length: count }, (_, component) => ({ component, type: inner }));
    const uniform = param.uniform && new Set(numbersOf(value, count)).size === 1;
    return flags
        ? each
        : param.type === "color"
          ? [one]
          : [...(uniform ? [{ component: null, type: "float" }] : [one]), ...each];
}

function fieldsIn(
    node: SceneNode,
    group: Target["group"],
    rows: readonly Param[],
): readonly Field[] {
    return rows
        .filter((param) => components(param.type) > 0 && param.type !== "enum")
        .filter((param) => matters(rows, node[group], param))
        .map((param) => {
            const value = valueIn(node[group], param);
            return {
                target: { node: node.id, group, name: param.name, component: null },
                param,
                value,
                parts: partsOf(param, value),
            };
        });
}

/* Of a node and all below it. Where the first stands is the instance's own matter. */
export function groupsOf(schema: Schema, document: SceneDocument, top: string): readonly Group[] {
    return preorder(document, top).flatMap((id) => {
        const node = document.nodes.get(id);
        if (!node) {
            return [];
        }
        const own = fieldsIn(node, "params", nodeParams(schema, document, node));
        const place = id === top ? [] : fieldsIn(node, "transform", schema.transform);
        return own.length + place.length > 0 ? [{ node, fields: [...own, ...place] }] : [];
    });
}

/* --- one that is chosen --- */

/* From a quarter to four times what it is now, within what it may be. */
function rangeFor({ param, value }: Field, { component, type }: Part): Choice["range"] {
    if (type === "bool" || type === "color") {
        return null;
    }
    const all = numbersOf(value, components(param.type));
    const numbers = component === null ? all : [all[component] ?? 0];
    const [low, high] = param.unit === "angle" ? [-Math.PI, Math.PI] : spread(numbers);
    const least = param.min ?? Number.NEGATIVE_INFINITY;
    const most = param.max ?? Number.POSITIVE_INFINITY;
    const apart = param.nonzero || param.direction || param.aboveMin;
    const floor = apart && low <= 0 && high > 0 ? Math.min(high / 16, 0.01) : low;
    const ends = [Math.max(floor, least), Math.min(high, most)] as const;
    const whole = type === "int" || type.startsWith("ivec");
    const round = (x: number): number => (whole ? Math.round(x) : Number(x.toPrecision(2)));
    const [from, to] = ends.map(round) as [number, number];
    return from < to ? [from, to] : [from, from + 1];
}

function spread(numbers: readonly number[]): readonly [number, number] {
    const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    if (low > 0) {
        return [low / 4, high * 4];
    }
    const far = Math.max(1, 4 * Math.max(-low, high));
    return low === 0 && high === 0 ? [-1, 1] : [-far, far];
}

const asIdentifier = (text: string): string =>
    text
        .normalize("NFKD")
        .replace(/[^A-Za-z0-9]+/g, "_")
        .replace(/^_+|_+$/g, "")
        .replace(/^(?=\d)/, "n_")
        .toLowerCase()
        .slice(0, 60) || "value";

/* A name like the words. */
function nameFor(words: string, part: Part, taken: readonly string[]): string {
    const letter = part.component === null ? "" : `_${"xyzw"[part.component]}`;
    const stem = asIdentifier(`${words}${letter}`);
    let name = stem;
    for (let n = 2; taken.includes(name); n++) {
        name = `${stem}_${n}`;
    }
    return name;
}

/* `words`: what it is called. */
export function choose(field: Field, part: Part, words: string, taken: readonly string[]): Choice {
    return {
        name: nameFor(words, part, taken),
        target: { ...field.target, component: part.component },
        type: part.type,
        range: rangeFor(field, part),
        doc: "",
    };
}

/* Those that a model has. */
export function chosenIn(model: Resource): readonly Choice[] {
    return settingsOf(model).flatMap(({ name, type, sets, range, doc }) => {
        const target = targetOf(sets ?? "");
        return target ? [{ name, target, type, range: range ?? null, doc: doc ?? "" }] : [];
    });
}

/* Why a number cannot be a parameter so, or null. */
export function whyNotChoice(
    choice: Choice,
    { param }: Pick<Field, "param">,
    taken: readonly string[],
): string | null {
    const { name, range } = choice;
    const reason = whyNotIdentifier(name, taken);
    if (reason !== null || range === null) {
        return reason;
    }
    const [low, high] = range;
    if (low >= high) {
        return `${name}: the range has to go from less to more`;
    }
    if (param.aboveMin && low <= (param.min ?? 0)) {
        return `${name}: the range has to begin above ${param.min ?? 0}`;
    }
    if (low < (param.min ?? low) || high > (param.max ?? high)) {
        return `${name}: the range leaves ${param.min} to ${param.max}`;
    }
    return (param.nonzero || param.direction) && low <= 0 && high >= 0
        ? `${name}: 0 is not possible, so the range lies on one side of it`
        : null;
}

/* --- edits --- */

const rowOf = ({ name, type, target, range, doc }: Choice): DeclaredRow => ({
    name,
    type,
    sets: placeOf(target),
    ...(range === null ? {} : { range: [range[0], range[1]] as const }),
    ...(doc === "" ? {} : { doc }),
});

/* A model of a node, with parameters, and an instance in its place. */
export function makePrimitive(
    document: SceneDocument,
    schema: Schema,
    id: string,
    label: string,
    choices: readonly Choice[],
): ResourceEdit | null {
    const made = makeModel(document, schema, [id], label);
    if (!made) {
        return null;
    }
    const moved = modelOf(document, id) ? preorder(document, id) : [];
    return {
        ...made,
        label: `make primitive ${made.name}`,
        ops: [
            ...released(schema, document, moved),
            ...made.ops,
            setRows(made.name, choices.map(rowOf)),
        ],
    };
}

/* Old names of a model's parameters and the new ones; a parameter that goes has none. */
type Names = ReadonlyMap<string, string>;

function namesAfter(old: readonly DeclaredRow[], rows: readonly DeclaredRow[]): Names {
    return new Map(
        old.flatMap(({ name, type, sets }): [string, string][] => {
            const same = rows.find((row) => row.sets === sets && row.type === type);
            return same ? [[name, same.name]] : [];
        }),
    );
}

/* Rows of an outer model, with what they set of instances under its name by now. */
function followed(
    schema: Schema,
    document: SceneDocument,
    rows: readonly DeclaredRow[],
    names: ReadonlyMap<string, Names>,
): readonly DeclaredRow[] {
    return rows.flatMap((row) => {
        const target = targetOf(row.sets ?? "");
        const node = document.nodes.get(target?.node ?? "");
        const inner = modelNamed(schema, document, node);
        const fresh = target?.group === "params" && inner ? names.get(inner.name) : undefined;
        if (!target || !fresh) {
            return [row];
        }
        const name = fresh.get(target.name);
        return name === undefined ? [] : [{ ...row, sets: placeOf({ ...target, name }) }];
    });
}

/* What instances have, under the names by now. */
function valuesUnder(
    schema: Schema,
    document: SceneDocument,
    model: string,
    names: readonly (readonly [string, string])[],
): Operation[] {
    return usersOf(schema, document, "models", model).flatMap(({ name: user }) => {
        const own = document.nodes.get(user)?.params ?? {};
        return names.flatMap(([from, to]): Operation[] =>
            own[from] === undefined && own[to] === undefined
                ? []
                : [
                      {
                          op: "set",
                          at: `/nodes/${user}/params/${to}`,
                          value: (own[from] ?? null) as Json,
                      },
                  ],
        );
    });
}

/* Other parameters of a model. Instances keep their values, also under another name, and so do outer
 * models what they set of instances. */
export function changeParameters(
    document: SceneDocument,
    schema: Schema,
    model: Resource,
    choices: readonly Choice[],
): ResourceEdit {
    const old = settingsOf(model);
    const names = new Map([[model.name, namesAfter(old, choices.map(rowOf))]]);
    const isKept = ({ name }: DeclaredRow): boolean => names.get(model.name)?.get(name) === name;
    const kept = allRows(document).set(model.name, old.filter(isKept));
    /* What an outer model sets goes, and comes back once it is there under its new name. */
    const outer = release(schema, document, kept, []);
    const back = [...outer].reverse().flatMap((name) => {
        const before = settingsOf(findResource(document, "models", name) ?? model);
        const rows = followed(schema, document, before, names);
        const stay = new Set(rows.map((row) => row.name));
        names.set(name, new Map([...stay].map((one) => [one, one])));
        return rows.length > (kept.get(name)?.length ?? 0) ? [setRows(name, rows)] : [];
    });
    const values = [...names].flatMap(([name, pairs]) => {
        const lasting = new Set(kept.get(name)?.map((row) => row.name));
        const others = [...pairs].filter(([from]) => !lasting.has(from));
        return valuesUnder(schema, document, name, others);
    });
    return {
        ops: [
            ...outer.map((name) => setRows(name, kept.get(name) ?? [])),
            setRows(model.name, choices.map(rowOf)),
            ...back,
            ...values,
        ],
        label: `parameters of ${model.name}`,
        select: [],
        name: model.name,
    };
}
