// SPDX-License-Identifier: MIT
// What stands in the library of the pictures.

const MATTER = { shader: 'standard', properties: { base_color: [0.6, 0.24, 0.13], roughness: 0.6 } };
const GOLD = { shader: 'standard', properties: { base_color: [1, 0.77, 0.34], metallic: 1, roughness: 0.2 } };
const made = (name, kind, root, materials = { clay: MATTER }) => ({
    kind,
    document: { format: 'fieldcast/1', name, materials, root: { material: Object.keys(materials)[0], ...root } },
});
const MUG = {
    type: 'difference',
    children: [
        { type: 'smooth_union', params: { k: 0.1 }, children: [
            { type: 'round_cylinder' },
            { type: 'torus', transform: { translation: [0.6, 0, 0], rotation: [1.57, 0, 0], scale: 0.45 } },
        ] },
        { type: 'cylinder', params: { radius: 0.4 }, transform: { translation: [0, 0.2, 0] } },
    ],
};
export const LIBRARY = [
    made('Mug', 'model', MUG),
    made('Ring of beads', 'model', { type: 'torus' }, { gold: GOLD }),
    made('A model with quite a long name for a narrow card', 'model', { type: 'box' }),
    made('Gold leaf', 'material', { type: 'sphere' }, { gold: GOLD }),
    made('Old clay', 'material', { type: 'sphere' }),
    made('Heart', 'primitive', { type: 'implicit', params: { equation: '(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3 = 0' } }),
];
