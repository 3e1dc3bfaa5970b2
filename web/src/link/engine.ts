/* SPDX-License-Identifier: MIT */
/* The stream side of a live scene: socket, reconnecting, views, frames from bytes to the screen.
 * Runs in the worker, or in the page where a canvas cannot be handed over. Knows no document: it
 * passes messages on and is told where the page stands. */
import { type Camera, DEFAULT_CAMERA, equalCamera, readCamera } from "../model/camera.ts";
import type { Guide } from "../model/guide.ts";
import type { OutgoingEdit } from "../model/session.ts";
import type { FrameInfo, FrameState, Statistics } from "../model/stores.ts";
import { nearCamera } from "../model/warp.ts";
import { type Decoded, decode, type Frame, FrameAssembler } from "./decode.ts";
import { Chains } from "./deltas.ts";
import { depthsOfGuide } from "./depths.ts";
import { decodeGuide } from "./guide.ts";
import { Meter } from "./meter.ts";
import { Presenter, type Surface } from "./present.ts";
import {
    type BoundsMessage,
    type ClientMessage,
    type FrameHeader,
    frameState,
    type PickMessage,
    type RetryMessage,
    readMessage,
    readPacket,
    readTiles,
    type ServerMessage,
    type ThumbnailsMessage,
    type Tile,
    type ViewMessage,
} from "./protocol.ts";
import type { Moved } from "./warp.ts";

export type ViewState = Omit<ViewMessage, "type" | "seq">;
export type WantedTiles = Omit<ThumbnailsMessage, "type">;

/* From the page. */
export type Order =
    | {
          readonly kind: "open";
          readonly url: string;
          readonly protocols: readonly string[];
          readonly client: string;
          /* Null until the server tells one. */
          readonly key: string | null;
          readonly name: string;
      }
    | { readonly kind: "close" }
    | { readonly kind: "retry" }
    /* The page's document does not fit: connect anew and ask for all of it. */
    | { readonly kind: "resync" }
    /* What the page holds, to resume there. */
    | { readonly kind: "at"; readonly revision: number; readonly epoch: string | number }
    | { readonly kind: "send"; readonly message: BoundsMessage | OutgoingEdit | RetryMessage }
    | ({ readonly kind: "pick" } & Omit<PickMessage, "type" | "seq">)
    /* `camera`: also where it is the document's, which a view leaves out. */
    | { readonly kind: "view"; readonly view: ViewState; readonly camera: Camera }
    | { readonly kind: "thumbnails"; readonly wanted: WantedTiles }
    | { readonly kind: "surface"; readonly surface: Surface | null };

/* To the page. */
export type Report =
    | {
          readonly kind: "state";
          readonly state: "connecting" | "live" | "offline" | "refused";
          readonly reason: string;
          /* Milliseconds to the next attempt. */
          readonly retryIn: number | null;
          /* Attempts since the last that succeeded. */
          readonly attempts: number;
      }
    | { readonly kind: "message"; readonly message: ServerMessage }
    | { readonly kind: "frame"; readonly frame: FrameInfo }
    | { readonly kind: "guide"; readonly guide: Guide }
    | { readonly kind: "thumbnails"; readonly tiles: readonly Tile[] }
    | { readonly kind: "statistics"; readonly statistics: Statistics };

const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 10_000;
const STATISTICS_MS = 500;
/* Hidden pages get no animation frames; what must happen then waits this long. */
const LATEST_MS = 200;
/* Of less delay than this nobody is aware, and a warped picture is none of the server's. */
const WARP_LATENCY_MS = 40;

/* At the next animation frame, or soon where there are none. */
function soon(callback: () => void): void {
    const animated = typeof requestAnimationFrame === "function";
    let frame = 0;
    const timer = setTimeout(
        () => {
            if (animated) {
                cancelAnimationFrame(frame);
            }
            callback();
        },
        animated ? LATEST_MS : 16,
    );
    if (animated) {
        frame = requestAnimationFrame(() => {
            clearTimeout(timer);
            callback();
        });
    }
}

