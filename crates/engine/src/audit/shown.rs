//! Share of each object that an engine shows where the scene has it.

use frame::Raster;
use serde::Serialize;

use crate::audit::clear_pixels::{FEWEST_PIXELS, is_inside, neighbours};

/// Part of each object that must be where the scene has it, at its edges within a pixel.
pub const LEAST_SHOWN: f64 = 0.9;

/// Agreement of what an engine shows with an object of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectShown {
    /// Name of the object.
    pub object: String,
    /// Number of its pixels in the scene.
    pub pixels: usize,
    /// Part of these, and of the pixels at which the engine's ids name the object, at which both agree.
    pub shown: f64,
}

impl ObjectShown {
    /// Tells whether the engine shows too little of the object for its vectors to be judged.
    pub fn is_missed(&self) -> bool {
        self.pixels >= FEWEST_PIXELS && self.shown < LEAST_SHOWN
    }
}

/// Counts per object the pixels that the engine shows; `shows(from, at)` tells whether its pixel `from` shows what the scene has at
/// `at`. At edges a neighbouring pixel will do, since two rasterisers may differ there.
pub fn count_shown(
    right: &Raster<u32>,
    ids: Option<&Raster<u32>>,
    names: &[String],
    shows: &dyn Fn(usize, usize) -> bool,
) -> Vec<ObjectShown> {
    let mut counts = vec![Count::default(); names.len()];
    for (at, object) in right.pixels.iter().enumerate() {
        counts[*object as usize].add(match is_inside(right, at) {
            true => shows(at, at),
            false => neighbours(right, at).any(|from| shows(from, at)),
        });
    }
    let in_scene = counts.clone();
    let found = ids
        .into_iter()
        .flat_map(|ids| ids.pixels.iter().enumerate());
    for (at, object) in found {
        // The place of an object that is missing shows what is behind it.
        let is_laid_bare = in_scene[right.pixels[at] as usize].share() < LEAST_SHOWN;
        if let Some(count) = counts.get_mut(*object as usize)
            && !is_laid_bare
        {
            count.add(neighbours(right, at).any(|place| right.pixels[place] == *object));
        }
    }
    let objects = names.iter().zip(in_scene.iter().zip(&counts));
    let shown = objects.map(|(name, (in_scene, count))| ObjectShown {
        object: name.clone(),
        pixels: in_scene.all,
        shown: count.share(),
    });
    shown.filter(|object| object.pixels > 0).collect()
}

/// Number of pixels of an object, and of those that agree.
#[derive(Clone, Default)]
struct Count {
    same: usize,
    all: usize,
}

impl Count {
    fn add(&mut self, is_same: bool) {
        self.same += usize::from(is_same);
        self.all += 1;
    }

    fn share(&self) -> f64 {
        self.same as f64 / self.all.max(1) as f64
    }
}
