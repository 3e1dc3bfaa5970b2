/* SPDX-License-Identifier: MIT */
/* The scene panel: what can be added, a filter, the tree of nodes. */
import { Plus } from "lucide-react";
import { useState } from "react";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Filter } from "../widgets/Filter.tsx";
import { Tree } from "./Tree.tsx";
import { useTreeDocument } from "./treeDocument.ts";
import "./scene.css";

export function Scene() {
    const editor = useEditor();
    const document = useTreeDocument();
    const [query, setQuery] = useState("");
    return (
        <>
            <div className="panel-head">
                <h2 className="panel-title">{t("scene.title")}</h2>
                <IconButton
                    title={t("add.title")}
                    data-size="s"
                    onClick={() => editor.stores.view.setState({ popup: "add" })}
                >
                    <Plus size={15} />
                </IconButton>
            </div>
            <Filter
                className="tree-filter"
                label={t("scene.filter")}
                value={query}
                onChange={setQuery}
            />
            {document && <Tree document={document} query={query} />}
        </>
    );
}
