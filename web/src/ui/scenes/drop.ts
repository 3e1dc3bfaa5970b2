/* SPDX-License-Identifier: MIT */
/* A file dropped anywhere on the page; answers whether one hovers now. */
import { useEffect, useRef, useState } from "react";

export function useDrop(onFile: (file: File) => void): boolean {
    const [hovering, setHovering] = useState(false);
    const latest = useRef(onFile);
    latest.current = onFile;
    useEffect(() => {
        const listening = new AbortController();
        const options = { signal: listening.signal };
        const holdsFile = (event: DragEvent): boolean =>
            event.dataTransfer?.types.includes("Files") ?? false;
        window.addEventListener(
            "dragover",
            (event) => {
                if (holdsFile(event)) {
                    event.preventDefault();
                    setHovering(true);
                }
            },
            options,
        );
        window.addEventListener(
            "dragleave",
            (event) => event.relatedTarget === null && setHovering(false),
            options,
        );
        window.addEventListener(
            "drop",
            (event) => {
                setHovering(false);
                const file = event.dataTransfer?.files[0];
                if (file) {
                    event.preventDefault();
                    latest.current(file);
                }
            },
            options,
        );
        return () => listening.abort();
    }, []);
    return hovering;
}
