/* SPDX-License-Identifier: MIT */
/* What stands for a resource in lists and menus: a material's ball, else a sign of its kind. */
import {
    Cloud,
    Component,
    Flashlight,
    Lightbulb,
    type LucideIcon,
    Paintbrush,
    SquareFunction,
    Sun,
} from "lucide-react";
import { findResource } from "../../model/document.ts";
import type { ListName } from "../../model/places.ts";
import { useDocument } from "../state.ts";
import { Swatch } from "../widgets/Swatch.tsx";
import { Thumbnail } from "../widgets/Thumbnail.tsx";

const icons: Record<ListName, LucideIcon> = {
    models: Component,
    materials: Paintbrush,
    lights: Lightbulb,
    volumes: Cloud,
    primitives: SquareFunction,
    shaders: Paintbrush,
};

const lightIcons: Record<string, LucideIcon> = { directional: Sun, spot: Flashlight };

interface TypeProps {
    list: ListName;
    type?: string;
    size?: number;
}

/* Of a list, or of a type where types look different. */
export function TypeIcon({ list, type = "", size = 15 }: TypeProps) {
    const Icon = (list === "lights" && lightIcons[type]) || icons[list];
    return <Icon size={size} aria-hidden="true" />;
}

interface Props {
    list: ListName;
    name: string;
    size?: number;
}

export function ResourceIcon({ list, name, size = 15 }: Props) {
    const type = useDocument(({ document }) =>
        list === "lights" && document ? (findResource(document, list, name)?.type ?? "") : "",
    );
    if (list === "materials") {
        return (
            <Thumbnail kind="material" id={name} className="swatch">
                <Swatch name={name} />
            </Thumbnail>
        );
    }
    return <TypeIcon list={list} type={type} size={size} />;
}
