/* SPDX-License-Identifier: MIT */
/* A button for a new material: it opens the gallery. */
import { Plus } from "lucide-react";
import { useState } from "react";
import { lazyPart } from "../lazy.tsx";
import { t } from "../texts.ts";
import { NARROW, useMedia } from "../theme.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Popover } from "../widgets/Popover.tsx";

const Gallery = lazyPart(() => import("./Gallery.tsx"));

interface Props {
    title: string;
    /* The place that is to name it. */
    use: string | null;
}

export function NewMaterial({ title, use }: Props) {
    const [open, setOpen] = useState(false);
    const narrow = useMedia(NARROW);
    return (
        <Popover
            label={t("gallery.title")}
            side={narrow ? "top" : "left"}
            align="end"
            open={open}
            onOpenChange={setOpen}
            trigger={
                <IconButton title={title} data-size="s">
                    <Plus size={14} />
                </IconButton>
            }
        >
            <Gallery use={use} onClose={() => setOpen(false)} />
        </Popover>
    );
}
