/* SPDX-License-Identifier: MIT */
/* The server's picture of a node type; its drawing where there is none. */
import { useEffect, useState } from "react";
import { useEditor } from "../state.ts";
import { Glyph } from "../widgets/Glyph.tsx";
import "./palettes.css";

interface Props {
    type: string;
    group: string | undefined;
    /* Of the drawing that stands in. */
    size?: number;
}

/* Types that were asked for in vain: not asked for again. */
const missing = new Set<string>();

export function TypePicture({ type, group, size = 30 }: Props) {
    const [shown, setShown] = useState(!missing.has(type));
    const address = useAddress(type);
    return (
        <span className="type-picture">
            {shown && address !== null ? (
                <img
                    src={address}
                    alt=""
                    loading="lazy"
                    decoding="async"
                    onError={() => {
                        missing.add(type);
                        setShown(false);
                    }}
                />
            ) : (
                <Glyph type={type} group={group} size={size} />
            )}
        </span>
    );
}

/* An <img> cannot carry a token. */
function useAddress(type: string): string | null {
    const { rest } = useEditor();
    const plain = rest.referenceImageUrl(type);
    const [fetched, setFetched] = useState<string | null>(null);
    useEffect(() => {
        if (rest.token === null || missing.has(type)) {
            return;
        }
        let address: string | null = null;
        let gone = false;
        rest.fetchImage(plain).then(
            (url) => {
                address = url;
                if (gone) {
                    URL.revokeObjectURL(url);
                } else {
                    setFetched(url);
                }
            },
            () => missing.add(type),
        );
        return () => {
            gone = true;
            if (address !== null) {
                URL.revokeObjectURL(address);
            }
        };
    }, [rest, type, plain]);
    return rest.token === null ? plain : fetched;
}
