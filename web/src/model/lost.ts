/* SPDX-License-Identifier: MIT */
/* What somebody else's edit took away from under the hands of this user. Pure. */
import { findResource, type SceneDocument } from "./document.ts";
import { nameAll } from "./edits.ts";
import { type ListName, nodeOfPlace, resourceOfPlace, resourcePlace } from "./places.ts";
import { isThere } from "./problems.ts";
import type { View } from "./view.ts";

type Looked = Pick<View, "selection" | "subject" | "code">;

function placesOf({ selection, subject, code }: Looked): string[] {
    const shown =
        subject.kind === "nodes"
            ? selection.map((id) => `/nodes/${id}`)
            : subject.kind === "resource"
              ? [resourcePlace(subject.list, subject.name)]
              : [];
    return code === null ? shown : [...shown, code];
}

/* A resource is renamed by an edit that puts a copy in its place. */
function newName(
    before: SceneDocument,
    after: SceneDocument,
    list: ListName,
    name: string,
): string | null {
    const at = before[list].findIndex((resource) => resource.name === name);
    const now = after[list][at]?.name;
    return now === undefined || findResource(before, list, now) ? null : now;
}

/* `gone`: the name of what is looked at and is deleted; null: nothing is. `view`: what changes where
 * something only has another name. */
export function lostTo(
    before: SceneDocument,
    after: SceneDocument,
    view: Looked,
): { readonly gone: string | null; readonly view: Partial<Looked> } {
    const lost = placesOf(view).filter((at) => isThere(before, at) && !isThere(after, at));
    const nodes = lost.flatMap((at) => nodeOfPlace(at) ?? []);
    let gone = nodes.length > 0 ? nameAll(before, [...new Set(nodes)]) : null;
    let next: Partial<Looked> = {};
    for (const at of lost) {
        const { list, name } = resourceOfPlace(at) ?? {};
        const now = list && name && newName(before, after, list, name);
        if (now) {
            const place = at.replace(resourcePlace(list, name), resourcePlace(list, now));
            next =
                at === view.code
                    ? { ...next, code: place }
                    : { ...next, subject: { kind: "resource", list, name: now } };
        } else {
            gone ??= name ?? null;
        }
    }
    return { gone, view: next };
}
