// SPDX-License-Identifier: MIT
// The scene of most pictures: a table with one of everything that has a form of its own; and the same
// with code of its own, which takes longer to draw.

const material = (shader, properties) => ({ shader, properties });

const MATERIALS = {
    clay: material('phong', { diffuse: [0.72, 0.26, 0.14], specular: [0.3, 0.3, 0.3], shininess: 40 }),
    glaze: material('blinn', { diffuse: [0.1, 0.3, 0.45], specular: [0.4, 0.4, 0.4], shininess: 80 }),
    gold: material('standard', { base_color: [1, 0.72, 0.3], metallic: 1, roughness: 0.25 }),
    lamp: material('unlit', { color: [3, 2.1, 1.2] }),
    tiles: material('checker', { color1: [0.62, 0.6, 0.57], color2: [0.5, 0.48, 0.46], scale: 0.5 }),
    facing: material('normals', {}),
    'a-material-with-quite-a-long-name-for-a-narrow-list': material('phong', { diffuse: [0.4, 0.5, 0.3] }),
};

const LIGHTS = [
    { id: 'sun', type: 'directional', direction: [-0.55, -0.75, -0.4], color: [1, 0.94, 0.86], intensity: 2.6, size: 10 },
    { id: 'window', type: 'point', position: [-3, 2.5, 2], color: [0.6, 0.75, 1], intensity: 4, shadow: 'none' },
    { id: 'spot', type: 'spot', position: [2, 3, 1], direction: [-0.5, -1, -0.4], intensity: 6, shadow: 'none' },
];

const EGG = `// An egg: a ball, flatter below.
float sdf(vec3 p) {
    p.y *= p.y > 0.0 ? 0.8 : 1.1;
    return (length(p) - radius) * 0.8;
}
`;

const MARBLE = `vec3 shade(FragmentProperties properties) {
    return vein;
}
`;

const CHILDREN = [
    {
        id: 'jug',
        type: 'smooth_union',
        name: 'Jug',
        material: 'clay',
        params: { k: 0.2 },
        children: [
            { id: 'ball', type: 'sphere', name: 'Ball', params: { radius: 0.55 }, transform: { translation: [0, 0.55, 0] } },
            {
                id: 'block',
                type: 'round_box',
                name: 'Block',
                params: { size: [0.9, 0.4, 0.9], radius: 0.08 },
                transform: { translation: [0.5, 0.2, 0.1] },
            },
        ],
    },
    {
        id: 'pillar',
        type: 'twist',
        name: 'Pillar',
        material: 'glaze',
        transform: { translation: [-1.25, 0.55, -0.35], rotation: [0, 0.4, 0] },
        params: { rate: 1.6 },
        children: [{ id: 'bar', type: 'round_box', params: { size: [0.5, 1.1, 0.5], radius: 0.06 } }],
    },
    {
        id: 'beads',
        type: 'repeat',
        name: 'Beads',
        material: 'gold',
        transform: { translation: [0.2, 0.09, 1.1] },
        params: { spacing: [0.28, 1, 1], count: [7, 1, 1] },
        children: [{ id: 'bead', type: 'sphere', params: { radius: 0.09 } }],
    },
    {
        id: 'crown',
        type: 'repeat_polar',
        name: 'Crown',
        material: 'gold',
        transform: { translation: [0, 1.12, 0] },
        params: { count: 9 },
        children: [
            { id: 'tip', type: 'sphere', params: { radius: 0.06 }, transform: { translation: [0.22, 0, 0] } },
        ],
    },
    {
        id: 'solid',
        type: 'extrude',
        name: 'Sign',
        material: 'lamp',
        transform: { translation: [1.35, 0.55, -0.5], rotation: [0, -0.5, 0] },
        params: { height: 0.1 },
        children: [
            {
                id: 'outline',
                type: 'polygon',
                name: 'Outline',
                params: { points: [[-0.3, -0.35], [0.3, -0.35], [0.36, 0.1], [0, 0.42], [-0.36, 0.1]] },
            },
        ],
    },
    { id: 'pawn-1', type: 'model', name: 'Pawn', material: 'glaze', params: { model: 'pawn' }, transform: { translation: [1.35, 0, 0.75] } },
    {
        id: 'floor',
        type: 'round_box',
        name: 'Table top',
        material: 'tiles',
        params: { size: [4.4, 0.2, 3.6], radius: 0.05 },
        transform: { translation: [0, -0.1, 0.1] },
    },
];

