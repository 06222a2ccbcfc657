//! Lengths of engines' smears, measured on the scene `sliding_panel`.

use std::cell::LazyCell;

use filters::Filter;
use tests::panel::{Mover, SMALL, Shot};
use tests::smear::{FULL_SIZE, measured_shot, smear_degrees};

use super::engines::Engine;

/// Exposure of a shutter of 180 degrees, in frames.
const HALF_FRAME: f64 = 0.5;

/// Lengths of an engine's smear of a frame's motion, in degrees: 360 are the whole frame.
#[derive(Clone, Copy, Debug)]
pub struct Lengths {
    /// With its own length.
    pub shipped: f64,
    /// With its setting of length at 180 degrees.
    pub at_180: f64,
}

/// Panels that are traced when an engine needs them.
pub struct Panels {
    small: LazyCell<Shot>,
    full: LazyCell<Shot>,
    camera: LazyCell<Shot>,
    full_camera: LazyCell<Shot>,
}

impl Panels {
    pub fn new() -> Self {
        Self {
            small: LazyCell::new(|| measured_shot(Mover::Panel, SMALL)),
            full: LazyCell::new(|| measured_shot(Mover::Panel, FULL_SIZE)),
            camera: LazyCell::new(|| measured_shot(Mover::Camera, SMALL)),
            full_camera: LazyCell::new(|| measured_shot(Mover::Camera, FULL_SIZE)),
        }
    }

    /// Measures an engine's smear with its length times `factor`.
    pub fn measure(&self, engine: &Engine, factor: f64) -> Lengths {
        let shipped = &engine.shipped;
        let shot = match (shipped.camera_moves, shipped.full_size) {
            (false, false) => &self.small,
            (false, true) => &self.full,
            (true, false) => &self.camera,
            (true, true) => &self.full_camera,
        };
        let (filter, preset) = (engine.shape.split_once(':')).expect("a preset has a filter");
        let filter = Filter::builtin(filter).expect("engines.toml names built-in filters");
        let settings = (filter.settings(Some(preset))).expect("engines.toml names presets");
        let mut shipped_settings = settings.clone();
        for (name, value) in &shipped.values {
            shipped_settings
                .set(&filter, name, value)
                .expect("engines.toml has values of parameters");
        }
        let exposure = factor * shipped.exposure;
        Lengths {
            shipped: smear_degrees(shot, &filter, &shipped_settings, exposure),
            at_180: smear_degrees(shot, &filter, &settings, factor * HALF_FRAME),
        }
    }
}
