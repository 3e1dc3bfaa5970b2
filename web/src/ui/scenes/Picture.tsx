/* SPDX-License-Identifier: MIT */
/* The picture of a card, asked for when it is in sight. One that the server has to draw first waits
 * for its turn besides: a browser has only six connections to one server. */
import { ImageOff } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import { useEditor } from "../state.ts";
import { startNow, takeTurn } from "./turns.ts";
import "./scenes.css";

export const PICTURE_WIDTH = 480;
export const PICTURE_HEIGHT = 300;

type Loading = "waiting" | "shown" | "missing";

interface Props {
    url: string;
    /* The server has to draw it. */
    slow?: boolean;
}

export function Picture({ url, slow = false }: Props) {
    const { rest } = useEditor();
    const frame = useRef<HTMLSpanElement>(null);
    const image = useRef<HTMLImageElement>(null);
    const [loading, setLoading] = useState<Loading>("waiting");
    useEffect(() => {
        const [place, img] = [frame.current, image.current];
        if (place === null || img === null) {
            return;
        }
        let stop: (() => void) | null = null;
        const seen = new IntersectionObserver((entries) => {
            if (entries.some((entry) => entry.isIntersecting)) {
                seen.disconnect();
                const start = slow ? takeTurn : startNow;
                stop = start(async (signal) => {
                    const found = await load(img, url, rest.token, signal);
                    setLoading(found ? "shown" : "missing");
                });
            }
        });
        seen.observe(place);
        return () => {
            seen.disconnect();
            stop?.();
        };
    }, [rest, url, slow]);
    return (
        <span
            ref={frame}
            className="card-picture"
            data-waiting={loading === "waiting" || undefined}
        >
            {loading === "missing" && (
                <span className="card-missing">
                    <ImageOff size={22} aria-hidden="true" />
                </span>
            )}
            <img
                ref={image}
                alt=""
                hidden={loading !== "shown"}
                width={PICTURE_WIDTH}
                height={PICTURE_HEIGHT}
            />
        </span>
    );
}

/* False where there is no picture. Aborting frees the connection at once. */
async function load(
    image: HTMLImageElement,
    url: string,
    token: string | null,
    signal: AbortSignal,
): Promise<boolean> {
    const headers: HeadersInit = token === null ? {} : { Authorization: `Bearer ${token}` };
    const response = await fetch(url, { headers, signal });
    if (!response.ok) {
        return false;
    }
    const address = URL.createObjectURL(await response.blob());
    image.src = address;
    try {
        await image.decode();
        return true;
    } catch {
        return false;
    } finally {
        URL.revokeObjectURL(address);
    }
}
