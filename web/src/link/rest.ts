/* SPDX-License-Identifier: MIT */
/* The REST side of the server: scenes, examples, pictures, schema, files. */
import { isObject, type Json, type JsonObject, listOf, numberOf, textOf } from "../model/json.ts";
import type { Operation } from "../model/operation.ts";
import type { Format } from "../model/picture.ts";
import { readSchema, type Schema } from "../model/schema.ts";
import { createLibraryRest, type LibraryRest } from "./libraryRest.ts";

export interface SceneEntry {
    readonly id: string;
    readonly name: string;
    readonly revision: number;
    readonly nodes: number;
    /* As the server writes it: a date text or seconds. */
    readonly modified: string | number;
    readonly viewers: number;
}

export interface ExampleEntry {
    readonly id: string;
    readonly name: string;
    readonly description: string;
    /* What it is there for; the list has each group in one piece. */
    readonly group: string;
}

/* An uploaded picture. */
export interface Asset {
    readonly id: string;
    /* A media type. */
    readonly type: string;
    readonly width: number;
    readonly height: number;
}

/* What a picture asks for; what is absent, the scene says. */
export interface PictureRequest {
    readonly width: number;
    readonly height: number;
    readonly format: Format;
    /* Left, top, width and height in pixels of the whole. */
    readonly region?: readonly [number, number, number, number];
    readonly outputs?: readonly string[];
    readonly level?: string;
    readonly transparent?: boolean;
    readonly camera?: JsonObject;
    readonly section?: JsonObject;
}

export interface Imported {
    readonly id: string;
    /* What was put right while reading. */
    readonly notes: readonly string[];
}

/* A problem+json answer, or a network that did not answer (status 0). */
export class RestError extends Error {
    readonly status: number;
    readonly code: string;
    readonly place: string;
    /* In the text at `place`, from 1; null: not in a text. */
    readonly line: number | null;
    readonly column: number | null;
    constructor(
        status: number,
        code: string,
        place: string,
        message: string,
        line: number | null = null,
        column: number | null = null,
    ) {
        super(message);
        this.name = "RestError";
        this.status = status;
        this.code = code;
        this.place = place;
        this.line = line;
        this.column = column;
    }
}

export interface Rest {
    listScenes(): Promise<readonly SceneEntry[]>;
    /* Each answers the new scene's id. */
    createScene(document: Json): Promise<string>;
    /* Of a text that the server reads itself, so that it can say where it is wrong. */
    createFromText(text: string): Promise<string>;
    /* Of files in the other format, their texts by path; `scene` says which of several. */
    importScene(files: Readonly<Record<string, string>>, scene: string | null): Promise<Imported>;
    createFromExample(example: string): Promise<string>;
    createFromScene(scene: string): Promise<string>;
    deleteScene(id: string): Promise<void>;
    readScene(id: string): Promise<Json>;
    replaceScene(id: string, document: Json): Promise<void>;
    /* Applies operations without opening the scene. */
    editScene(id: string, ops: readonly Operation[]): Promise<void>;
    listExamples(): Promise<readonly ExampleEntry[]>;
    readSchema(): Promise<Schema>;
    listAssets(): Promise<readonly Asset[]>;
    uploadAsset(file: Blob): Promise<Asset>;
    /* Addresses for <img> and links. Of several outputs a ZIP comes. */
    imageUrl(id: string, picture: PictureRequest): string;
    /* The last picture that somebody has seen of a scene. */
    posterUrl(id: string): string;
    assetUrl(id: string): string;
    exampleImageUrl(id: string): string;
    /* A picture of a node type; there may be none. */
    referenceImageUrl(type: string): string;
    /* The file at an address, with the token where there is one. */
    fetchFile(url: string, signal?: AbortSignal): Promise<Blob>;
    /* The same as an object URL, which the caller revokes. */
    fetchImage(url: string): Promise<string>;
    /* A picture of a document that is stored nowhere; the object URL is revoked by the caller. */
    renderImage(document: Json, picture: PictureRequest, signal: AbortSignal): Promise<string>;
    readonly token: string | null;
    readonly library: LibraryRest;
    /* For what is loaded later. */
    readonly request: Request;
}

/* With the token; what is not ok throws a RestError. */
export type Request = (path: string, init?: RequestInit) => Promise<Response>;

async function problemOf(response: Response): Promise<RestError> {
    let json: Json = null;
    try {
        json = (await response.json()) as Json;
    } catch {
        /* A proxy may answer something that is not JSON; the status still tells. */
    }
    const problem = isObject(json) ? json : {};
    const title = textOf(problem.title, `the server answered ${response.status}`);
    return new RestError(
        response.status,
        textOf(problem.code, "unknown"),
        textOf(problem.place),
        textOf(problem.detail, title),
        typeof problem.line === "number" ? problem.line : null,
        typeof problem.column === "number" ? problem.column : null,
    );
}

const segment = encodeURIComponent;

function queryOf(picture: PictureRequest): string {
    const { width, height, region, outputs, level, transparent, ...parts } = picture;
    const query = new URLSearchParams({ width: String(width), height: String(height) });
    if (region) {
        query.set("region", region.join(","));
    }
    if (outputs) {
        query.set("aov", outputs.join(","));
    }
    if (level !== undefined) {
        query.set("level", level);
    }
    if (transparent !== undefined) {
        query.set("transparent", String(transparent));
    }
    for (const part of ["camera", "section"] as const) {
        for (const [name, value] of Object.entries(parts[part] ?? {})) {
            query.set(`${part}.${name}`, String(value));
        }
    }
    return query.toString();
}

