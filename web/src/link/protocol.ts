/* SPDX-License-Identifier: MIT */
/* Everything that page and server say to each other on a live connection, and the binary header of
 * frames. Mirrors protocol/README.md, whose examples run against this file. */
import { isObject, type Json, type JsonObject } from "../model/json.ts";
import type { RefusalReason } from "../model/operation.ts";
import type { OutgoingEdit, SessionMessage } from "../model/session.ts";
import type { FrameState, Level, RendererInfo } from "../model/stores.ts";
import type { Quality } from "../model/view.ts";

export const SUBPROTOCOL = "fieldcast.v1";
export const TOKEN_PREFIX = "fieldcast.token.";

/* --- client to server --- */

export interface HelloMessage {
    readonly type: "hello";
    readonly client: string;
    /* What the client was told by `welcome`. */
    readonly key?: string;
    readonly name?: string;
    readonly revision?: number;
    readonly epoch?: string | number;
}

export interface ViewMessage {
    readonly type: "view";
    readonly seq: number;
    /* Device pixels. */
    readonly width: number;
    readonly height: number;
    readonly camera?: JsonObject;
    readonly aov: string;
    readonly quality: Quality;
    readonly visible: boolean;
    readonly guides: boolean;
    /* Absent: false. */
    readonly depths?: boolean;
    /* Pictures may come as what differs from earlier ones. */
    readonly deltas?: boolean;
    /* Ids of the nodes that are shown alone; absent: all are. */
    readonly isolate?: readonly string[];
    /* The plane that cuts the pictures and picks; absent: none. */
    readonly section?: JsonObject;
}

export interface PickMessage {
    readonly type: "pick";
    readonly pick: number;
    readonly x: number;
    readonly y: number;
    readonly seq: number;
    /* Lists what is behind it too. */
    readonly through?: boolean;
}

export interface BoundsMessage {
    readonly type: "bounds";
    readonly bounds: number;
    /* Ids; none: all of the scene. */
    readonly nodes: readonly string[];
}

export interface AckMessage {
    readonly type: "ack";
    readonly frame: number;
}

export interface RetryMessage {
    readonly type: "retry";
    readonly place?: string;
}

/* What this client shows thumbnails of; only the newest counts. */
export interface ThumbnailsMessage {
    readonly type: "thumbnails";
    /* Device pixels of a small one. */
    readonly width: number;
    readonly nodes: readonly string[];
    /* Ids of nodes, 8/3 as wide. */
    readonly large: readonly string[];
    readonly materials: readonly string[];
}

export interface AckThumbnailsMessage {
    readonly type: "ack_thumbnails";
    readonly number: number;
}

export type ClientMessage =
    | HelloMessage
    | ViewMessage
    | OutgoingEdit
    | PickMessage
    | BoundsMessage
    | AckMessage
    | ThumbnailsMessage
    | AckThumbnailsMessage
    | RetryMessage;

/* --- server to client --- */

export interface WelcomeExtra {
    readonly session: string | number;
    readonly scene: string;
    /* What others are told of who this client is. */
    readonly author: string;
    /* Only this client is told: it shows it with its next hello. */
    readonly key: string;
    readonly renderer: RendererInfo;
    readonly limits?: JsonObject;
}

export interface PickedMessage {
    readonly type: "picked";
    readonly pick: number;
    readonly revision: number;
    readonly node: string | null;
    readonly position: readonly number[] | null;
    readonly normal: readonly number[] | null;
    readonly distance: number | null;
    /* Where it was asked for: shapes whose surfaces the ray passes, the nearest first. */
    readonly through?: readonly string[];
}

export interface BoundedMessage {
    readonly type: "bounded";
    readonly bounds: number;
    readonly revision: number;
    /* Null: nothing is to be seen, or nothing of it has an end. */
    readonly low: readonly number[] | null;
    readonly high: readonly number[] | null;
}

export interface CompilingMessage {
    readonly type: "compiling";
    readonly revision: number;
    readonly over: boolean;
    readonly elapsed_ms: number;
    readonly expected_ms?: number;
}

export interface NoticeMessage {
    readonly type: "notice";
    readonly level: Level;
    readonly code: string;
    readonly message: string;
    readonly place?: string;
    /* In the text at `place`, from 1. */
    readonly line?: number;
    readonly column?: number;
    /* Milliseconds of processor time: what was too slow took more, and might take. */
    readonly measured?: number;
    readonly limit?: number;
    /* Why a scene is left out. */
    readonly reason?: RefusalReason;
}

export interface ByeMessage {
    readonly type: "bye";
    readonly reason: string;
    /* Absent: do not come back. */
    readonly retry_ms?: number;
}

export type ServerMessage =
    | (Extract<SessionMessage, { type: "welcome" }> & WelcomeExtra)
    | Exclude<SessionMessage, { type: "welcome" }>
    | PickedMessage
    | BoundedMessage
    | CompilingMessage
    | NoticeMessage
    | ByeMessage;

