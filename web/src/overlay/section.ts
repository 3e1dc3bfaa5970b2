/* SPDX-License-Identifier: MIT */
/* The handle of the section: an arrow on the plane, which a hand or arrow keys move along the normal,
 * and the plane's outline. Placed with the camera of the picture shown. No edit: the plane is what
 * this page looks at. */
import type { Box } from "../model/camera.ts";
import { movablesOf, pivotOf } from "../model/movables.ts";
import { type Projection, projectionOf, type Spot } from "../model/projection.ts";
import { type Section, sectionRange } from "../model/section.ts";
import {
    arrowFrom,
    dragSection,
    onSection,
    type Room,
    type SectionArrow,
    type SectionGrip,
    sectionArrow,
    sectionOutline,
    stepSection,
} from "../model/sectionHandle.ts";
import type { Stores } from "../model/stores.ts";
import { shortNumber } from "../model/units.ts";
import { keysOf } from "./hands.ts";
import { handAfter } from "./hold.ts";
import { attachPointer, type Holding, type PointerActions, type Press } from "./pointer.ts";
import { drawOver, shownCamera } from "./shown.ts";

/* All of them lie over the picture. */
export interface SectionParts {
    /* As large as the picture; the pointer goes through it. */
    readonly field: HTMLElement;
    /* Inside of the field: the part that other things leave free. */
    readonly room: HTMLElement;
    /* Points to the right from the field's corner. */
    readonly arrow: HTMLElement;
    readonly outline: SVGElement;
    /* The place of the plane, beside the pointer of a drag. */
    readonly told: HTMLElement;
}

/* Keys of the arrow, as steps. */
const STEPS: Readonly<Record<string, number>> = {
    ArrowUp: 1,
    ArrowRight: 1,
    ArrowDown: -1,
    ArrowLeft: -1,
    PageUp: 10,
    PageDown: -10,
    Home: Number.NEGATIVE_INFINITY,
    End: Number.POSITIVE_INFINITY,
};

export class SectionHand {
    readonly #stores: Stores;
    readonly #parts: SectionParts;
    readonly #stops: (() => void)[];
    /* While the arrow is held: it stays at this place of the plane. */
    #grip: SectionGrip | null = null;

    /* `actions`: of the picture. What is no drag of the arrow goes through to it. */
    constructor(stores: Stores, actions: PointerActions, parts: SectionParts) {
        this.#stores = stores;
        this.#parts = parts;
        const { field, arrow } = parts;
        const listening = new AbortController();
        arrow.addEventListener("keydown", (event) => this.#key(event), listening);
        const observer = new ResizeObserver(this.#draw);
        observer.observe(field);
        this.#stops = [
            () => listening.abort(),
            () => observer.disconnect(),
            attachPointer(field, {
                ...actions,
                grab: (press) => (press.button === 0 ? this.#hold(press) : null),
            }),
            drawOver(stores, this.#draw),
            stores.view.subscribe(this.#draw),
        ];
    }

    end(): void {
        for (const stop of this.#stops) {
            stop();
        }
    }

    /* --- what a hand does --- */

    #hold(press: Press): Holding {
        const { arrow, told } = this.#parts;
        let hand: Spot = press;
        let pointer: Spot = press;
        const finish = (): void => {
            this.#grip = null;
            this.#stores.view.setState({ held: false });
            delete arrow.dataset.held;
            told.hidden = true;
            this.#draw();
        };
        return {
            start: () => {
                this.#grip = this.#gripAt(press);
                this.#stores.view.setState({ held: true });
                arrow.dataset.held = "";
                arrow.focus({ preventScroll: true });
            },
            move: (to) => {
                const { snap: snaps } = this.#stores.view.getState().preferences.hands;
                const { fine, snap } = keysOf(to.shift, to.ctrl, snaps);
                hand = handAfter(hand, pointer, to, fine);
                pointer = to;
                if (this.#grip && this.#section) {
                    this.#set(dragSection(this.#grip, hand, snap) ?? this.#section);
                    this.#tell(to);
                }
            },
            end: finish,
            cancel: () => {
                if (this.#grip && this.#section) {
                    this.#set(this.#grip.section);
                }
                finish();
            },
        };
    }

    #gripAt(from: Spot): SectionGrip | null {
        const [section, projection] = [this.#section, this.#projection];
        const arrow = section && projection && this.#arrowOf(section, projection);
        return arrow && { section, arrow, projection, from, box: this.#box };
    }

    #key(event: KeyboardEvent): void {
        const steps = STEPS[event.key];
        if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) {
            return;
        }
        event.preventDefault();
        if (this.#section) {
            this.#set(stepSection(this.#section, steps, event.shiftKey, this.#box));
        }
    }

    #set(section: Section): void {
        this.#stores.view.setState({ section });
    }

    /* --- what is shown --- */

    get #section(): Section | null {
        return this.#stores.view.getState().section;
    }

