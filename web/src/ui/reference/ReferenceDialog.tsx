/* SPDX-License-Identifier: MIT */
/* The reference over the page. */
import { useRef } from "react";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Dialog } from "../widgets/Dialog.tsx";
import { Reference } from "./Reference.tsx";

export function ReferenceDialog() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "reference");
    const field = useRef<HTMLInputElement>(null);
    return (
        <Dialog
            open={open}
            title={t("reference.title")}
            wide
            first={field}
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            <Reference field={field} />
        </Dialog>
    );
}