const SERVER_TYPES = {
    welcome: true,
    document: true,
    applied: true,
    changed: true,
    rejected: true,
    picked: true,
    bounded: true,
    compiling: true,
    notice: true,
    bye: true,
} satisfies Record<ServerMessage["type"], true>;

/* One text frame of the server; null for what this client does not know. */
export function readMessage(text: string): ServerMessage | null {
    let json: Json;
    try {
        json = JSON.parse(text) as Json;
    } catch {
        return null;
    }
    return isObject(json) && typeof json.type === "string" && Object.hasOwn(SERVER_TYPES, json.type)
        ? (json as unknown as ServerMessage)
        : null;
}

/* --- frames --- */

/* What stands before the times of the stages, four bytes each. */
export const FRAME_FIXED_BYTES = 40;
export const FRAME_PART_HEADER_BYTES = 8;

export type Codec = "jpeg" | "png" | "guide";
const CODECS: readonly (Codec | undefined)[] = [
    undefined,
    "jpeg",
    "png",
    undefined,
    undefined,
    "guide",
];

const FLAG_KEY = 1;
const FLAG_STILL = 2;
const FLAG_LOSSLESS = 4;
const FLAG_STALE = 8;
const FLAG_DEPTHS = 16;
const FLAG_DELTA = 32;

export interface FrameHeader {
    readonly codec: Codec;
    readonly key: boolean;
    readonly still: boolean;
    readonly lossless: boolean;
    readonly stale: boolean;
    /* They stand behind the bytes of the picture. */
    readonly depths: boolean;
    /* It is what differs from the last picture of its chain. */
    readonly delta: boolean;
    readonly number: number;
    /* Of the whole frame, over all its parts. */
    readonly payloadBytes: number;
    readonly revision: number;
    /* `seq` of the view shown. */
    readonly input: number;
    readonly width: number;
    readonly height: number;
    readonly viewWidth: number;
    readonly viewHeight: number;
    /* Of samples: which one it is, from 1, of how many. */
    readonly round: number;
    readonly rounds: number;
    /* Of pictures that are kept for what differs from them; 0: of none. */
    readonly chain: number;
    /* Counts these differences since the last whole picture, modulo 256. */
    readonly link: number;
    /* Microseconds, in the order of the schema's stages. */
    readonly stages: readonly number[];
}

const FRAME_VERSION = 3;

function headerBytes(stages: number): number {
    return FRAME_FIXED_BYTES + 4 * stages;
}

/* The strongest that its flags say. */
export function frameState(header: FrameHeader): Exclude<FrameState, "none"> {
    return header.lossless ? "lossless" : header.still ? "still" : "moving";
}

/* "FCF1" and "FCFP", read little-endian. */
const MAGIC_FRAME = 0x31464346;
const MAGIC_PART = 0x50464346;

export type Packet =
    | {
          readonly kind: "head";
          readonly header: FrameHeader;
          readonly payload: Uint8Array<ArrayBuffer>;
      }
    | {
          readonly kind: "part";
          readonly number: number;
          readonly payload: Uint8Array<ArrayBuffer>;
      };

function readHeader(view: DataView): FrameHeader | null {
    if (view.byteLength < FRAME_FIXED_BYTES) {
        return null;
    }
    const codec = CODECS[view.getUint8(5)];
    const stages = view.getUint8(7);
    const bytes = headerBytes(stages);
    if (view.getUint8(4) !== FRAME_VERSION || !codec || view.byteLength < bytes) {
        return null;
    }
    const flags = view.getUint8(6);
    return {
        codec,
        key: (flags & FLAG_KEY) !== 0,
        still: (flags & FLAG_STILL) !== 0,
        lossless: (flags & FLAG_LOSSLESS) !== 0,
        stale: (flags & FLAG_STALE) !== 0,
        depths: (flags & FLAG_DEPTHS) !== 0,
        delta: (flags & FLAG_DELTA) !== 0,
        number: view.getUint32(8, true),
        payloadBytes: view.getUint32(12, true),
        revision: Number(view.getBigUint64(16, true)),
        input: view.getUint32(24, true),
        width: view.getUint16(28, true),
        height: view.getUint16(30, true),
        viewWidth: view.getUint16(32, true),
        viewHeight: view.getUint16(34, true),
        round: view.getUint8(36),
        rounds: view.getUint8(37),
        chain: view.getUint8(38),
        link: view.getUint8(39),
        stages: Array.from({ length: stages }, (_, i) =>
            view.getUint32(FRAME_FIXED_BYTES + 4 * i, true),
        ),
    };
}

