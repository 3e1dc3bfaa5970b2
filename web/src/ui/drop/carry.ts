/* SPDX-License-Identifier: MIT */
/* Additions that are dragged from a palette onto the picture. They land on the surface under the
 * pointer: a ring lies there and words say what becomes of it at once, a picture follows when the
 * pointer rests. Their palette steps aside meanwhile, and comes back where nothing was let go. */
import type { DragEvent as ReactDragEvent } from "react";
import type { PickedMessage } from "../../link/protocol.ts";
import { perform } from "../../model/actions.ts";
import { addNode, whatAdding } from "../../model/add.ts";
import { pointUnder } from "../../model/camera.ts";
import { nodeLabel, type SceneDocument } from "../../model/document.ts";
import type { Edit } from "../../model/edits.ts";
import { isObject, type JsonObject, textOf } from "../../model/json.ts";
import { type Ground, landingBeside } from "../../model/landing.ts";
import { takeEntry } from "../../model/library.ts";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { projectionOf, type Spot } from "../../model/projection.ts";
import type { Schema } from "../../model/schema.ts";
import { add, cross, normalize, scale, type Vector, vectorOf } from "../../model/transform.ts";
import { shownCamera } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";
import { remember } from "../insertions.ts";
import type { Offer } from "../palettes/additions.ts";
import { t } from "../texts.ts";
import "./drop.css";

/* What is pointed at. */
interface Landing {
    readonly seen: string | null;
    readonly selection: readonly string[];
    readonly ground: Ground;
}

interface Outcome {
    readonly edit: Edit;
    readonly words: string;
}

/* What is carried: what would come of it. Null: nothing. */
type Carried = (document: SceneDocument, schema: Schema, landing: Landing) => Outcome | null;

/* What is at a spot. */
interface Seen {
    readonly landing: Landing | null;
    readonly outcome: Outcome | null;
}

function carriedOffer({ stores }: Editor, offer: Offer): Carried {
    return (document, schema, { selection, ground }) => {
        const { way } = stores.view.getState().preferences;
        return {
            edit: addNode(document, schema, offer, selection, way, ground),
            words: whatAdding(document, schema, offer, selection, way).words,
        };
    };
}

async function carriedEntry({ stores, rest }: Editor, { id }: EntryRow): Promise<Carried> {
    const entry = await rest.library.read(id);
    const { root } = entry.document;
    const type = textOf(isObject(root) ? root.type : undefined);
    return (document, schema, { seen, selection, ground }) => {
        const { way } = stores.view.getState().preferences;
        const isMaterial = entry.kind === "material";
        const node = document.nodes.get(seen ?? "");
        if (isMaterial && !node) {
            return null;
        }
        const target = isMaterial
            ? { selection: [], way, use: `/nodes/${seen}/material` }
            : { selection, way, ground };
        const edit = takeEntry(schema, document, entry, target);
        const words =
            isMaterial && node
                ? t("land.gives", { name: nodeLabel(node) })
                : whatAdding(document, schema, { type }, selection, way).words;
        return edit && { edit, words };
    };
}

/* --- what is shown meanwhile --- */

const CORNERS = 48;
/* Pixels where it lies. */
const RADIUS = 22;

const NAMESPACE = "http://www.w3.org/2000/svg";

/* A ring that lies on the surface, with a stem along its normal, and words beside it. */
class Mark {
    readonly #element: HTMLElement;
    readonly #lines: SVGPathElement[];
    readonly #words: HTMLElement;

    constructor(view: Element) {
        this.#element = document.createElement("div");
        this.#element.className = "landing";
        this.#element.dataset.testid = "landing";
        const drawing = document.createElementNS(NAMESPACE, "svg");
        drawing.setAttribute("class", "measured-line");
        this.#lines = ["measured-halo", ""].map((look) => {
            const line = document.createElementNS(NAMESPACE, "path");
            line.setAttribute("class", look);
            drawing.append(line);
            return line;
        });
        this.#words = document.createElement("p");
        this.#words.className = "glass view-hint";
        this.#element.append(drawing, this.#words);
        view.append(this.#element);
    }

    show(lines: readonly (readonly Spot[])[], at: Spot, words: string): void {
        const path = lines.map((spots) => `M${spots.map(({ x, y }) => `${x},${y}`).join("L")}`);
        for (const line of this.#lines) {
            line.setAttribute("d", path.join(""));
        }
        this.#words.textContent = words;
        this.#element.style.setProperty("--x", `${at.x}px`);
        this.#element.style.setProperty("--y", `${at.y}px`);
        this.#element.hidden = false;
    }

    hide(): void {
        this.#element.hidden = true;
    }

    end(): void {
        this.#element.remove();
    }
}

