//! Regions of a picture, and the blocks of their pixels that are compared as a whole.

use std::collections::BTreeMap;

use frame::{Raster, Size};

use crate::audit_self::frame_pair::FramePair;
use crate::capture::folder::Capture;

/// Smallest number of pixels of a block that is compared.
pub const MIN_PIXELS: usize = 12;
/// Blocks that a region is divided into, about.
const BLOCKS: f64 = 24.0;
/// Sides of a block, in pixels.
const SIDES: [f64; 2] = [6.0, 48.0];
/// Columns and rows of regions if nothing tells objects apart.
const PARTS: u32 = 3;
/// Names of these regions.
const PART_NAMES: [&str; 9] = [
    "top left",
    "top",
    "top right",
    "left",
    "centre",
    "right",
    "bottom left",
    "bottom",
    "bottom right",
];

/// An object of the later frame, or a part of the picture.
pub struct Region {
    pub name: String,
    /// Pixels that show it.
    pub pixels: Vec<usize>,
    /// Those well inside it, block by block.
    pub blocks: Vec<Block>,
}

/// Pixels close to each other, well inside a region.
pub struct Block {
    pub pixels: Vec<usize>,
}

/// Divides the later frame into its objects, or into nine parts if it has no ids.
pub fn divide(pair: &FramePair) -> Vec<Region> {
    let size = pair.after.color.size();
    let numbers = number_regions(pair.after, size);
    // Ids may be any numbers, such as hashes of names.
    let mut regions = BTreeMap::<u32, Vec<usize>>::new();
    for (at, region) in numbers.pixels.iter().enumerate() {
        regions.entry(*region).or_default().push(at);
    }
    let has_ids = pair.after.object_id.is_some();
    (regions.into_iter())
        .map(|(number, pixels)| Region {
            name: name_region(number, has_ids),
            blocks: divide_region(pair, &pixels, size.width as usize),
            pixels,
        })
        .collect()
}

fn number_regions(frame: &Capture, size: Size) -> Raster<u32> {
    match &frame.object_id {
        Some(ids) => ids.clone(),
        None => Raster::from_fn(size.width, size.height, |x, y| {
            (PARTS * y / size.height) * PARTS + PARTS * x / size.width
        }),
    }
}

/// Names a region as ingested captures name objects.
fn name_region(number: u32, has_ids: bool) -> String {
    match (has_ids, number) {
        (false, part) => PART_NAMES[part as usize].to_owned(),
        (true, 0) => "background".to_owned(),
        (true, id) => format!("object_{id}"),
    }
}

fn divide_region(pair: &FramePair, pixels: &[usize], width: usize) -> Vec<Block> {
    let inside = pixels.iter().copied().filter(|at| pair.is_inside(*at));
    let inside: Vec<usize> = inside.collect();
    let side = (inside.len() as f64 / BLOCKS).sqrt();
    let side = side.clamp(SIDES[0], SIDES[1]) as usize;
    let mut tiles = BTreeMap::<[usize; 2], Vec<usize>>::new();
    for at in inside {
        let tile = [at / width / side, at % width / side];
        tiles.entry(tile).or_default().push(at);
    }
    let blocks = tiles
        .into_values()
        .filter(|pixels| pixels.len() >= MIN_PIXELS);
    blocks.map(|pixels| Block { pixels }).collect()
}
