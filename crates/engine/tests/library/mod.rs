//! The library: audits of honest and planted frames, and exported scenes played back. A part of
//! tests/scenes.

mod audit;
mod audit_self;
mod gltf;

use std::path::PathBuf;

use engine::{Capture, CaptureDescription};
use filters::Convention;
use frame::Frame;

/// Captures a frame, as an engine draws it that does nothing wrong.
fn capture(frame: Frame) -> Capture {
    Capture {
        folder: PathBuf::from("capture"),
        description: CaptureDescription {
            raw: Default::default(),
            engine: "test".to_owned(),
            scene: None,
            exposure: None,
            alignment: None,
            instant: 0.0,
            subframes: None,
            stops: None,
        },
        convention: Convention::default(),
        color: frame.color,
        lacks: Vec::new(),
        velocity: frame.velocity,
        velocity_next: None,
        velocity_z: None,
        exclusion: None,
        depth: frame.depth,
        object_id: Some(frame.object_id),
        blurred: None,
        subframes: Vec::new(),
        notes: Vec::new(),
    }
}
