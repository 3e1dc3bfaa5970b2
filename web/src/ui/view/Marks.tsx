/* SPDX-License-Identifier: MIT */
/* Icons in the picture for what cannot be seen in it: lights, volumes, the document's camera. A
 * click chooses one, and the gizmo then moves it. Placed outside of React. */
import { Camera as CameraIcon } from "lucide-react";
import { useEffect, useRef } from "react";
import { type Mark, marksOf } from "../../model/marks.ts";
import { projectionOf } from "../../model/projection.ts";
import type { Stores } from "../../model/stores.ts";
import { drawOver, shownCamera } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";
import { TypeIcon } from "../scene/ResourceIcon.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

/* Half of an icon. */
const REACH = 12;

/* Whether the tools at the top of the picture lie over a place. */
function underTools(field: HTMLElement): (x: number, y: number) => boolean {
    const { left, top } = field.getBoundingClientRect();
    const tools = field.parentElement?.querySelectorAll(".view-top > :not(.view-space)") ?? [];
    const boxes = [...tools].map((tool) => tool.getBoundingClientRect());
    return (x, y) =>
        boxes.some(
            (box) =>
                Math.abs(x + left - (box.left + box.right) / 2) < box.width / 2 + REACH &&
                y + top < box.bottom + REACH,
        );
}

function marksIn(stores: Stores): readonly Mark[] {
    const { document, schema } = stores.document.getState();
    const camera = shownCamera(stores);
    return document && camera ? marksOf(schema, document, camera) : [];
}

function place(stores: Stores, field: HTMLElement): void {
    const camera = shownCamera(stores);
    const size = { width: field.clientWidth, height: field.clientHeight };
    const projection = camera && projectionOf(camera, size);
    const marks = marksIn(stores);
    const isHidden = underTools(field);
    for (const element of field.children) {
        const mark = marks.find(({ key }) => key === (element as HTMLElement).dataset.mark);
        const spot = mark && projection?.spotOf(mark.at);
        const inside =
            spot &&
            spot.x > 0 &&
            spot.y > 0 &&
            spot.x < size.width &&
            spot.y < size.height &&
            !isHidden(spot.x, spot.y);
        (element as HTMLElement).hidden = !inside;
        if (inside) {
            (element as HTMLElement).style.translate = `${spot.x}px ${spot.y}px`;
        }
    }
}

function choose(editor: Editor, { list, name }: Mark): void {
    editor.show(list === null ? { kind: "camera" } : { kind: "resource", list, name });
}

export default function Marks() {
    const shown = useView(({ preferences, chromeHidden }) => preferences.marks && !chromeHidden);
    return shown ? <Field /> : null;
}

/* A mark may come under the pointer while the wheel turns: the document's camera always does. */
function passOn(event: WheelEvent): void {
    event.preventDefault();
    document.querySelector(".view-picture")?.dispatchEvent(new WheelEvent(event.type, event));
}

function Field() {
    const editor = useEditor();
    const { stores } = editor;
    const field = useRef<HTMLDivElement>(null);
    /* As a text, so that what only moves is not drawn anew. */
    const text = useDocument(({ document, schema }) =>
        document === null
            ? "[]"
            : JSON.stringify(
                  marksOf(schema, document, NOWHERE).map((mark) => ({ ...mark, at: [0, 0, 0] })),
              ),
    );
    const marks = JSON.parse(text) as readonly Mark[];
    // biome-ignore lint/correctness/useExhaustiveDependencies: other marks are placed at once
    useEffect(
        () => drawOver(stores, () => field.current && place(stores, field.current)),
        [stores, text],
    );
    useEffect(() => {
        const element = field.current;
        element?.addEventListener("wheel", passOn, { passive: false });
        return () => element?.removeEventListener("wheel", passOn);
    }, []);
    return (
        <div className="view-marks" ref={field}>
            {marks.map((mark) => (
                <MarkButton key={mark.key} mark={mark} onClick={() => choose(editor, mark)} />
            ))}
        </div>
    );
}

/* No camera is here, so that the document's is among the marks. */
const NOWHERE = {
    position: [Number.POSITIVE_INFINITY, 0, 0],
    target: [0, 0, 0],
    up: [0, 1, 0],
    fov: 45,
    height: null,
} as const;

function MarkButton({ mark, onClick }: { mark: Mark; onClick: () => void }) {
    const { list, name, type, key } = mark;
    const chosen = useView(({ subject }) =>
        list === null
            ? subject.kind === "camera"
            : subject.kind === "resource" && subject.list === list && subject.name === name,
    );
    const title = list === null ? t("marks.camera") : name;
    return (
        <button
            type="button"
            className="view-mark"
            tabIndex={-1}
            data-mark={key}
            data-chosen={chosen || undefined}
            aria-label={title}
            title={title}
            hidden
            onClick={onClick}
        >
            {list === null ? (
                <CameraIcon size={15} aria-hidden="true" />
            ) : (
                <TypeIcon list={list} type={type} size={15} />
            )}
        </button>
    );
}
