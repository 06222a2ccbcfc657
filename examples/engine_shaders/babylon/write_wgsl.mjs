// Writes out the WGSL of Babylon.js's motion blur, both modes, with its preprocessor's conditions resolved and its declarations in plain
// WGSL, as the engine does for WebGPU. The computation is unchanged.
//
//     npm install @babylonjs/core@9.35.0 && node write_wgsl.mjs
import { writeFileSync } from 'node:fs';
import { motionBlurPixelShaderWGSL } from '@babylonjs/core/ShadersWGSL/motionBlur.fragment.js';

// The lines with true conditions.
function preprocessed(text, defines) {
    const open = [];
    return text.split('\n').filter((line) => {
        const [word, name] = line.trim().split(/\s+/);
        if (word === '#ifdef') open.push(defines.includes(name));
        else if (word === '#else') open.push(!open.pop());
        else if (word === '#endif') open.pop();
        else return word !== '#define' && open.every((holds) => holds);
        return false;
    }).join('\n');
}

// Declarations in WGSL: a location for each varying, one block for the uniforms, a binding for everything else.
function declared(text) {
    let binding = 1;
    const uniforms = [...text.matchAll(/uniform (\w+): (\w+);/g)].map(([, name, type]) => `    ${name}: ${type},\n`);
    const body = text
        .replace(/varying vUV: vec2f;/, '')
        .replace(/uniform \w+: \w+;/g, '')
        .replace(/\bvar (\w+): (sampler|texture_2d<f32>);/g, (_, name, type) => `\n@group(0) @binding(${binding++}) var ${name}: ${type};`)
        .replaceAll('input: FragmentInputs', '@location(0) vUV: vec2f')
        .replaceAll('input.vUV', 'vUV')
        .replace('->FragmentOutputs {', '-> FragmentOutputs {\nvar fragmentOutputs: FragmentOutputs;')
        .replace(/\}\s*$/, 'return fragmentOutputs;\n}\n');
    return `struct Uniforms {\n${uniforms.join('')}}\n@group(0) @binding(0) var<uniform> uniforms: Uniforms;\n`
        + `struct FragmentOutputs { @location(0) color: vec4f }\n${body}`;
}

for (const [file, mode] of [['object.wgsl', 'OBJECT_BASED'], ['../babylon_screen/screen.wgsl', 'SCREEN_BASED']]) {
    const text = preprocessed(motionBlurPixelShaderWGSL.shader, ['GEOMETRY_SUPPORTED', mode]);
    writeFileSync(file, declared(text).replaceAll('SAMPLES', '32.0'));
}