export function frameInfo(
    header: FrameHeader,
    outdated = false,
    camera: Camera | null = null,
): FrameInfo {
    return {
        state: frameState(header),
        stale: header.stale,
        outdated,
        number: header.number,
        input: header.input,
        revision: header.revision,
        width: header.width,
        height: header.height,
        scale: header.width / Math.max(1, header.viewWidth),
        round: header.round,
        rounds: header.rounds,
        camera,
    };
}

const QUALITIES: readonly FrameState[] = ["moving", "still", "lossless"];

/* The same picture as the one shown, in lower quality: as while a newer state is compiled. */
export function isWorse(next: FrameHeader, shown: FrameHeader): boolean {
    const rank = (header: FrameHeader): number => QUALITIES.indexOf(frameState(header));
    return (
        next.revision === shown.revision &&
        next.input === shown.input &&
        next.viewWidth === shown.viewWidth &&
        next.viewHeight === shown.viewHeight &&
        rank(next) < rank(shown)
    );
}

/* What of a view changes the picture itself, not only how fast it comes. */
function looksOf({ quality: _quality, visible: _visible, ...looks }: ViewState): string {
    return JSON.stringify(looks);
}

function askedBy(view: ViewState, seen: Camera): Asked {
    const { camera, ...other } = view;
    return {
        looks: looksOf(view),
        subject: looksOf(other),
        camera: camera ? readCamera(camera) : null,
        seen,
    };
}

/* Only light may be stretched, and only a perspective has one eye. */
function mayMove(view: ViewState, camera: Camera): boolean {
    return view.aov === "color" && camera.height === null;
}

/* Wait before attempt `attempts` + 1: doubling, with jitter so that many pages do not come back
 * in one moment. `random` is in [0, 1). */
export function retryDelay(attempts: number, random: number): number {
    const full = Math.min(LONGEST_RETRY_MS, FIRST_RETRY_MS * 2 ** Math.min(attempts, 16));
    return full * (0.5 + 0.5 * random);
}

/* A view that was asked for: what of it changes the picture, and its camera. */
interface Asked {
    readonly looks: string;
    /* The same without the camera. */
    readonly subject: string;
    /* Null: the document's. */
    readonly camera: Camera | null;
    /* Either. */
    readonly seen: Camera;
}

/* How far the pixels of a picture are. */
interface Known {
    readonly input: number;
    readonly revision: number;
    readonly depths: Moved["depths"];
}

type Open = Extract<Order, { kind: "open" }>;

export class Engine {
    readonly #report: (report: Report) => void;
    readonly #assembler = new FrameAssembler();
    readonly #chains = new Chains();
    /* Until one of them cannot be put together. */
    #deltas = Chains.areThere();
    readonly #presenter = new Presenter();
    readonly #meter = new Meter();
    #target: Open | null = null;
    #key: string | null = null;
    #socket: WebSocket | null = null;
    #attempts = 0;
    #retry: ReturnType<typeof setTimeout> | null = null;
    #bye: { reason: string; retryMs: number | null } | null = null;
    #at: { revision: number; epoch: string | number } | null = null;
    #view: ViewState | null = null;
    /* What the page looks from. */
    #camera: Camera = DEFAULT_CAMERA;
    #wanted: WantedTiles | null = null;
    #viewDue = false;
    #seq = 0;
    #sent = "";
    /* What was asked for, by `seq`, from the picture on screen on. */
    #asked = new Map<number, Asked>();
    #told: FrameInfo | null = null;
    #shown: FrameHeader | null = null;
    #known: Known | null = null;
    /* What the picture on screen is warped by. */
    #moved: Moved | null = null;
    #waiting: (Decoded & { frame: Frame; decodedAt: number }) | null = null;
    #ticking: ReturnType<typeof setInterval> | null = null;

    constructor(report: (report: Report) => void) {
        this.#report = report;
    }

