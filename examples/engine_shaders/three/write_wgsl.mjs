// Makes three.js write out the WGSL of its motion blur with its own node builder; no GPU is needed.
//
//     npm install three@0.187.0 && node write_wgsl.mjs
import { writeFileSync } from 'node:fs';

// A stub for the device that accepts every call of the renderer.
const anything = new Proxy(function () {}, {
    get: (_, key) => (key === Symbol.toPrimitive ? () => 0 : key === 'then' ? undefined : anything),
    apply: () => anything,
    construct: () => anything,
    set: () => true,
});
const constants = new Proxy({}, { get: () => 0 });
Object.assign(globalThis, {
    self: globalThis,
    requestAnimationFrame: () => 0,
    cancelAnimationFrame: () => {},
    GPUShaderStage: constants,
    GPUTextureUsage: constants,
    GPUBufferUsage: constants,
    GPUMapMode: constants,
    GPUColorWrite: constants,
});
// Newer versions of Node have a navigator that cannot be assigned.
Object.defineProperty(globalThis, 'navigator', {
    value: { gpu: { getPreferredCanvasFormat: () => 'bgra8unorm' } },
    configurable: true,
});
const createBuffer = ({ size }) => ({ getMappedRange: () => new ArrayBuffer(size), unmap() {}, destroy() {} });
const device = new Proxy({}, {
    get: (_, key) => ({ createBuffer, features: new Set(), limits: {}, lost: new Promise(() => {}) })[key]
        ?? (/Async$|popErrorScope/.test(String(key)) ? async () => null : anything),
});
const canvas = { width: 64, height: 64, style: {}, addEventListener() {}, getContext: () => anything, setAttribute() {} };

const THREE = await import('three/webgpu');
const { texture, uniform, int } = await import('three/tsl');
const { motionBlur } = await import('three/addons/tsl/display/MotionBlur.js');

const renderer = new THREE.WebGPURenderer({ canvas, device, context: anything });
renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
await renderer.init();
const target = () => {
    const made = new THREE.DataTexture(new Uint16Array(4), 1, 1, THREE.RGBAFormat, THREE.HalfFloatType);
    made.minFilter = made.magFilter = THREE.LinearFilter;
    return texture(made);
};
const [color, velocity] = [target(), target()];
const material = new THREE.NodeMaterial();
material.fragmentNode = motionBlur(color, velocity.mul(uniform(1)), int(16));
const quad = new THREE.QuadMesh(material);
const scene = new THREE.Scene();
scene.add(quad);
const { fragmentShader } = await renderer.debug.getShaderAsync(scene, quad.camera, quad);
writeFileSync('motion_blur.wgsl', fragmentShader);
