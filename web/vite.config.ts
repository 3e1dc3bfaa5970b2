/* SPDX-License-Identifier: MIT */
/* Build and test set-up: the page in dist/, a development proxy to a daemon, a size budget. */
import { gzipSync } from "node:zlib";
import react from "@vitejs/plugin-react";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";
import { chunks } from "./chunks.ts";

const daemon = process.env.FIELDCAST_URL ?? "http://127.0.0.1:8080";

/* gzip kB that a browser must load before the editor shows. */
const ENTRY_BUDGET_KB = 260;
/* Files that a browser asks for one by one. */
const FILES_BUDGET = 10;

/* Fails the build when the entry and all it imports statically, or the number of files, outgrow it. */
function budget(): Plugin {
    return {
        name: "budget",
        apply: "build",
        writeBundle(_options, bundle) {
            const wanted = new Set<string>();
            const want = (name: string): void => {
                const chunk = bundle[name];
                if (wanted.has(name) || chunk?.type !== "chunk") {
                    return;
                }
                wanted.add(name);
                chunk.imports.forEach(want);
            };
            for (const [name, chunk] of Object.entries(bundle)) {
                if (chunk.type === "chunk" && chunk.isEntry) {
                    want(name);
                }
            }
            const files = Object.keys(bundle).length;
            if (files > FILES_BUDGET) {
                this.error(`${files} files, budget ${FILES_BUDGET}: see chunks.ts`);
            }
            let bytes = 0;
            for (const name of wanted) {
                const chunk = bundle[name];
                bytes += chunk?.type === "chunk" ? gzipSync(chunk.code, { level: 9 }).length : 0;
            }
            const kilobytes = bytes / 1024;
            if (kilobytes > ENTRY_BUDGET_KB) {
                this.error(`entry is ${kilobytes.toFixed(1)} kB gzip, budget ${ENTRY_BUDGET_KB}`);
            }
            this.info(`entry is ${kilobytes.toFixed(1)} kB gzip, budget ${ENTRY_BUDGET_KB}`);
        },
    };
}

export default defineConfig({
    plugins: [react(), budget()],
    build: {
        target: "es2022",
        outDir: "dist",
        chunkSizeWarningLimit: 1000,
        rollupOptions: { output: { manualChunks: chunks(), onlyExplicitManualChunks: true } },
    },
    worker: { format: "es" },
    server: {
        proxy: {
            /* The daemon checks Origin against Host, so both name it. */
            "^/(v1|healthz|readyz|metrics)": {
                target: daemon,
                ws: true,
                changeOrigin: true,
                headers: { origin: daemon },
            },
        },
    },
    test: {
        include: ["tests/**/*.test.ts", "tests/**/*.test.tsx"],
        exclude: ["tests/e2e/**"],
        /* Half of the time is to read the page's modules: all files share them. */
        pool: "threads",
        isolate: false,
        testTimeout: 600_000 /* a slow machine is no fault of the code */,
    },
});
