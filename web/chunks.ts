/* SPDX-License-Identifier: MIT */
/* How the page's modules are put into files. The browser asks for one file of what it needs for the
 * first sight, and for one of all parts that come when it is idle: many small files cost a request
 * each, which a slow line feels. Editors of text come alone, with the first text that is opened. */
import type { Rollup } from "vite";

/* Modules that are asked for with what they begin with, not with the parts. */
const EDITOR = "/mount.ts";

/* What modules need at once, themselves included. */
function closureOf(ids: Iterable<string>, { getModuleInfo }: Rollup.ManualChunkMeta): Set<string> {
    const found = new Set(ids);
    for (const id of found) {
        for (const needed of getModuleInfo(id)?.importedIds ?? []) {
            found.add(needed);
        }
    }
    return found;
}

function partsOf(meta: Rollup.ManualChunkMeta): ReadonlySet<string> {
    const infos = [...meta.getModuleIds()].flatMap((id) => meta.getModuleInfo(id) ?? []);
    const entries = infos.filter(({ isEntry }) => isEntry).map(({ id }) => id);
    const late = infos.flatMap(({ dynamicallyImportedIds }) => dynamicallyImportedIds);
    const first = closureOf(entries, meta);
    const parts = closureOf(
        late.filter((id) => !id.endsWith(EDITOR)),
        meta,
    );
    return new Set([...parts].filter((id) => !first.has(id)));
}

/* One build's: the graph of modules is read when its first module is asked for. */
export function chunks(): Rollup.GetManualChunk {
    let parts: ReadonlySet<string> | null = null;
    return (id, meta) => {
        parts ??= partsOf(meta);
        return parts.has(id) ? "parts" : undefined;
    };
}
