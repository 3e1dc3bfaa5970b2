/* SPDX-License-Identifier: MIT */
/* The reference over the page; what it shows is loaded when it is first opened. */
import { lazy, Suspense, useRef } from "react";
import { Dialog } from "../parts/Dialog.tsx";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";

const Reference = lazy(() => import("./Reference.tsx"));

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
            <Suspense fallback={<p className="empty-note">{t("reference.loading")}</p>}>
                <Reference field={field} />
            </Suspense>
        </Dialog>
    );
}