function readAsset(json: JsonObject): Asset {
    return {
        id: textOf(json.id),
        type: textOf(json.type),
        width: numberOf(json.width),
        height: numberOf(json.height),
    };
}

/* `base` is the server's address without a slash at the end; "" is the page's own server. */
export function createRest(base: string, token: string | null): Rest {
    const request: Request = async (path, init = {}) => {
        const headers = new Headers(init.headers);
        if (token !== null) {
            headers.set("Authorization", `Bearer ${token}`);
        }
        if (init.body !== undefined && !headers.has("Content-Type")) {
            headers.set("Content-Type", "application/json");
        }
        let response: Response;
        try {
            response = await fetch(base + path, { ...init, headers });
        } catch {
            throw new RestError(0, "unreachable", "", "the server cannot be reached");
        }
        if (!response.ok) {
            throw await problemOf(response);
        }
        return response;
    };
    const get = async (path: string): Promise<Json> => (await (await request(path)).json()) as Json;
    const post = async (path: string, text: string): Promise<Imported> => {
        const response = await request(path, { method: "POST", body: text });
        const location = response.headers.get("Location") ?? "";
        const json = (await response.json()) as Json;
        return {
            id: decodeURIComponent(location.split("/").at(-1) ?? ""),
            notes: listOf(isObject(json) ? json.notes : []).map((note) => textOf(note)),
        };
    };
    const createFromText = async (text: string): Promise<string> =>
        (await post("/v1/scenes", text)).id;
    const create = (body: Json): Promise<string> => createFromText(JSON.stringify(body));
    const list = async (path: string, member: string) => {
        const json = await get(path);
        return listOf(isObject(json) ? json[member] : []).filter(isObject);
    };
    const fetchFile = async (url: string, signal?: AbortSignal): Promise<Blob> => {
        const path = url.startsWith(base) ? url.slice(base.length) : url;
        return (await request(path, signal ? { signal } : {})).blob();
    };
    return {
        token,
        library: createLibraryRest(base, request),
        request,
        listScenes: async () =>
            (await list("/v1/scenes", "scenes")).map((scene) => ({
                id: textOf(scene.id),
                name: textOf(scene.name),
                revision: numberOf(scene.revision),
                nodes: numberOf(scene.nodes),
                modified:
                    typeof scene.modified === "number" ? scene.modified : textOf(scene.modified),
                viewers: numberOf(scene.viewers),
            })),
        createScene: create,
        createFromText,
        importScene: (files, scene) =>
            post("/v1/import", JSON.stringify({ files, ...(scene === null ? {} : { scene }) })),
        createFromExample: (example) => create({ from: `example:${example}` }),
        createFromScene: (scene) => create({ from: `scene:${scene}` }),
        deleteScene: async (id) => {
            await request(`/v1/scenes/${segment(id)}`, { method: "DELETE" });
        },
        readScene: (id) => get(`/v1/scenes/${segment(id)}`),
        replaceScene: async (id, document) => {
            await request(`/v1/scenes/${segment(id)}`, {
                method: "PUT",
                body: JSON.stringify(document),
            });
        },
        editScene: async (id, ops) => {
            await request(`/v1/scenes/${segment(id)}`, {
                method: "PATCH",
                body: JSON.stringify(ops),
            });
        },
        listExamples: async () =>
            (await list("/v1/examples", "examples")).map((example) => ({
                id: textOf(example.id),
                name: textOf(example.name),
                description: textOf(example.description),
                group: textOf(example.group),
            })),
        listAssets: async () => (await list("/v1/assets", "assets")).map(readAsset),
        uploadAsset: async (file) => {
            const headers = { "Content-Type": "application/octet-stream" };
            const response = await request("/v1/assets", { method: "POST", body: file, headers });
            const json = (await response.json()) as Json;
            return readAsset(isObject(json) ? json : {});
        },
        readSchema: async () => readSchema(await get("/v1/schema.json")),
        imageUrl: (id, picture) =>
            `${base}/v1/scenes/${segment(id)}/image.${picture.format}?${queryOf(picture)}`,
        posterUrl: (id) => `${base}/v1/scenes/${segment(id)}/poster.jpg`,
        assetUrl: (id) => `${base}/v1/assets/${segment(id)}`,
        exampleImageUrl: (id) => `${base}/v1/examples/${segment(id)}/card.jpg`,
        referenceImageUrl: (type) => `${base}/v1/reference/${segment(type)}.jpg`,
        fetchFile,
        renderImage: async (scene, { outputs: _outputs, ...picture }, signal) => {
            const body = JSON.stringify({ scene, ...picture });
            const response = await request("/v1/render", { method: "POST", body, signal });
            return URL.createObjectURL(await response.blob());
        },
        fetchImage: async (url) => URL.createObjectURL(await fetchFile(url)),
    };
}

const TOKEN_KEY = "fieldcast.token";

/* The access token: taken once from `#token=…` in the address, which forgets it, and kept for this
 * tab. */
export function takeToken(location: Location, storage: Storage): string | null {
    const given = new URLSearchParams(location.hash.slice(1)).get("token");
    if (given !== null) {
        storage.setItem(TOKEN_KEY, given);
        history.replaceState(null, "", location.pathname + location.search);
    }
    return storage.getItem(TOKEN_KEY);
}

/* Offers a file; what no file's name should hold becomes "-". */
export function download(name: string, extension: string, blob: Blob): void {
    const anchor = document.createElement("a");
    anchor.href = URL.createObjectURL(blob);
    anchor.download = `${name.replace(/[^\w.-]+/g, "-") || "scene"}.${extension}`;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
}
