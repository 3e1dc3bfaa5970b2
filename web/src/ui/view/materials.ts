/* SPDX-License-Identifier: MIT */
/* Materials that are dropped on the picture: the node under the pointer gets them. */
import type { Editor } from "../editor.ts";
import { type Carried, carriedBy, carriesMaterial, dropMaterial } from "../materials/drag.ts";

/* Answers the function that ends it. */
export function takeMaterials(editor: Editor, element: HTMLElement): () => void {
    const { view } = editor.stores;
    const listening = new AbortController();
    const options = { signal: listening.signal };
    const at = ({ clientX, clientY }: DragEvent): [number, number] => {
        const box = element.getBoundingClientRect();
        return [clientX - box.left, clientY - box.top];
    };
    const over = async (event: DragEvent): Promise<void> => {
        const picked = await editor.link.pickIdle(...at(event)).catch(() => null);
        if (picked !== null && view.getState().hovered !== picked.node) {
            view.setState({ hovered: picked.node });
        }
    };
    const drop = async (event: DragEvent, what: Carried): Promise<void> => {
        const picked = await editor.link.pick(...at(event)).catch(() => null);
        if (picked?.node != null) {
            dropMaterial(editor, what, picked.node);
        }
    };
    element.addEventListener(
        "dragover",
        (event) => {
            if (carriesMaterial(event)) {
                event.preventDefault();
                void over(event);
            }
        },
        options,
    );
    element.addEventListener(
        "drop",
        (event) => {
            if (carriesMaterial(event) && event.dataTransfer) {
                event.preventDefault();
                void drop(event, carriedBy(event.dataTransfer));
            }
        },
        options,
    );
    return () => listening.abort();
}
