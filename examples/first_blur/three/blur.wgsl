// Three.js r187 - Node System

struct objectStruct {
    nodeUniform2: f32,
    nodeUniform3: i32,
    nodeUniform4: vec2<f32>,
}
@binding(4) @group(1) var<uniform> object: objectStruct;

@binding(0) @group(1) var nodeUniform0_sampler: sampler;
@binding(1) @group(1) var nodeUniform0: texture_2d<f32>;
@binding(3) @group(1) var nodeUniform1: texture_2d<f32>;

@fragment
fn main(@location(0) v_uv: vec2<f32>) -> @location(0) vec4<f32> {
    let texel = vec2<u32>(v_uv * object.nodeUniform4);
    // From normalised device coordinates, with y up, to texture coordinates.
    let trail = textureLoad(nodeUniform1, texel, 0).xy * vec2<f32>(0.5, -0.5) * object.nodeUniform2;
    var nodeVar0 = vec4<f32>(0.0);
    for (var i: i32 = 0; i < object.nodeUniform3; i++) {
        let along = (f32(i) + 0.5) / f32(object.nodeUniform3);
        nodeVar0 += textureSampleLevel(nodeUniform0, nodeUniform0_sampler, v_uv + along * trail, 0.0);
    }
    return nodeVar0 / f32(object.nodeUniform3);
}
