/* SPDX-License-Identifier: MIT */
/* Everything that floats over the page: palettes, keys, the picture as a file, the reference,
 * the library. One part, loaded later. */
import { lazyPart } from "../lazy.tsx";
import { LibraryDialog } from "../library/LibraryDialog.tsx";
import { ReferenceDialog } from "../reference/ReferenceDialog.tsx";
import { Add } from "./Add.tsx";
import { CommandPalette } from "./Commands.tsx";
import { Keys } from "./Keys.tsx";
import { PictureDialog } from "./PictureDialog.tsx";

const PrimitiveDialog = lazyPart(() => import("../primitives/PrimitiveDialog.tsx"));
const Workbench = lazyPart(() => import("../algebra/Workbench.tsx"));

export default function Palettes() {
    return (
        <>
            <Add />
            <CommandPalette />
            <Keys />
            <PictureDialog />
            <ReferenceDialog />
            <LibraryDialog />
            <PrimitiveDialog />
            <Workbench />
        </>
    );
}
