/* SPDX-License-Identifier: MIT */
/* Where the engine runs: in a worker, or in the page where a canvas cannot be handed to one. */
import type { Order, Report } from "./engine.ts";
import type { Surface } from "./present.ts";

export interface Host {
    send(order: Exclude<Order, { kind: "surface" }>): void;
    /* Hands over a canvas that nothing was drawn on; null takes the picture away. */
    setCanvas(canvas: HTMLCanvasElement | null): void;
    end(): void;
}

function workerHost(take: (report: Report) => void): Host {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }: MessageEvent<Report>) => take(data);
    return {
        send: (order) => worker.postMessage(order),
        setCanvas: (canvas) => {
            const surface = canvas?.transferControlToOffscreen() ?? null;
            worker.postMessage({ kind: "surface", surface }, surface ? [surface] : []);
        },
        end: () => worker.terminate(),
    };
}

function pageHost(take: (report: Report) => void): Host {
    const orders: Order[] = [];
    let deliver = (order: Order): void => void orders.push(order);
    void import("./engine.ts").then(({ Engine }) => {
        const engine = new Engine(take);
        deliver = (order) => engine.take(order);
        orders.forEach(deliver);
    });
    return {
        send: (order) => deliver(order),
        setCanvas: (canvas) => deliver({ kind: "surface", surface: canvas as Surface | null }),
        end: () => deliver({ kind: "close" }),
    };
}

export function startHost(take: (report: Report) => void): Host {
    const capable =
        typeof Worker === "function" &&
        typeof HTMLCanvasElement.prototype.transferControlToOffscreen === "function";
    return capable ? workerHost(take) : pageHost(take);
}
