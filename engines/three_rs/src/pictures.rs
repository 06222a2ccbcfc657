//! Pictures that quads draw from passes over the scene.

use three_rs::nodes::NodeRef;
use three_rs::nodes::tsl::{float, texture_uv, uv, vec2, vec4_join};
use three_rs::renderer::{RenderTarget, RenderTargetOptions};
use three_rs::textures::TextureType;
use three_rs::{MeshBasicNodeMaterial, PassNode, QuadMesh, Renderer};

/// A pixel's colour is the mean over its square, of this many places in each direction.
pub const COLOR_SAMPLES: u32 = 4;
/// Steps of a depth that a half float holds exactly.
const DEPTH_STEPS: f32 = 1024.0;

/// What a quad draws, and the picture it draws into.
pub struct Picture {
    quad: QuadMesh,
    pub target: RenderTarget,
}

/// Draws pictures of one frame. three-rs ends a frame, and keeps its matrices, when something is drawn on the canvas.
pub fn draw_frame(renderer: &mut Renderer, pictures: &[&Picture]) {
    for picture in pictures {
        renderer.set_render_target(Some(picture.target.clone()));
        renderer.render_quad(&picture.quad);
    }
    renderer.set_render_target(None);
    renderer.render_quad(&pictures[0].quad);
}

impl Picture {
    /// Half floats are all that three-rs draws into; it refuses 32-bit floats.
    pub fn new((width, height): (u32, u32), node: NodeRef) -> Self {
        let mut material = MeshBasicNodeMaterial::new();
        material.fragment_node = Some(node);
        let mut options = RenderTargetOptions::default();
        options.texture_type = TextureType::HalfFloat;
        options.depth_buffer = false;
        let target = RenderTarget::new_with_options(width, height, options).unwrap();
        Self {
            quad: QuadMesh::new(material),
            target,
        }
    }

    pub fn read(&self, renderer: &mut Renderer) -> Vec<[f32; 4]> {
        let (_, _, values) = renderer.read_target_pixels_rgba16f(&self.target).unwrap();
        values.as_chunks::<4>().0.to_vec()
    }

    /// Reads a depth that was split.
    pub fn read_depth(&self, renderer: &mut Renderer) -> Vec<[f32; 4]> {
        let mut pixels = self.read(renderer);
        for parts in &mut pixels {
            parts[0] += (parts[1] + parts[2] / DEPTH_STEPS) / DEPTH_STEPS;
        }
        pixels
    }
}

/// Averages squares of a picture finer than its pixels.
pub fn average_squares(fine: &PassNode, (width, height): (u32, u32)) -> NodeRef {
    let offset = |at: u32, size: u32| {
        ((f64::from(at) + 0.5) / f64::from(COLOR_SAMPLES) - 0.5) / f64::from(size)
    };
    let places = (0..COLOR_SAMPLES * COLOR_SAMPLES).map(|at| {
        let (x, y) = (at % COLOR_SAMPLES, at / COLOR_SAMPLES);
        texture_uv(
            &fine.texture(),
            uv().add(vec2(offset(x, width), offset(y, height))),
        )
    });
    let sum = places.reduce(|sum, sample| sum.add(sample)).unwrap();
    sum.div(float((COLOR_SAMPLES * COLOR_SAMPLES) as f64))
}

/// Splits a depth into three parts that half floats hold.
pub fn split_depth(depth: NodeRef) -> NodeRef {
    let scale = || float(DEPTH_STEPS as f64);
    let coarse = depth.mul(scale()).floor().div(scale());
    let rest = depth.sub(coarse.clone()).mul(scale());
    let middle = rest.mul(scale()).floor().div(scale());
    let last = rest.sub(middle.clone()).mul(scale());
    vec4_join(vec![coarse, middle, last, float(1.0)])
}
