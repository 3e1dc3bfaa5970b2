/* SPDX-License-Identifier: MIT */
/* Takes the colour of a surface from the picture: its own, without light and shadow. */
import { Pipette } from "lucide-react";
import { useEffect, useState } from "react";
import { tidy } from "../../model/units.ts";
import { useEditor } from "../state.ts";
import { pixelAt } from "../view/pixel.ts";
import { Button } from "../widgets/Button.tsx";

const OUTPUT = "albedo";
const TEXT = { take: "Take from the picture", click: "Click what has it, or Esc" };

/* The next press is for the eyedropper, wherever it is; its click too. */
function swallow(event: Event): void {
    event.preventDefault();
    event.stopImmediatePropagation();
}

/* While `active`, calls `onTake` with the colour where the picture is pressed, or `onEnd`. */
function usePress(
    active: boolean,
    onTake: (colour: readonly number[]) => void,
    onEnd: () => void,
): void {
    const editor = useEditor();
    // biome-ignore lint/correctness/useExhaustiveDependencies: it is one press
    useEffect(() => {
        if (!active) {
            return;
        }
        const ended = new AbortController();
        const settings = { capture: true, signal: ended.signal };
        const press = (event: PointerEvent): void => {
            swallow(event);
            const picture = (event.target as Element).closest(".view-picture");
            window.addEventListener("click", swallow, { capture: true, once: true });
            onEnd();
            if (picture) {
                pixelAt(editor, picture, event, OUTPUT, new AbortController().signal).then(
                    (colour) => colour && onTake(colour.slice(0, 3).map(tidy)),
                    () => undefined,
                );
            }
        };
        const leave = (event: KeyboardEvent): void => {
            if (event.key === "Escape") {
                swallow(event);
                onEnd();
            }
        };
        window.addEventListener("pointerdown", press, settings);
        window.addEventListener("keydown", leave, settings);
        document.documentElement.dataset.eyedropper = "";
        return () => {
            ended.abort();
            delete document.documentElement.dataset.eyedropper;
        };
    }, [active]);
}

export function Eyedropper({ onTake }: { onTake: (colour: readonly number[]) => void }) {
    const [active, setActive] = useState(false);
    usePress(active, onTake, () => setActive(false));
    return (
        <Button
            look="outline"
            icon={<Pipette size={14} aria-hidden="true" />}
            aria-pressed={active}
            onClick={() => setActive(!active)}
        >
            {active ? TEXT.click : TEXT.take}
        </Button>
    );
}
