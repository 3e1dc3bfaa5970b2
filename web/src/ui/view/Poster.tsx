/* SPDX-License-Identifier: MIT */
/* The last picture of the scene, whoever saw it, until the first of one's own is there. */
import { useEffect, useState } from "react";
import { useDocument, useEditor, useLink } from "../state.ts";
import "./view.css";

export function Poster() {
    const { rest } = useEditor();
    const scene = useDocument((state) => state.scene);
    const empty = useLink(({ frame }) => frame.state === "none");
    const [address, setAddress] = useState<string | null>(null);
    useEffect(() => {
        if (scene === null || !empty) {
            return;
        }
        const stop = new AbortController();
        let made: string | null = null;
        const load = async (): Promise<void> => {
            const headers: HeadersInit =
                rest.token === null ? {} : { Authorization: `Bearer ${rest.token}` };
            const response = await fetch(rest.posterUrl(scene), { headers, signal: stop.signal });
            if (response.status === 200) {
                made = URL.createObjectURL(await response.blob());
                setAddress(made);
            }
        };
        load().catch(() => undefined); /* the picture comes without it */
        return () => {
            stop.abort();
            setAddress(null);
            if (made !== null) {
                URL.revokeObjectURL(made);
            }
        };
    }, [rest, scene, empty]);
    if (address === null || !empty) {
        return null;
    }
    return (
        <div className="view-poster" data-testid="poster">
            <img src={address} alt="" />
        </div>
    );
}
