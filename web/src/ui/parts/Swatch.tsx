/* SPDX-License-Identifier: MIT */
/* The colour of a material, as a small ball. */
import { findResource, type Resource } from "../../model/document.ts";
import { numbersOf, type Schema, shaderType, valueIn } from "../../model/schema.ts";
import { vectorOf } from "../../model/transform.ts";
import { toHex } from "../../model/units.ts";
import { useDocument } from "../state.ts";

/* The first colour that the shader declares besides ambient light. */
export function materialHex(schema: Schema, material: Resource): string {
    const colours = shaderType(schema, material.type)?.params.filter((row) => row.type === "color");
    const param = colours?.find((row) => row.name !== "ambient") ?? colours?.[0];
    return param ? toHex(vectorOf(numbersOf(valueIn(material.values, param)))) : "#808080";
}

interface Props {
    name: string;
    className?: string;
}

export function Swatch({ name, className = "swatch" }: Props) {
    const hex = useDocument((state) => {
        const material = state.document && findResource(state.document, "materials", name);
        return material ? materialHex(state.schema, material) : "transparent";
    });
    const light = `radial-gradient(circle at 35% 30%, color-mix(in srgb, ${hex} 70%, white), ${hex} 60%)`;
    return <span className={className} style={{ background: light }} aria-hidden="true" />;
}