/* One binary message; null for what is none of ours. */
export function readPacket(data: ArrayBuffer): Packet | null {
    if (data.byteLength < FRAME_PART_HEADER_BYTES) {
        return null;
    }
    const view = new DataView(data);
    const magic = view.getUint32(0, true);
    if (magic === MAGIC_PART) {
        return {
            kind: "part",
            number: view.getUint32(4, true),
            payload: new Uint8Array(data, FRAME_PART_HEADER_BYTES),
        };
    }
    const header = magic === MAGIC_FRAME ? readHeader(view) : null;
    return (
        header && {
            kind: "head",
            header,
            payload: new Uint8Array(data, headerBytes(header.stages.length)),
        }
    );
}

/* The first message of a frame, as the server writes it; for tests and recordings. */
export function packFrame(header: FrameHeader, payload: Uint8Array): ArrayBuffer {
    const start = headerBytes(header.stages.length);
    const data = new ArrayBuffer(start + payload.length);
    const view = new DataView(data);
    const flag = (on: boolean, bit: number): number => (on ? bit : 0);
    view.setUint32(0, MAGIC_FRAME, true);
    view.setUint8(4, FRAME_VERSION);
    view.setUint8(5, CODECS.indexOf(header.codec));
    view.setUint8(
        6,
        flag(header.key, FLAG_KEY) |
            flag(header.still, FLAG_STILL) |
            flag(header.lossless, FLAG_LOSSLESS) |
            flag(header.stale, FLAG_STALE) |
            flag(header.depths, FLAG_DEPTHS) |
            flag(header.delta, FLAG_DELTA),
    );
    view.setUint8(7, header.stages.length);
    view.setUint32(8, header.number, true);
    view.setUint32(12, header.payloadBytes, true);
    view.setBigUint64(16, BigInt(header.revision), true);
    view.setUint32(24, header.input, true);
    [header.width, header.height, header.viewWidth, header.viewHeight].forEach((size, i) => {
        view.setUint16(28 + 2 * i, size, true);
    });
    view.setUint8(36, header.round);
    view.setUint8(37, header.rounds);
    view.setUint8(38, header.chain);
    view.setUint8(39, header.link);
    header.stages.forEach((time, i) => {
        view.setUint32(FRAME_FIXED_BYTES + 4 * i, time, true);
    });
    new Uint8Array(data, start).set(payload);
    return data;
}

export function packPart(number: number, payload: Uint8Array): ArrayBuffer {
    const data = new ArrayBuffer(FRAME_PART_HEADER_BYTES + payload.length);
    const view = new DataView(data);
    view.setUint32(0, MAGIC_PART, true);
    view.setUint32(4, number, true);
    new Uint8Array(data, FRAME_PART_HEADER_BYTES).set(payload);
    return data;
}

/* --- thumbnails --- */

export type TileKind = "node" | "material";

export interface Tile {
    readonly kind: TileKind;
    readonly id: string;
    /* Device pixels. */
    readonly width: number;
    readonly height: number;
    /* Null: it cannot be drawn. */
    readonly picture: Blob | null;
}

export interface TileMessage {
    readonly number: number;
    /* Of the scene whose parts look so. */
    readonly revision: number;
    readonly tiles: readonly Tile[];
}

/* "FCT1", read little-endian. */
const MAGIC_THUMBNAILS = 0x31544346;
const THUMBNAILS_VERSION = 1;
const THUMBNAILS_HEADER_BYTES = 24;
const TILE_HEADER_BYTES = 12;
const TILE_KINDS: readonly TileKind[] = ["node", "material"];

function readTile(data: ArrayBuffer, at: number): { tile: Tile; end: number } | null {
    if (at + TILE_HEADER_BYTES > data.byteLength) {
        return null;
    }
    const view = new DataView(data, at);
    const kind = TILE_KINDS[view.getUint8(0)];
    const start = at + TILE_HEADER_BYTES + view.getUint8(1);
    const end = start + view.getUint32(8, true);
    if (!kind || end > data.byteLength) {
        return null;
    }
    const id = new TextDecoder().decode(
        new Uint8Array(data, at + TILE_HEADER_BYTES, start - at - TILE_HEADER_BYTES),
    );
    const picture = end > start ? new Blob([data.slice(start, end)], { type: "image/png" }) : null;
    const [width, height] = [view.getUint16(2, true), view.getUint16(4, true)];
    return { tile: { kind, id, width, height, picture }, end };
}

/* One binary message; null for what is no whole message of thumbnails. */
export function readTiles(data: ArrayBuffer): TileMessage | null {
    const view = new DataView(data);
    if (
        data.byteLength < THUMBNAILS_HEADER_BYTES ||
        view.getUint32(0, true) !== MAGIC_THUMBNAILS ||
        view.getUint8(4) !== THUMBNAILS_VERSION
    ) {
        return null;
    }
    const tiles: Tile[] = [];
    let at = THUMBNAILS_HEADER_BYTES;
    for (let count = view.getUint16(6, true); count > 0; count--) {
        const next = readTile(data, at);
        if (!next) {
            return null;
        }
        tiles.push(next.tile);
        at = next.end;
    }
    return {
        number: view.getUint32(8, true),
        revision: Number(view.getBigUint64(16, true)),
        tiles,
    };
}