const PAWN = {
    id: 'pawn-body',
    type: 'smooth_union',
    params: { k: 0.12 },
    children: [
        { id: 'pawn-foot', type: 'round_cylinder', transform: { translation: [0, 0.08, 0] }, params: { radius: 0.22, height: 0.16, rounding: 0.05 } },
        { id: 'pawn-head', type: 'sphere', transform: { translation: [0, 0.52, 0] }, params: { radius: 0.15 } },
        { id: 'pawn-neck', type: 'cone', transform: { translation: [0, 0.3, 0] }, params: { radius: 0.18, height: 0.5 } },
    ],
};

export const STUDIO = {
    format: 'fieldcast/1',
    name: 'A table in the studio',
    camera: { position: [2.9, 2.2, 4.6], target: [0.05, 0.5, 0.1], fov: 30 },
    lights: LIGHTS,
    volumes: [{ id: 'mist', type: 'box', position: [0, 60, 0], size: [1, 1, 1] }],
    models: { pawn: PAWN },
    materials: MATERIALS,
    environment: { type: 'sky', zenith: [0.28, 0.42, 0.62], horizon: [0.85, 0.84, 0.82], intensity: 0.8 },
    render: { samples: 1, level: 'interactive' },
    root: { id: 'root', type: 'union', name: 'Studio', children: CHILDREN },
};

const EGG_NODE = {
    id: 'egg-1',
    type: 'field',
    name: 'Egg',
    material: 'veined',
    transform: { translation: [-0.75, 0.26, 0.85] },
    params: { primitive: 'egg', radius: 0.24 },
};

export const CODED = {
    ...STUDIO,
    primitives: {
        egg: { params: [{ name: 'radius', type: 'float', default: 0.3, range: [0, 2], doc: 'Of its widest ring.' }], code: EGG },
    },
    shaders: {
        marble: {
            properties: [
                { name: 'vein', type: 'color', default: [0.8, 0.8, 0.8] },
                { name: 'width', type: 'float', default: 0.5, range: [0, 1] },
            ],
            code: MARBLE,
        },
    },
    materials: { veined: material('marble', { vein: [0.82, 0.8, 0.76], width: 0.4 }), ...MATERIALS },
    root: { ...STUDIO.root, children: [EGG_NODE, ...CHILDREN] },
};

/** What a scene without anything is. */
export const EMPTY = {
    format: 'fieldcast/1',
    name: 'Untitled',
    camera: { position: [1.8, 1.3, 3], fov: 35 },
    root: { id: 'root', type: 'union', children: [] },
};

const alone = (name, node) => ({
    ...EMPTY,
    name,
    camera: { ...STUDIO.camera, position: [2, 1.6, 3.3], fov: 50 },
    lights: STUDIO.lights,
    root: { id: 'root', type: 'union', children: [node] },
});

/** A surface by an equation: `params` of an implicit. */
export const implicit = (params) => alone('Equation', { id: 'equation', type: 'implicit', params });

/** A surface by three expressions. */
export const parametric = (surface) => alone('Surface', { id: 'surface', type: 'parametric', params: { surface } });

/** Whitney's umbrella, beside the surface that it is of: with this equation or another. */
export const umbrella = (equation) =>
    alone('Umbrella', {
        id: 'umbrella',
        type: 'implicit',
        params: {
            equation,
            mode: 'sheet',
            parametric: { x: 's*t', y: 's', z: 't^2', s: [-1, 1], t: [-1.5, 1.5] },
        },
    });
