/* SPDX-License-Identifier: MIT */
/* Draws a picture as another camera sees it (model/warp.ts), on a canvas of its own. */
import { type Depths, type Mesh, meshOf, moveMesh, type Shot, trianglesOf } from "../model/warp.ts";

/* What is shown of a picture: how far it is, whence it was taken, and whence it is to be seen. */
export interface Moved {
    readonly depths: Depths;
    readonly from: Shot;
    readonly to: Shot;
}

const VERTEX = `#version 300 es
layout(location = 0) in vec4 place;
layout(location = 1) in vec2 spot;
out vec2 at;
void main() { gl_Position = place; at = spot; }`;

const FRAGMENT = `#version 300 es
precision mediump float;
uniform sampler2D picture;
in vec2 at;
out vec4 color;
void main() { color = vec4(texture(picture, at).rgb, 1.0); }`;

/* The whole picture, farthest of all: under what the mesh leaves free. */
const UNDER_PLACES = [-1, 1, 1, 1, 1, 1, 1, 1, -1, -1, 1, 1, 1, -1, 1, 1];
const UNDER_SPOTS = [0, 0, 1, 0, 0, 1, 1, 1];
const UNDER_TRIANGLES = [0, 1, 2, 2, 1, 3];

/* Browsers do not all tell by failIfMajorPerformanceCaveat. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

function isSoftware(gl: WebGL2RenderingContext): boolean {
    const told = gl.getExtension("WEBGL_debug_renderer_info");
    return SOFTWARE.test(String(gl.getParameter(told?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)));
}

function programOf(gl: WebGL2RenderingContext): WebGLProgram {
    const program = gl.createProgram();
    for (const [kind, text] of [
        [gl.VERTEX_SHADER, VERTEX],
        [gl.FRAGMENT_SHADER, FRAGMENT],
    ] as const) {
        const shader = gl.createShader(kind) as WebGLShader;
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
}

export class Warp {
    readonly #canvas: OffscreenCanvas;
    readonly #gl: WebGL2RenderingContext;
    readonly #places: WebGLBuffer;
    readonly #spots: WebGLBuffer;
    #bitmap: ImageBitmap | null = null;
    #depths: Depths | null = null;
    #mesh: Mesh | null = null;
    #out = new Float32Array(0);

    /* Null where there is no WebGL 2, or where the processors would have to do its work. */
    static create(): Warp | null {
        const canvas = typeof OffscreenCanvas === "function" ? new OffscreenCanvas(1, 1) : null;
        const gl = canvas?.getContext("webgl2", {
            alpha: false,
            antialias: false,
            failIfMajorPerformanceCaveat: true,
        });
        return canvas && gl && !isSoftware(gl) ? new Warp(canvas, gl) : null;
    }

    private constructor(canvas: OffscreenCanvas, gl: WebGL2RenderingContext) {
        this.#canvas = canvas;
        this.#gl = gl;
        this.#places = gl.createBuffer();
        this.#spots = gl.createBuffer();
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        // biome-ignore lint/correctness/useHookAtTopLevel: WebGL's, no hook
        gl.useProgram(programOf(gl));
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
    }

    isLost(): boolean {
        return this.#gl.isContextLost();
    }

    /* The picture, so large. */
    draw(bitmap: ImageBitmap, moved: Moved, width: number, height: number): OffscreenCanvas {
        const gl = this.#gl;
        if (this.#canvas.width !== width || this.#canvas.height !== height) {
            Object.assign(this.#canvas, { width, height });
            gl.viewport(0, 0, width, height);
        }
        if (bitmap !== this.#bitmap) {
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
            this.#bitmap = bitmap;
        }
        const mesh = this.#meshOf(moved);
        moveMesh(mesh, moved.from, moved.to, this.#out);
        this.#fill(0, this.#places, 4, this.#out);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        const count = 6 * (mesh.columns - 1) * (mesh.rows - 1) + UNDER_TRIANGLES.length;
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
        return this.#canvas;
    }

    #fill(location: number, buffer: WebGLBuffer, size: number, values: Float32Array): void {
        const gl = this.#gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, values, gl.STREAM_DRAW);
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, size, gl.FLOAT, false, 0, 0);
    }

    /* Corners, and behind them those of what is under them. */
    #meshOf({ depths, from }: Moved): Mesh {
        if (this.#mesh !== null && depths === this.#depths) {
            return this.#mesh;
        }
        const gl = this.#gl;
        const mesh = meshOf(depths, from);
        const corners = mesh.inverses.length;
        this.#out = new Float32Array(4 * (corners + 4));
        this.#out.set(UNDER_PLACES, 4 * corners);
        const spots = new Float32Array(2 * (corners + 4));
        spots.set(mesh.spots);
        spots.set(UNDER_SPOTS, 2 * corners);
        this.#fill(1, this.#spots, 2, spots);
        const triangles = new Uint32Array([
            ...UNDER_TRIANGLES.map((i) => corners + i),
            ...trianglesOf(mesh),
        ]);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STREAM_DRAW);
        this.#depths = depths;
        this.#mesh = mesh;
        return mesh;
    }
}
