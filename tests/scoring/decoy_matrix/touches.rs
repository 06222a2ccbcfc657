//! Mistakes that need no scene: they change a correct picture where it should equal the instant, or
//! everywhere.

use frame::{Image, Picture, Plane, Raster};
use tests::random::Random;

use super::decoys::{blur_isotropically, map_planes};

/// Standard deviation of the blur of still pixels, in pixels.
const BLUR: f64 = 1.5;
/// Side of a tile, in pixels, and the part of its light that a seam loses.
const TILE: u32 = 20;
const SEAM: f32 = 0.1;
/// Amplitude of grain and checkerboards, as a part of the light.
const GRAIN: f32 = 0.02;
/// Offset of a ghost to the right, in pixels, and its part of the light.
const OFFSET: u32 = 3;
const GHOST: f32 = 0.2;

/// Makes wrong pictures of a correct one, with their names; `still` marks the pixels where nothing
/// moves.
pub fn touch(right: &Picture, still: &Raster<bool>) -> Vec<(&'static str, Picture)> {
    let everywhere = still.map(|_| true);
    let moving = still.map(|still| !still);
    let blurred = blur_isotropically(right, BLUR).color;
    vec![
        ("still part blurred", swap(right, &blurred, still)),
        ("still part 5 % darker", scale(right, still, |_, _| 0.95)),
        ("tile seams", scale(right, &everywhere, seam)),
        ("checkerboard", scale(right, &everywhere, checker)),
        ("checkerboard, moving part", scale(right, &moving, checker)),
        ("grain", scale(right, &everywhere, grain())),
        ("grain, moving part", scale(right, &moving, grain())),
        ("double image", ghost(right)),
    ]
}

/// Takes the pixels of `inside` from another image.
fn swap(right: &Picture, other: &Image, inside: &Raster<bool>) -> Picture {
    let chosen = right.color.zip(other, |color, other| [*color, *other]);
    Picture {
        color: chosen.zip(inside, |pair, inside| pair[usize::from(*inside)]),
        ..right.clone()
    }
}

/// Multiplies the light of the pixels of `inside` by a factor of their column and row.
fn scale(right: &Picture, inside: &Raster<bool>, factor: impl FnMut(u32, u32) -> f32) -> Picture {
    let (width, height) = (inside.width, inside.height);
    let factors = Raster::from_fn(width, height, factor);
    let changed = right
        .color
        .zip(&factors, |color, factor| color.map(|part| part * factor));
    swap(right, &changed, inside)
}

fn seam(x: u32, y: u32) -> f32 {
    let is_seam = x.is_multiple_of(TILE) || y.is_multiple_of(TILE);
    if is_seam { 1.0 - SEAM } else { 1.0 }
}

fn checker(x: u32, y: u32) -> f32 {
    let is_even = (x + y).is_multiple_of(2);
    if is_even { 1.0 + GRAIN } else { 1.0 - GRAIN }
}

/// Draws uniform numbers with the standard deviation of the grain.
fn grain() -> impl FnMut(u32, u32) -> f32 {
    let mut random = Random::new(5);
    let reach = GRAIN * 3f32.sqrt();
    move |_, _| 1.0 + random.real(-reach, reach)
}

/// Shows a part of the picture again, to the right.
fn ghost(right: &Picture) -> Picture {
    map_planes(right, |plane: &Plane| {
        Raster::from_fn(plane.width, plane.height, |x, y| {
            let ghost = plane.at(x.saturating_sub(OFFSET), y);
            (1.0 - GHOST) * plane.at(x, y) + GHOST * ghost
        })
    })
}
