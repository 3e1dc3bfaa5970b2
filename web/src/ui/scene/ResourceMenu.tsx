/* SPDX-License-Identifier: MIT */
/* What can be done with a resource, where its row and its form stand. */
import { BookmarkPlus, Copy, Ellipsis, PackagePlus, SquareCode, Trash2 } from "lucide-react";
import type { Resource } from "../../model/document.ts";
import { isSavable, type ListName } from "../../model/places.ts";
import { whyNotRemoved } from "../../model/usage.ts";
import { addInstance, codePlace, duplicate, openCode, remove } from "../insertions.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem, MenuLine, MenuNote } from "../widgets/Menu.tsx";

interface Props {
    list: ListName;
    resource: Resource;
}

export function ResourceMenu({ title, list, resource }: Props & { title: string }) {
    const { name } = resource;
    return (
        <Menu
            align="end"
            trigger={
                <IconButton title={title} data-size="s">
                    <Ellipsis size={14} />
                </IconButton>
            }
        >
            <Uses list={list} name={name} />
            <Common list={list} resource={resource} />
        </Menu>
    );
}

/* What makes something of it. */
function Uses({ list, name }: { list: ListName; name: string }) {
    const editor = useEditor();
    const schema = useDocument((state) => state.schema);
    const code = codePlace(schema, list, name);
    if (list !== "models" && list !== "primitives" && list !== "shaders") {
        return null;
    }
    return (
        <>
            <MenuItem
                icon={<PackagePlus size={14} />}
                onSelect={() => addInstance(editor, list, name)}
            >
                {t(`${list}.instance`)}
            </MenuItem>
            {code !== null && (
                <MenuItem icon={<SquareCode size={14} />} onSelect={() => openCode(editor, code)}>
                    {t("code.edit")}
                </MenuItem>
            )}
            <MenuLine />
        </>
    );
}

function Common({ list, resource }: Props) {
    const editor = useEditor();
    const { name } = resource;
    const whyNot = useDocument(({ schema, document }) =>
        document && list !== "materials" ? whyNotRemoved(schema, document, list, name) : null,
    );
    return (
        <>
            <MenuItem icon={<Copy size={14} />} onSelect={() => duplicate(editor, list, resource)}>
                {t("resource.duplicate")}
            </MenuItem>
            {isSavable(list) && (
                <MenuItem
                    icon={<BookmarkPlus size={14} />}
                    onSelect={() =>
                        void import("../library/actions.ts").then(({ saveResource }) =>
                            saveResource(editor, list, resource),
                        )
                    }
                >
                    {t("library.save")}
                </MenuItem>
            )}
            <MenuItem
                icon={<Trash2 size={14} />}
                danger
                disabled={whyNot !== null}
                onSelect={() => remove(editor, list, name)}
            >
                {t("resource.remove")}
            </MenuItem>
            {whyNot !== null && <MenuNote>{t("resource.kept", { reason: whyNot })}</MenuNote>}
        </>
    );
}
