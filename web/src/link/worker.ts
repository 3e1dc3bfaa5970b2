/* SPDX-License-Identifier: MIT */
/* The one worker of a page: an engine behind messages. */
import { Engine, type Order } from "./engine.ts";

declare const self: DedicatedWorkerGlobalScope;

const engine = new Engine((report) => self.postMessage(report));
self.onmessage = ({ data }: MessageEvent<Order>) => engine.take(data);
