//! Synthetic frame for timing filters.

use frame::{Camera, CameraPose, FAR_DEPTH, Image, Plane, Raster, Reprojection, Vectors};

/// Input of a filter: moving panels over a still ground.
pub struct Panels {
    /// Scene-linear radiance.
    pub color: Image,
    /// Motion in pixels per frame.
    pub velocity: Vectors,
    /// Depth in metres.
    pub depth: Plane,
    /// Camera motion, for filters that use nothing else: a pan of the same speed.
    pub reprojection: Reprojection,
    /// Camera at the world's origin, for shaders that use its matrices.
    pub camera: Camera,
}

/// A panel of the frame.
#[derive(Clone, Copy)]
struct Panel {
    /// Centre, in parts of the image's width and height.
    center: [f32; 2],
    /// Half its sides, in parts of the height.
    half: [f32; 2],
    /// Direction of its motion, of length 1.
    direction: [f32; 2],
    /// Depth in metres.
    depth: f32,
}

/// Panels from front to back. They cover about a quarter of the image, overlap, and leave it at no
/// border.
const PANELS: [Panel; 5] = [
    Panel {
        center: [0.30, 0.35],
        half: [0.20, 0.15],
        direction: [1.0, 0.0],
        depth: 2.0,
    },
    Panel {
        center: [0.40, 0.50],
        half: [0.12, 0.22],
        direction: [0.0, -1.0],
        depth: 4.0,
    },
    Panel {
        center: [0.70, 0.30],
        half: [0.18, 0.18],
        direction: [-0.8, 0.6],
        depth: 5.0,
    },
    Panel {
        center: [0.75, 0.75],
        half: [0.30, 0.05],
        direction: [0.6, 0.8],
        depth: 8.0,
    },
    Panel {
        center: [0.20, 0.80],
        half: [0.03, 0.12],
        direction: [0.96, -0.28],
        depth: 12.0,
    },
];

/// Change of a panel's speed at the ends of its long side, as in a turning panel: no two of its
/// pixels move alike.
const SPREAD: f32 = 0.1;

impl Panels {
    /// Makes five textured panels that move `speed` pixels per frame, each in its own direction,
    /// over a still textured ground.
    pub fn new(width: u32, height: u32, speed: f32) -> Self {
        let at = |x, y| panel_at(width, height, x, y);
        Self {
            color: Raster::from_fn(width, height, |x, y| {
                let tint = match at(x, y) {
                    None => [0.3, 0.35, 0.4],
                    Some((panel, _)) => [0.9, 0.1 * panel.depth, 0.5 * panel.direction[0].abs()],
                };
                tint.map(|value| value * texture(x, y))
            }),
            velocity: Raster::from_fn(width, height, |x, y| {
                at(x, y).map_or([0.0; 2], |(panel, along)| {
                    let pixels = speed * (1.0 + SPREAD * along);
                    panel.direction.map(|component| component * pixels)
                })
            }),
            depth: Raster::from_fn(width, height, |x, y| {
                at(x, y).map_or(FAR_DEPTH, |(panel, _)| panel.depth)
            }),
            reprojection: Reprojection {
                rows: [
                    [1.0, 0.0, -f64::from(speed), 0.0],
                    [0.0, 1.0, 0.0, 0.0],
                    [0.0, 0.0, 1.0, 0.0],
                ],
            },
            camera: Camera::still(CameraPose::at_origin(f64::from(height))),
        }
    }
}

/// Finds the panel that a pixel shows, and the pixel's position along its sides: -1 to 1.
fn panel_at(width: u32, height: u32, x: u32, y: u32) -> Option<(Panel, f32)> {
    let point = [x as f32 + 0.5, y as f32 + 0.5];
    let size = [width as f32, height as f32];
    PANELS.into_iter().find_map(|panel| {
        let Panel { center, half, .. } = panel;
        let place =
            |axis: usize| (point[axis] - center[axis] * size[axis]) / (half[axis] * size[1]);
        let offset = [0, 1].map(place);
        let is_inside = offset.iter().all(|part| part.abs() <= 1.0);
        is_inside.then_some((panel, 0.5 * (offset[0] + offset[1])))
    })
}

/// Computes a texture with contrast at every scale down to the pixel, so that a skipped fetch is
/// visible.
fn texture(x: u32, y: u32) -> f32 {
    let checker = if (x / 16 + y / 16).is_multiple_of(2) {
        0.6
    } else {
        0.2
    };
    let grain =
        (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0xc2b2_ae35);
    checker + 0.4 * (grain >> 8) as f32 / (1 << 24) as f32
}
