/* SPDX-License-Identifier: MIT */
/* How a parameter's number is scrubbed, stepped, typed and shown; values are the document's. */
import type { Param } from "../../model/schema.ts";
import {
    fromShown,
    fullInUnit,
    isAngle,
    parseInUnit,
    printInUnit,
    scrubStep,
    snap,
    tidy,
    tidyAngle,
    toShown,
} from "../../model/units.ts";
import { isWhole } from "../../model/values.ts";
import type { ScrubKeys } from "./scrub.ts";

/* Degrees per pixel, and pixels per whole number. */
const DEGREES_PER_PIXEL = 0.5;
const PIXELS_PER_WHOLE = 8;
const FINE = 0.1;
/* A range wider than this is a limit rather than a slider. */
const WIDEST_SLIDER = 1000;
/* About the width of a field: a drag along it goes through the whole range. */
const SLIDER_PIXELS = 180;
const SNAP_DEGREES = 15;

export interface ArrowKeys {
    coarse: boolean;
    fine: boolean;
}

export interface Display {
    print(value: number): string;
    /* The same with all digits that matter. */
    full(value: number): string;
    /* Null where the text means nothing. */
    parse(text: string, current: number): number | null;
    /* The value after a drag of so many pixels from `start`. */
    scrub(start: number, pixels: number, keys: ScrubKeys): number;
    /* The value after one arrow key: `direction` is 1 or -1. */
    arrow(value: number, direction: number, keys: ArrowKeys): number;
}

/* The range that a value slides in; null where it is open or too wide to mean much. */
export function sliderRange({ min, max }: Param): { min: number; max: number } | null {
    const closed = min !== null && max !== null && max > min && max - min <= WIDEST_SLIDER;
    return closed ? { min, max } : null;
}

export function displayOf(param: Param): Display {
    const { unit, zero } = param;
    const whole = isWhole(param.type);
    const range = sliderRange(param);
    const round = (value: number): number => (unit === "angle" ? tidyAngle(value) : tidy(value));
    const stored = (shown: number): number => round(fromShown(tidy(shown), unit));
    const stepPerPixel = (shown: number): number => {
        if (whole) {
            return 1 / PIXELS_PER_WHOLE;
        }
        if (range !== null && !isAngle(unit)) {
            return (range.max - range.min) / SLIDER_PIXELS;
        }
        return isAngle(unit) ? DEGREES_PER_PIXEL : scrubStep(shown);
    };
    const decade = (shown: number): number => {
        if (whole) {
            return 1;
        }
        return isAngle(unit) ? SNAP_DEGREES : 10 * scrubStep(shown);
    };
    return {
        print: (value) => (value === 0 && zero !== "" ? zero : printInUnit(value, unit)),
        full: (value) => (value === 0 && zero !== "" ? zero : fullInUnit(value, unit)),
        parse: (text, current) => {
            if (zero !== "" && text.trim().toLowerCase() === zero) {
                return 0;
            }
            const value = parseInUnit(text, unit, current);
            return value === null ? null : round(value);
        },
        scrub: (start, pixels, keys) => {
            const from = toShown(start, unit);
            const to = from + pixels * stepPerPixel(from) * (keys.fine ? FINE : 1);
            const snapped = keys.snap ? snap(to, decade(from) * (keys.fine ? FINE : 1)) : to;
            return stored(whole ? Math.round(snapped) : snapped);
        },
        arrow: (value, direction, { coarse, fine }) => {
            const shown = toShown(value, unit);
            const plain = whole || isAngle(unit) ? 1 : 10 * scrubStep(shown);
            const step = param.step === null ? plain : toShown(param.step, unit);
            const scaled = step * (coarse ? 10 : 1) * (fine && !whole ? FINE : 1);
            return stored(shown + scaled * direction);
        },
    };
}