    take(order: Order): void {
        switch (order.kind) {
            case "open":
                this.#leave();
                this.#target = order;
                this.#key = order.key;
                this.#at = null;
                this.#attempts = 0;
                this.#presenter.clear();
                this.#connect();
                break;
            case "close":
                this.#leave();
                this.#target = null;
                this.#presenter.clear();
                break;
            case "retry":
                if (this.#socket === null) {
                    this.#connect();
                }
                break;
            case "resync":
                this.#at = null;
                this.#leave();
                this.#lost("");
                break;
            case "at":
                this.#at = { revision: order.revision, epoch: order.epoch };
                break;
            case "send":
                this.#send(order.message);
                break;
            case "pick":
                this.#pick(order);
                break;
            case "view":
                this.#setView(order.view, order.camera);
                break;
            case "thumbnails":
                this.#wanted = order.wanted;
                this.#sendWanted();
                break;
            case "surface":
                this.#presenter.setSurface(order.surface);
                break;
        }
    }

    /* --- connection --- */

    #state(state: "connecting" | "live" | "offline" | "refused", reason = "", retryIn?: number) {
        this.#report({
            kind: "state",
            state,
            reason,
            retryIn: retryIn ?? null,
            attempts: this.#attempts,
        });
    }

    #connect(): void {
        const target = this.#target;
        if (!target) {
            return;
        }
        this.#stopRetry();
        /* While it tries again it is as offline as before. */
        if (this.#attempts === 0) {
            this.#state("connecting");
        }
        const socket = new WebSocket(target.url, [...target.protocols]);
        socket.binaryType = "arraybuffer";
        socket.onopen = () => this.#greet(target);
        socket.onmessage = ({ data }) => {
            if (this.#socket !== socket) {
                return;
            }
            if (typeof data === "string") {
                this.#text(data);
            } else {
                this.#binary(data as ArrayBuffer);
            }
        };
        socket.onclose = ({ reason }) => {
            if (this.#socket === socket) {
                this.#socket = null;
                this.#lost(reason);
            }
        };
        this.#bye = null;
        this.#socket = socket;
    }

    #greet({ client, name }: Open): void {
        this.#send({
            type: "hello",
            client,
            ...(this.#key === null ? {} : { key: this.#key }),
            ...(name ? { name } : {}),
            ...(this.#at ? { revision: this.#at.revision, epoch: this.#at.epoch } : {}),
        });
        this.#sent = "";
        this.#sendView();
        this.#sendWanted();
    }

    #lost(reason: string): void {
        this.#dropWaiting();
        this.#assembler.reset();
        this.#chains.clear();
        this.#shown = null;
        this.#known = null;
        this.#moved = null;
        this.#meter.reset();
        if (this.#bye && this.#bye.retryMs === null) {
            this.#state("refused", this.#bye.reason);
            return;
        }
        const wait = this.#bye?.retryMs ?? 0;
        const delay = Math.max(wait, retryDelay(this.#attempts, Math.random()));
        this.#attempts++;
        this.#state("offline", this.#bye?.reason ?? reason, delay);
        this.#retry = setTimeout(() => this.#connect(), delay);
    }

    #stopRetry(): void {
        if (this.#retry !== null) {
            clearTimeout(this.#retry);
            this.#retry = null;
        }
    }

    /* Lets the socket go without trying again. */
    #leave(): void {
        const socket = this.#socket;
        this.#socket = null;
        socket?.close(1000);
        this.#stopRetry();
        this.#dropWaiting();
        this.#assembler.reset();
        this.#chains.clear();
        this.#shown = null;
        this.#known = null;
        this.#moved = null;
        this.#meter.reset();
    }

    #send(message: ClientMessage): void {
        if (this.#socket?.readyState === WebSocket.OPEN) {
            this.#socket.send(JSON.stringify(message));
        }
    }

    #text(text: string): void {
        const message = readMessage(text);
        if (!message) {
            return;
        }
        if (message.type === "welcome") {
            this.#attempts = 0;
            this.#key = message.key;
            this.#state("live");
        } else if (message.type === "bye") {
            this.#bye = { reason: message.reason, retryMs: message.retry_ms ?? null };
        }
        this.#report({ kind: "message", message });
    }

    /* --- view and pick --- */

    #setView(view: ViewState, camera: Camera): void {
        if (view.width !== this.#view?.width || view.height !== this.#view.height) {
            this.#presenter.resize(view.width, view.height);
        }
        this.#view = view;
        this.#camera = camera;
        if (!this.#viewDue) {
            this.#viewDue = true;
            soon(() => {
                this.#viewDue = false;
                this.#sendView();
                this.#follow();
            });
        }
    }

    #sendView(): void {
        const text = JSON.stringify(this.#view);
        const asked = this.#asked.get(this.#seq);
        if (asked && text === this.#sent) {
            this.#asked.set(this.#seq, { ...asked, seen: this.#camera });
        }
        if (!this.#view || text === this.#sent || this.#socket?.readyState !== WebSocket.OPEN) {
            return;
        }
        this.#sent = text;
        this.#seq++;
        const depths = this.#warps() ? { depths: true } : {};
        const deltas = this.#deltas ? { deltas: true } : {};
        this.#send({ type: "view", seq: this.#seq, ...this.#view, ...depths, ...deltas });
        this.#ask(askedBy(this.#view, this.#camera));
        this.#meter.viewSent(this.#seq, performance.now());
    }

    #sendWanted(): void {
        if (this.#wanted) {
            this.#send({ type: "thumbnails", ...this.#wanted });
        }
    }

    /* The picture on screen may be none of what is looked at now. */
    #ask(asked: Asked): void {
        this.#asked.set(this.#seq, asked);
        const outdated = this.#isOutdated();
        if (this.#shown !== null && this.#told !== null && outdated !== this.#told.outdated) {
            this.#tell({ ...this.#told, outdated });
        }
    }

    #tell(frame: FrameInfo): void {
        this.#told = frame;
        this.#report({ kind: "frame", frame });
    }

    /* --- warp --- */

    #warps(): boolean {
        const latency = this.#meter.latency();
        return (
            latency !== null &&
            latency >= WARP_LATENCY_MS &&
            this.#view !== null &&
            mayMove(this.#view, this.#camera) &&
            this.#presenter.canMove()
        );
    }

    /* From the camera of the picture on screen to the page's; null: as it is. */
    #wayOf(header: FrameHeader): Moved | null {
        const [asked, view, known] = [this.#asked.get(header.input), this.#view, this.#known];
        if (
            !asked ||
            !view ||
            known?.input !== header.input ||
            known.revision !== header.revision ||
            asked.subject !== askedBy(view, this.#camera).subject ||
            asked.seen.height !== null ||
            equalCamera(asked.seen, this.#camera) ||
            !this.#warps()
        ) {
            return null;
        }
        const camera = nearCamera(asked.seen, this.#camera);
        return {
            depths: known.depths,
            from: { camera: asked.seen, aspect: header.width / header.height },
            to: { camera, aspect: view.width / view.height },
        };
    }

    /* The picture on screen goes along with the camera. */
    #follow(): void {
        const header = this.#shown;
        const moved = header && this.#wayOf(header);
        if (header && (moved || this.#moved)) {
            this.#moved = moved;
            this.#presenter.move(moved);
            this.#tell(this.#infoOf(header));
        }
    }

    #isOutdated(): boolean {
        const shown = this.#asked.get(this.#shown?.input ?? -1);
        return shown !== undefined && shown.looks !== this.#asked.get(this.#seq)?.looks;
    }

    #infoOf(header: FrameHeader): FrameInfo {
        const camera = this.#moved?.to.camera ?? this.#asked.get(header.input)?.camera ?? null;
        return frameInfo(header, this.#isOutdated(), camera);
    }

    #forgetAsked(): void {
        for (const seq of this.#asked.keys()) {
            if (seq < (this.#shown?.input ?? 0)) {
                this.#asked.delete(seq);
            }
        }
    }

    /* What is meant is what was seen: the view of the frame on screen, or what it is warped to. */
    #pick(order: Extract<Order, { kind: "pick" }>): void {
        const { pick, x, y, through } = order;
        const seq = (this.#moved === null ? this.#shown?.input : undefined) ?? this.#seq;
        this.#send({ type: "pick", pick, x, y, seq, ...(through ? { through } : {}) });
    }

    /* --- frames --- */

    #binary(data: ArrayBuffer): void {
        const message = readTiles(data);
        if (message) {
            this.#report({ kind: "thumbnails", tiles: message.tiles });
            this.#send({ type: "ack_thumbnails", number: message.number });
            return;
        }
        const packet = readPacket(data);
        const frame = packet && this.#assembler.push(packet, performance.now());
        if (!frame) {
            return;
        }
        const socket = this.#socket;
        if (frame.header.codec === "guide") {
            void this.#guide(frame, socket);
            return;
        }
        decode(frame, this.#chains).then(
            (decoded) => this.#decoded(frame, decoded, socket),
            () => {
                /* A damaged picture is skipped; without its acknowledgement the stream would stop. */
                this.#meter.frameDropped();
                this.#acknowledge(frame.header.number, socket);
                if (frame.header.delta && socket === this.#socket) {
                    this.#askForWholes();
                }
            },
        );
    }

    #askForWholes(): void {
        this.#deltas = false;
        this.#sent = "";
        this.#sendView();
    }

    /* A damaged one is skipped. */
    async #guide(frame: Frame, socket: WebSocket | null): Promise<void> {
        const guide = await decodeGuide(frame).catch(() => null);
        this.#acknowledge(frame.header.number, socket);
        if (guide !== null && socket === this.#socket) {
            this.#report({ kind: "guide", guide });
            const { input, revision } = guide;
            if (input === this.#shown?.input && revision === this.#shown.revision) {
                this.#known = { input, revision, depths: depthsOfGuide(guide) };
            }
        }
    }

    #acknowledge(frame: number, socket: WebSocket | null): void {
        if (socket === this.#socket) {
            this.#send({ type: "ack", frame });
        }
    }

    #decoded(frame: Frame, decoded: Decoded, socket: WebSocket | null): void {
        const { bitmap } = decoded;
        const { number } = frame.header;
        const newest = this.#waiting?.frame.header.number ?? this.#shown?.number ?? 0;
        if (socket !== this.#socket || number <= newest) {
            bitmap.close();
            this.#meter.frameDropped();
            this.#acknowledge(number, socket);
            return;
        }
        const shown = this.#waiting?.frame.header ?? this.#shown;
        if (shown !== null && isWorse(frame.header, shown)) {
            bitmap.close();
            this.#acknowledge(number, socket);
            this.#tell({ ...this.#infoOf(shown), stale: frame.header.stale });
            return;
        }
        const scheduled = this.#waiting !== null;
        if (this.#waiting) {
            this.#waiting.bitmap.close();
            this.#meter.frameDropped();
            this.#acknowledge(this.#waiting.frame.header.number, socket);
        }
        this.#waiting = { ...decoded, frame, decodedAt: performance.now() };
        if (!scheduled) {
            soon(() => this.#present());
        }
    }

    #present(): void {
        const waiting = this.#waiting;
        if (!waiting) {
            return;
        }
        this.#waiting = null;
        const { frame, bitmap, depths, decodedAt } = waiting;
        const { header } = frame;
        if (depths) {
            this.#known = { input: header.input, revision: header.revision, depths };
        }
        this.#moved = this.#wayOf(header);
        this.#presenter.show(bitmap, header, this.#moved);
        this.#shown = header;
        this.#acknowledge(header.number, this.#socket);
        this.#meter.frameShown(frame, decodedAt, performance.now());
        this.#forgetAsked();
        this.#tell(this.#infoOf(header));
        this.#tick();
    }

    #dropWaiting(): void {
        this.#waiting?.bitmap.close();
        this.#waiting = null;
    }

    /* Statistics while frames come, and once more when they have stopped. */
    #tick(): void {
        this.#ticking ??= setInterval(() => {
            const statistics = this.#meter.read(performance.now());
            this.#report({ kind: "statistics", statistics });
            if (statistics.fps === 0 && this.#ticking !== null) {
                clearInterval(this.#ticking);
                this.#ticking = null;
            }
        }, STATISTICS_MS);
    }
}