/* A stem along the normal, and a ring around its foot. */
function ringOn({ at, normal }: Ground, radius: number): readonly (readonly Vector[])[] {
    const aside: Vector = Math.abs(normal[0]) < 0.8 ? [1, 0, 0] : [0, 0, 1];
    const u = normalize(cross(normal, aside));
    const v = cross(normal, u);
    const around = Array.from({ length: CORNERS + 1 }, (_, i) => {
        const angle = (2 * Math.PI * i) / CORNERS;
        const [x, y] = [radius * Math.cos(angle), radius * Math.sin(angle)];
        return add(at, add(scale(u, x), scale(v, y)));
    });
    return [[at, add(at, scale(normal, radius))], around];
}

const isPlaced = ({ transform }: JsonObject): boolean =>
    isObject(transform) && transform.translation !== undefined;

/* --- carrying --- */

const isSame = (a: Spot, b: Spot): boolean => a.x === b.x && a.y === b.y;

class Carrying {
    readonly #editor: Editor;
    readonly #picture: Element;
    readonly #mark: Mark;
    readonly #listening = new AbortController();
    readonly #onEnd: (outcome: Outcome | null) => void;
    /* An entry of the library is read meanwhile. */
    readonly #carried: Promise<Carried>;
    #shown: { readonly spot: Spot; readonly outcome: Outcome | null } | null = null;
    /* Where the pointer is; null: not over the picture. */
    #last: Spot | null = null;
    #asking = false;

