/* SPDX-License-Identifier: MIT */
/* Asks what a scene file is for: a scene of its own, or a part of this one. */
import { FilePlus2, SquareStack } from "lucide-react";
import { paste } from "../../model/clipboard.ts";
import { readDocument } from "../../model/documentJson.ts";
import { readText } from "../../model/documentRead.ts";
import { parseText } from "../../model/jsonText.ts";
import { addNotice } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";
import { openFiles, type TextFile } from "../import.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import "./drop.css";

const nameOf = (path: string): string => path.replace(/^.*\//, "");

export default function Offer() {
    const editor = useEditor();
    const offered = useView((view) => view.offered);
    const close = (): void => editor.stores.view.setState({ offered: [] });
    const names = offered.map(({ path }) => nameOf(path)).join(", ");
    return (
        <Dialog
            open={offered.length > 0}
            title={t("drop.ask", { names, count: offered.length })}
            closeLabel={t("close")}
            onClose={close}
        >
            <div className="offer" data-testid="offer">
                <Button
                    look="outline"
                    icon={<SquareStack size={18} aria-hidden="true" />}
                    onClick={() => {
                        close();
                        insertScenes(editor, offered);
                    }}
                >
                    <span className="offer-text">
                        <b>{t("drop.insert")}</b>
                        <span>{t("drop.insertDoc")}</span>
                    </span>
                </Button>
                <Button
                    look="outline"
                    icon={<FilePlus2 size={18} aria-hidden="true" />}
                    onClick={() => {
                        close();
                        void openFiles(editor, offered);
                    }}
                >
                    <span className="offer-text">
                        <b>{t("drop.open", { count: offered.length })}</b>
                        <span>{t("drop.openDoc")}</span>
                    </span>
                </Button>
            </div>
        </Dialog>
    );
}

/* All files in one step of undo; a file that is wrong is told and left out. */
function insertScenes(editor: Editor, files: readonly TextFile[]): void {
    const gesture = editor.link.gesture(t("drop.insertEdit"));
    const selected: string[] = [];
    for (const { path, text } of files) {
        const { document, schema, scene } = editor.stores.document.getState();
        const reason = whyNotScene(editor, text);
        const edit = reason === null && document && paste(document, schema, [], text, scene ?? "");
        if (edit && gesture.edit(edit.ops)) {
            selected.push(...edit.select);
        } else if (reason !== null) {
            const message = t("drop.notInserted", { name: nameOf(path), reason });
            addNotice(editor.stores.notices, { level: "error", code: "files", message });
        }
    }
    gesture.end();
    if (selected.length > 0) {
        editor.stores.view.setState({ selection: selected, subject: { kind: "nodes" } });
    }
}

/* The first thing that is wrong, with its line. */
function whyNotScene(editor: Editor, text: string): string | null {
    const { schema } = editor.stores.document.getState();
    const parsed = parseText(text);
    const base = readDocument(parsed.ok ? parsed.value.json : {});
    const read = readText(schema, base, text);
    const [fault] = read.ok ? [] : read.faults;
    if (fault === undefined) {
        return null;
    }
    const line = text.slice(0, fault.from).split("\n").length;
    return t("code.at", { line, message: fault.message });
}
