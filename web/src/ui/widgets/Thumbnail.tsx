/* SPDX-License-Identifier: MIT */
/* A live picture of a node or a material, in a slot of fixed size. What stands in it as children is
 * shown until the picture comes, and where there is none. Asked for only while it is in sight. */
import {
    type ReactNode,
    type RefObject,
    useCallback,
    useEffect,
    useRef,
    useState,
    useSyncExternalStore,
} from "react";
import type { TileKind } from "../../link/protocol.ts";
import { useEditor } from "../state.ts";
import "./thumbnail.css";

/* The URL of the picture while `shown`; null: there is none (yet). The picture follows the scene.
 * `large`: 256 pixels wide instead of 96; nodes alone. */
export function useThumbnail(
    kind: TileKind,
    id: string,
    { large = false, shown = true }: { large?: boolean; shown?: boolean } = {},
): string | null {
    const { thumbnails } = useEditor().link;
    const subscribe = useCallback(
        (changed: () => void) =>
            shown ? thumbnails.show(kind, id, large, changed) : () => undefined,
        [thumbnails, kind, id, large, shown],
    );
    return useSyncExternalStore(subscribe, () => thumbnails.urlOf(kind, id, large));
}

/* Whether the element is in sight. */
function useInSight(element: RefObject<HTMLElement | null>): boolean {
    const [inSight, setInSight] = useState(false);
    useEffect(() => {
        if (!element.current || typeof IntersectionObserver !== "function") {
            return;
        }
        const observer = new IntersectionObserver((entries) =>
            setInSight(entries.at(-1)?.isIntersecting ?? false),
        );
        observer.observe(element.current);
        return () => observer.disconnect();
    }, [element]);
    return inSight;
}

interface Props {
    id: string;
    kind?: TileKind;
    large?: boolean;
    className?: string;
    children?: ReactNode;
}

export function Thumbnail({ id, kind = "node", large = false, className = "", children }: Props) {
    const slot = useRef<HTMLSpanElement>(null);
    const url = useThumbnail(kind, id, { large, shown: useInSight(slot) });
    return (
        <span
            ref={slot}
            className={`thumbnail ${className}`}
            data-kind={kind}
            data-ready={url === null ? undefined : ""}
            aria-hidden="true"
        >
            {url === null ? children : <img src={url} alt="" draggable={false} />}
        </span>
    );
}
