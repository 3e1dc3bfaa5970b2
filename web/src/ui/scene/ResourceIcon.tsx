/* SPDX-License-Identifier: MIT */
/* What stands for a resource in lists and menus: a material's ball, else a sign of its kind. */
import {
    Component,
    Lightbulb,
    type LucideIcon,
    Paintbrush,
    SquareFunction,
    Sun,
} from "lucide-react";
import { findResource } from "../../model/document.ts";
import type { ListName } from "../../model/places.ts";
import { Swatch } from "../parts/Swatch.tsx";
import { useDocument } from "../state.ts";

const icons: Record<ListName, LucideIcon> = {
    models: Component,
    materials: Paintbrush,
    lights: Lightbulb,
    primitives: SquareFunction,
    shaders: Paintbrush,
};

export function ListIcon({ list, size = 15 }: { list: ListName; size?: number }) {
    const Icon = icons[list];
    return <Icon size={size} aria-hidden="true" />;
}

export function LightIcon({ type, size = 15 }: { type: string; size?: number }) {
    const Icon = type === "directional" ? Sun : Lightbulb;
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
        return <Swatch name={name} />;
    }
    return list === "lights" ? (
        <LightIcon type={type} size={size} />
    ) : (
        <ListIcon list={list} size={size} />
    );
}
