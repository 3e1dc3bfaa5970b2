/* SPDX-License-Identifier: MIT */
/* The view with an edit that is only looked at: a picture of the document as it would be, drawn for
 * this page alone, over the stream. */
import { useEffect, useState } from "react";
import { printCamera } from "../../model/camera.ts";
import { printDocument } from "../../model/documentJson.ts";
import { apply } from "../../model/operations.ts";
import { sectionMember } from "../../model/section.ts";
import type { Trial as TrialRequest } from "../../model/view.ts";
import type { Editor } from "../editor.ts";
import { useEditor, useView } from "../state.ts";
import "./view.css";

/* What is passed over on the way to another is not drawn. */
const REST_MS = 120;
/* One at once, of a part of the view's pixels, then one that can be looked at. */
const SHOTS = [
    { scale: 0.6, level: "interactive" },
    { scale: 1, level: "still" },
] as const;

async function draw(
    editor: Editor,
    request: TrialRequest,
    shot: (typeof SHOTS)[number],
    signal: AbortSignal,
): Promise<string | null> {
    const { document, schema } = editor.stores.document.getState();
    const box = window.document.querySelector(".view-picture")?.getBoundingClientRect();
    if (document === null || !box) {
        return null;
    }
    const tried = apply(document, request.ops, schema);
    if (!tried.ok) {
        return null;
    }
    const size = (length: number): number => Math.max(16, Math.round(length * shot.scale));
    return editor.rest.renderImage(
        printDocument(tried.document),
        {
            width: size(box.width),
            height: size(box.height),
            format: "jpg",
            level: shot.level,
            camera: printCamera(editor.stores.camera.getState().camera),
            ...sectionMember(editor.stores.view.getState().section),
        },
        signal,
    );
}

export default function Trial() {
    const editor = useEditor();
    const request = useView((view) => view.trial);
    const [shown, setShown] = useState<{ request: TrialRequest; address: string } | null>(null);
    useEffect(() => {
        if (request === null) {
            setShown(null);
            return;
        }
        const stop = new AbortController();
        const drawAll = async (): Promise<void> => {
            for (const shot of SHOTS) {
                const address = await draw(editor, request, shot, stop.signal);
                if (address !== null) {
                    setShown({ request, address });
                }
            }
        };
        const timer = setTimeout(() => {
            drawAll().catch(
                () => undefined /* another is asked for, or the server says why elsewhere */,
            );
        }, REST_MS);
        return () => {
            clearTimeout(timer);
            stop.abort();
        };
    }, [editor, request]);
    useEffect(() => () => URL.revokeObjectURL(shown?.address ?? ""), [shown]);
    if (shown === null || request === null) {
        return null;
    }
    return (
        <div className="view-trial" data-testid="trial" data-shown={shown.request.name}>
            <img src={shown.address} alt="" />
            {shown.request.words !== "" && <p className="glass view-hint">{shown.request.words}</p>}
        </div>
    );
}
