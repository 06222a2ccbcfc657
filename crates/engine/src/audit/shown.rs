//! Share of each object that an engine shows in the scene's place.

use frame::Raster;
use serde::Serialize;
use tracer::PointLayers;

use crate::audit::clear_pixels::{
    ClearPixels, MIN_PIXELS, is_inside, neighbours, select_clear_pixels,
};

/// Part of the pixels that must have a known depth: without ids, only depth tells what the engine
/// shows there.
const LEAST_KNOWN: f64 = 0.3;

/// Part of each object that must be in the scene's place, within a pixel at edges.
pub const LEAST_SHOWN: f64 = 0.9;

/// Agreement of an engine's picture with an object of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectShown {
    /// Name of the object.
    pub object: String,
    /// Number of its pixels in the scene.
    pub pixels: usize,
    /// Part of these pixels, and of those that the engine's ids assign to the object, on which both
    /// agree.
    pub shown: f64,
}

impl ObjectShown {
    /// Returns whether the engine shows too little of the object to judge its vectors.
    pub fn is_missed(&self) -> bool {
        self.pixels >= MIN_PIXELS && self.shown < LEAST_SHOWN
    }
}

/// How much of a scene an engine shows.
pub struct Shown {
    /// Part of the pixels at which it shows the same as the scene.
    pub alike: f64,
    /// The same, object by object.
    pub objects: Vec<ObjectShown>,
    /// Comparable pixels of each object; none for a missed one.
    pub regions: Vec<ClearPixels>,
}

impl Shown {
    /// Compares an engine's picture with the scene; `shows(from, at)` is true if its pixel `from`
    /// shows what the scene has at `at`.
    pub fn compare(
        right: &PointLayers,
        ids: Option<&Raster<u32>>,
        names: &[String],
        shows: &dyn Fn(usize, usize) -> bool,
    ) -> Self {
        let right_ids = &right.object_id;
        let count = right_ids.pixels.len();
        let alike = (0..count).filter(|at| shows(*at, *at)).count() as f64 / count as f64;
        let mut shown = Self {
            alike,
            objects: count_shown(right_ids, ids, names, shows),
            regions: Vec::new(),
        };
        let is_clear = |at: usize| {
            let name = &names[right_ids.pixels[at] as usize];
            (alike < LEAST_KNOWN || shows(at, at)) && !shown.is_missed(name)
        };
        shown.regions = select_clear_pixels(right, names.len(), &is_clear);
        shown
    }

    /// Returns whether the engine shows too little of an object.
    pub fn is_missed(&self, name: &str) -> bool {
        (self.objects.iter()).any(|object| object.is_missed() && object.object == name)
    }
}

/// Counts the shown pixels of each object. At edges a neighbouring pixel counts, since two
/// rasterisers may differ there.
fn count_shown(
    right: &Raster<u32>,
    ids: Option<&Raster<u32>>,
    names: &[String],
    shows: &dyn Fn(usize, usize) -> bool,
) -> Vec<ObjectShown> {
    let share = |[same, all]: [usize; 2]| same as f64 / all.max(1) as f64;
    let add = |count: &mut [usize; 2], is_same: bool| {
        count[0] += usize::from(is_same);
        count[1] += 1;
    };
    // Pixels of each object that agree, and all.
    let mut counts = vec![[0; 2]; names.len()];
    for (at, object) in right.pixels.iter().enumerate() {
        let is_shown = if is_inside(right, at) {
            shows(at, at)
        } else {
            neighbours(right, at).any(|from| shows(from, at))
        };
        add(&mut counts[*object as usize], is_shown);
    }
    let in_scene = counts.clone();
    for (at, object) in ids.iter().flat_map(|ids| ids.pixels.iter().enumerate()) {
        // A missing object reveals what is behind it.
        let is_laid_bare = share(in_scene[right.pixels[at] as usize]) < LEAST_SHOWN;
        if let Some(count) = counts.get_mut(*object as usize)
            && !is_laid_bare
        {
            let is_near = neighbours(right, at).any(|place| right.pixels[place] == *object);
            add(count, is_near);
        }
    }
    let objects = names.iter().zip(in_scene.iter().zip(&counts));
    let shown = objects.map(|(name, (in_scene, count))| ObjectShown {
        object: name.clone(),
        pixels: in_scene[1],
        shown: share(*count),
    });
    shown.filter(|object| object.pixels > 0).collect()
}