    get #box(): Box {
        return this.#stores.view.getState().extent;
    }

    get #projection(): Projection | null {
        const { clientWidth: width, clientHeight: height } = this.#parts.field;
        const camera = shownCamera(this.#stores);
        return camera && projectionOf(camera, { width, height });
    }

    get #room(): Room {
        const { offsetLeft, offsetTop, offsetWidth, offsetHeight } = this.#parts.room;
        return {
            left: offsetLeft,
            top: offsetTop,
            right: offsetLeft + offsetWidth,
            bottom: offsetTop + offsetHeight,
        };
    }

    /* The middle of the gizmo, where there is one. */
    #gizmo({ spotOf }: Projection): Spot | null {
        const { document, schema } = this.#stores.document.getState();
        const { selection, subject, preferences } = this.#stores.view.getState();
        const { tool, pivot } = preferences.hands;
        const movables = document && tool ? movablesOf(document, schema, selection, subject) : [];
        return movables.length > 0 ? spotOf(pivotOf(movables, pivot)) : null;
    }

    #arrowOf(section: Section, projection: Projection): SectionArrow | null {
        const box = this.#box;
        return this.#grip
            ? arrowFrom(onSection(section, this.#grip.arrow.at), section, box, projection)
            : sectionArrow(section, box, projection, this.#room, this.#gizmo(projection));
    }

    readonly #draw = (): void => {
        const { arrow, outline } = this.#parts;
        const [section, projection] = [this.#section, this.#projection];
        const stand = section && projection && this.#arrowOf(section, projection);
        arrow.hidden = !stand;
        outline.toggleAttribute("hidden", !stand);
        if (section && projection && stand) {
            const { foot, way } = stand;
            arrow.style.translate = `${foot.x}px ${foot.y}px`;
            arrow.style.rotate = `${Math.atan2(way.y, way.x)}rad`;
            this.#value(section);
            const lines = sectionOutline(section, stand, this.#box, projection);
            const path = lines.map((spots) => `M${spots.map(({ x, y }) => `${x} ${y}`).join("L")}`);
            for (const line of outline.children) {
                line.setAttribute("d", path.join(""));
            }
        }
    };

    #value(section: Section): void {
        const { low, high } = sectionRange(section.axis, this.#box);
        const { arrow } = this.#parts;
        arrow.ariaValueMin = String(Math.min(low, section.at));
        arrow.ariaValueMax = String(Math.max(high, section.at));
        arrow.ariaValueNow = String(section.at);
        arrow.ariaValueText = textOf(section);
    }

    #tell({ x, y }: Spot): void {
        const { told, field } = this.#parts;
        const section = this.#section;
        told.hidden = section === null;
        if (section) {
            told.textContent = textOf(section);
            told.style.translate = `${Math.min(x + 16, field.clientWidth - told.offsetWidth - 4)}px ${y + 16}px`;
        }
    }
}

const textOf = ({ axis, at }: Section): string => `${axis.toUpperCase()} ${shortNumber(at)}`;
