/* SPDX-License-Identifier: MIT */
/* The colour of a material, as a small ball. */
import {
    findResource,
    type Resource,
    resourceParams,
    type SceneDocument,
} from "../../model/document.ts";
import { type Schema, valueIn } from "../../model/schema.ts";
import { vectorOf } from "../../model/transform.ts";
import { toHex } from "../../model/units.ts";
import { numbersOf } from "../../model/values.ts";
import { useDocument } from "../state.ts";

/* The first colour that the shader declares besides ambient light. */
export function materialHex(schema: Schema, document: SceneDocument, material: Resource): string {
    const params = resourceParams(schema, document, "materials", material.type);
    const colours = params.filter((row) => row.type === "color");
    const param = colours.find((row) => row.name !== "ambient") ?? colours[0];
    return param ? toHex(vectorOf(numbersOf(valueIn(material.values, param)))) : "#808080";
}

/* The background of something round in a colour. */
export function ball(hex: string): string {
    return `radial-gradient(circle at 35% 30%, color-mix(in srgb, ${hex} 70%, white), ${hex} 60%)`;
}

interface Props {
    name: string;
    className?: string;
}

export function Swatch({ name, className = "swatch" }: Props) {
    const hex = useDocument((state) => {
        const { document, schema } = state;
        const material = document && findResource(document, "materials", name);
        return material ? materialHex(schema, document, material) : "transparent";
    });
    return <span className={className} style={{ background: ball(hex) }} aria-hidden="true" />;
}
