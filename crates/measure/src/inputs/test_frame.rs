//! A small frame for tests of input forms.

use frame::{Display, FAR_DEPTH, Frame, FrameOptions, Provenance, Raster, Reprojection};

/// Makes an empty black frame.
pub(crate) fn test_frame(width: u32, height: u32) -> Frame {
    Frame {
        provenance: Provenance::default(),
        exposure: 1.0,
        frames_per_second: None,
        options: FrameOptions::default(),
        guard_band: 0,
        reprojection: Reprojection::STILL,
        camera: None,
        display: Display::default(),
        objects: vec!["background".to_owned()],
        color: Raster::filled(width, height, [0.0; 3]),
        velocity: Raster::filled(width, height, [0.0; 2]),
        velocity_next: None,
        velocity_z: None,
        depth: Raster::filled(width, height, FAR_DEPTH),
        object_id: Raster::filled(width, height, 0),
        coverage: vec![Raster::filled(width, height, 1.0)],
        samples: None,
    }
}
