/* SPDX-License-Identifier: MIT */
/* The library as a dialog: what it has as cards, with what can be done with each; files of it. */
import { BookmarkPlus, Download, Upload } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { search } from "../../model/search.ts";
import { useEditor, useLibrary, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Filter } from "../widgets/Filter.tsx";
import { exportLibrary, importLibrary, refreshLibrary } from "./actions.ts";
import { EntryCard } from "./EntryCard.tsx";
import "./library.css";

export function LibraryDialog() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "library");
    const field = useRef<HTMLInputElement>(null);
    return (
        <Dialog
            open={open}
            title={t("library.title")}
            wide
            first={field}
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            <Body field={field} />
        </Dialog>
    );
}

function Body({ field }: { field: React.RefObject<HTMLInputElement | null> }) {
    const editor = useEditor();
    const entries = useLibrary((state) => state.entries);
    const [query, setQuery] = useState("");
    const [failed, setFailed] = useState("");
    useEffect(() => {
        refreshLibrary(editor).catch((error: unknown) => setFailed(String(error)));
    }, [editor]);
    const empty = entries?.length === 0;
    return (
        <div className="library" data-testid="library">
            <div className="library-bar">
                <Filter ref={field} label={t("library.search")} value={query} onChange={setQuery} />
                <Button
                    look="outline"
                    icon={<Upload size={14} />}
                    onClick={() => importLibrary(editor)}
                >
                    {t("library.import")}
                </Button>
                <Button
                    look="outline"
                    icon={<Download size={14} />}
                    disabled={entries === null || empty}
                    onClick={() => exportLibrary(editor)}
                >
                    {t("library.export")}
                </Button>
            </div>
            <div className="library-body">
                {empty ? <Empty /> : <Cards entries={entries} query={query} failed={failed} />}
            </div>
            <p className="library-doc">{t("library.doc")}</p>
        </div>
    );
}

function Empty() {
    return (
        <div className="library-empty">
            <BookmarkPlus size={28} aria-hidden="true" />
            <strong>{t("library.empty")}</strong>
            <p>{t("library.emptyHow")}</p>
        </div>
    );
}

interface CardsProps {
    entries: readonly EntryRow[] | null;
    query: string;
    failed: string;
}

function Cards({ entries, query, failed }: CardsProps) {
    if (entries === null) {
        return <p className="empty-note">{failed || t("library.loading")}</p>;
    }
    const found = search(entries, query, ({ name, kind }) => ({
        name,
        kind: t(`library.kind.${kind}`),
    }));
    if (found.length === 0) {
        return <p className="empty-note">{t("library.none", { query })}</p>;
    }
    return (
        <ul className="library-cards">
            {found.map((entry) => (
                <EntryCard key={entry.id} entry={entry} />
            ))}
        </ul>
    );
}
