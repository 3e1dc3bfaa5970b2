/* SPDX-License-Identifier: MIT */
/* Where the selected node hangs: root first, each a way to select it. */
import { memo, useMemo } from "react";
import { nodeLabel, pathTo } from "../../model/document.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

export const Crumbs = memo(function Crumbs() {
    const { stores } = useEditor();
    const active = useView((view) => view.selection.at(-1) ?? null);
    /* A text, so that numbers that change do not render the path anew. */
    const path = useDocument((state) =>
        state.document && active !== null
            ? JSON.stringify(pathTo(state.document, active).map((n) => [n.id, nodeLabel(n)]))
            : "[]",
    );
    const nodes = useMemo(() => JSON.parse(path) as [string, string][], [path]);
    if (nodes.length === 0) {
        return null;
    }
    return (
        <nav aria-label={t("view.path")}>
            <ol className="glass crumbs">
                {nodes.map(([id, label]) => (
                    <li key={id}>
                        <button
                            type="button"
                            className="crumb ellipsis"
                            aria-current={id === active ? "true" : undefined}
                            onClick={() =>
                                stores.view.setState({
                                    selection: [id],
                                    subject: { kind: "nodes" },
                                })
                            }
                        >
                            {label}
                        </button>
                    </li>
                ))}
            </ol>
        </nav>
    );
});
