/* SPDX-License-Identifier: MIT */
/* A colour: linear in the document, sRGB for the eye. What is brighter than white is a colour
 * times a strength. */
import { useRef, useState } from "react";
import { HexColorPicker } from "react-colorful";
import { numberParam } from "../../model/schema.ts";
import { type Vector, vectorOf } from "../../model/transform.ts";
import { fromHex, printNumber, splitStrength, tidy, toHex } from "../../model/units.ts";
import { numbersOf } from "../../model/values.ts";
import { t } from "../texts.ts";
import { Popover } from "../widgets/Popover.tsx";
import { Eyedropper } from "./Eyedropper.tsx";
import { NumberField } from "./Number.tsx";
import { TextField } from "./Text.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const MOST_STRENGTH = 1000;

/* What a colour was made of here. The document has the product alone, from which a strength of 3
 * could not be told where all is below white, nor the way back to 1. */
interface Made {
    base: Vector;
    strength: number;
}

const strengthParam = numberParam("strength", { default: 1, min: 1, max: MOST_STRENGTH });

export default function ColourField(props: FieldProps<readonly number[]>) {
    const { label, value, mixed, describedBy, onInput, onCommit, onCancel, onRefuse } = props;
    const colour = vectorOf(numbersOf(value));
    const made = useRef(new Map<string, Made>());
    const { base, strength } = made.current.get(colour.join()) ?? splitStrength(colour);
    const hex = toHex(base);
    const picking = useRef<readonly number[] | null>(null);
    const [shown, setShown] = useState<string | null>(null);
    const bright = (base: Vector, strength: number): number[] => {
        const product = base.map((x) => tidy(x * strength));
        made.current.set(product.join(), { base, strength });
        return product;
    };
    const pick = (next: string): void => {
        const colour = fromHex(next);
        if (colour !== null && next !== hex) {
            setShown(next);
            picking.current = bright(colour, strength);
            onInput(picking.current);
        }
    };
    const settle = (): void => {
        if (picking.current !== null) {
            onCommit(picking.current);
            picking.current = null;
        }
        setShown(null);
    };
    /* The picker tells the last place of a drag after the drag has ended. */
    const settleSoon = (): void => {
        requestAnimationFrame(() => requestAnimationFrame(settle));
    };
    return (
        <Popover
            label={label}
            side="left"
            onOpenChange={(open) => open || settle()}
            trigger={
                <button
                    type="button"
                    className="colour-button"
                    aria-label={`${label} ${hex}`}
                    aria-describedby={describedBy}
                >
                    <span className="colour-chip" style={{ background: mixed ? undefined : hex }} />
                    <span className="colour-hex">{mixed ? t("field.mixed") : hex}</span>
                    {strength > 1 && !mixed && (
                        <span className="colour-strength">× {printNumber(strength)}</span>
                    )}
                </button>
            }
        >
            {/* biome-ignore lint/a11y/noStaticElementInteractions: hears the end of a drag inside */}
            <div className="colour-sheet" onPointerUp={settleSoon} onKeyUp={settleSoon}>
                <HexColorPicker color={shown ?? hex} onChange={pick} />
                <div className="colour-row">
                    <span>{t("field.hex")}</span>
                    <TextField
                        label={`${label} ${t("field.hex")}`}
                        value={hex}
                        fallback={hex}
                        onInput={() => undefined}
                        onCancel={() => undefined}
                        onRefuse={onRefuse}
                        onCommit={(text) => {
                            const colour = fromHex(text);
                            onRefuse(colour === null ? t("field.notColour") : null);
                            if (colour !== null) {
                                onCommit(bright(colour, strength));
                            }
                        }}
                    />
                </div>
                <div className="colour-row">
                    <span>{t("field.strength")}</span>
                    <NumberField
                        param={strengthParam}
                        label={`${label} ${t("field.strength")}`}
                        value={tidy(strength)}
                        fallback={1}
                        onInput={(by) => onInput(bright(base, by))}
                        onCommit={(by) => onCommit(bright(base, by))}
                        onCancel={onCancel}
                        onRefuse={onRefuse}
                    />
                </div>
                <Eyedropper onTake={onCommit} />
            </div>
        </Popover>
    );
}
