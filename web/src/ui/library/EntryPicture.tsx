/* SPDX-License-Identifier: MIT */
/* The server's portrait of an entry of the library, on a tile. */
import type { EntryRow } from "../../model/libraryEntries.ts";
import { Picture } from "../scenes/Picture.tsx";
import { useEditor } from "../state.ts";
import "./library.css";

/* Pixels across, of tiles and of cards. */
const TILE = 192;
const CARD = 384;

interface Props {
    entry: EntryRow;
    /* On a card. */
    large?: boolean;
}

export function EntryPicture({ entry, large = false }: Props) {
    const { rest } = useEditor();
    const url = rest.library.pictureUrl(entry.id, large ? CARD : TILE);
    return (
        <span className="entry-picture" data-large={large || undefined}>
            <Picture key={url} url={url} slow />
        </span>
    );
}