    constructor(
        editor: Editor,
        picture: Element,
        carried: Promise<Carried>,
        onEnd: (outcome: Outcome | null) => void,
    ) {
        this.#editor = editor;
        this.#picture = picture;
        this.#onEnd = onEnd;
        this.#mark = new Mark(picture.parentElement ?? picture);
        this.#mark.hide();
        this.#carried = carried;
        carried.catch(() => this.#end(null));
        const options = { signal: this.#listening.signal, capture: true };
        window.addEventListener("dragover", (event) => this.#over(event), options);
        window.addEventListener("drop", (event) => void this.#drop(event), options);
        window.addEventListener("dragend", () => this.#end(null), options);
        document.documentElement.setAttribute("data-carrying", "");
    }

    /* Null: the pointer is elsewhere. */
    #spotOf({ clientX, clientY }: DragEvent): Spot | null {
        const { left, top, width, height } = this.#picture.getBoundingClientRect();
        const [x, y] = [clientX - left, clientY - top];
        return x >= 0 && y >= 0 && x < width && y < height ? { x, y } : null;
    }

    #over(event: DragEvent): void {
        const spot = this.#spotOf(event);
        if (spot === null) {
            this.#hide();
            return;
        }
        event.preventDefault();
        if (!this.#last || !isSame(this.#last, spot)) {
            this.#last = spot;
            void this.#look();
        }
    }

    /* One question at a time: of those in a row the server answers the newest alone. */
    async #look(): Promise<void> {
        if (this.#asking) {
            return;
        }
        this.#asking = true;
        for (let spot = this.#last; spot; spot = this.#next(spot)) {
            const seen = await this.#ask(spot);
            if (seen !== null && this.#last !== null) {
                this.#show(spot, seen);
            }
        }
        this.#asking = false;
    }

    /* Null: there was no answer. */
    async #ask(spot: Spot): Promise<Seen | null> {
        const picking = this.#editor.link.pick(spot.x, spot.y);
        const answers = await Promise.all([picking, this.#carried]).catch(() => null);
        const { document, schema } = this.#editor.stores.document.getState();
        if (answers === null || document === null) {
            return null;
        }
        const [picked, carried] = answers;
        const landing = this.#landingOf(spot, picked);
        return { landing, outcome: landing && carried(document, schema, landing) };
    }

    #next(asked: Spot): Spot | null {
        return this.#last && !isSame(this.#last, asked) ? this.#last : null;
    }

    #hide(): void {
        this.#last = null;
        this.#shown = null;
        this.#mark.hide();
        this.#editor.stores.view.setState({ hovered: null, trial: null });
    }

    #landingOf(spot: Spot, picked: PickedMessage): Landing | null {
        const { document, schema } = this.#editor.stores.document.getState();
        const { selection } = this.#editor.stores.view.getState();
        const camera = shownCamera(this.#editor.stores);
        if (!document || !camera) {
            return null;
        }
        const { clientWidth: width, clientHeight: height } = this.#picture;
        const ground: Ground =
            picked.position && picked.normal
                ? { at: vectorOf(picked.position), normal: vectorOf(picked.normal) }
                : { at: pointUnder(camera, { ...spot, width, height }), normal: [0, 1, 0] };
        return {
            seen: picked.node,
            selection: landingBeside(document, schema, selection, picked.node),
            ground,
        };
    }

    #show(spot: Spot, { landing, outcome }: Seen): void {
        this.#shown = { spot, outcome };
        if (!landing || !outcome) {
            this.#mark.hide();
            return;
        }
        const { edit, words } = outcome;
        this.#mark.show(this.#pathOf(landing, edit), spot, words);
        this.#editor.stores.view.setState({
            hovered: landing.selection[0] ?? null,
            trial: { ops: edit.ops, name: edit.label, words: "" },
        });
    }

    /* What goes around others, or is none, has no ring. */
    #pathOf({ ground }: Landing, edit: Edit): readonly (readonly Spot[])[] {
        const camera = shownCamera(this.#editor.stores);
        if (!camera || !edit.ops.some((op) => op.op === "insert" && isPlaced(op.value))) {
            return [];
        }
        const { clientWidth: width, clientHeight: height } = this.#picture;
        const projection = projectionOf(camera, { width, height });
        const radius = RADIUS * projection.unitsAt(ground.at);
        return ringOn(ground, radius).map((line) =>
            line.flatMap((point) => projection.spotOf(point) ?? []),
        );
    }

    async #drop(event: DragEvent): Promise<void> {
        const spot = this.#spotOf(event);
        if (spot === null) {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
        this.#listening.abort();
        const known = this.#shown;
        if (known !== null && isSame(known.spot, spot)) {
            this.#end(known.outcome);
            return;
        }
        const seen = await this.#ask(spot);
        this.#end(seen?.outcome ?? null);
    }

    #end(outcome: Outcome | null): void {
        this.#listening.abort();
        this.#hide();
        this.#mark.end();
        document.documentElement.removeAttribute("data-carrying");
        this.#onEnd(outcome);
    }
}

function carry(
    editor: Editor,
    { dataTransfer, currentTarget }: ReactDragEvent,
    carried: Promise<Carried>,
    onLanded: () => void,
): void {
    const picture = document.querySelector(".view-picture");
    if (picture === null) {
        return;
    }
    /* Without data some browsers drag nothing. */
    dataTransfer.setData("application/x-fieldcast-addition", "1");
    dataTransfer.effectAllowed = "copy";
    const tile = currentTarget.querySelector("img, svg");
    if (tile) {
        dataTransfer.setDragImage(tile, -16, -16);
    }
    /* The browser draws what is dragged from the palette, which is to be seen until then. */
    setTimeout(
        () =>
            new Carrying(editor, picture, carried, (outcome) => {
                if (outcome !== null && perform(editor, outcome.edit)) {
                    editor.stores.view.setState({ popup: null });
                    onLanded();
                }
            }),
    );
}

export function carryOffer(editor: Editor, event: ReactDragEvent, offer: Offer): void {
    if (offer.entry) {
        carryEntry(editor, event, offer.entry);
        return;
    }
    const carried = Promise.resolve(carriedOffer(editor, offer));
    carry(editor, event, carried, () => remember(editor, offer.type));
}

export function carryEntry(editor: Editor, event: ReactDragEvent, entry: EntryRow): void {
    carry(editor, event, carriedEntry(editor, entry), () => undefined);
}
