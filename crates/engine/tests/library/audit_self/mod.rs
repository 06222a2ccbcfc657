//! Audits of consecutive frames without a scene: right velocity carries, and planted mistakes are
//! found with their size.

mod explore;

use std::path::PathBuf;

use engine::{Capture, CaptureDescription, RegionAudit, SequenceAudit, Verdict, audit_frames};
use filters::Convention;
use frame::{Vectors, VelocityKind};
use scene::Scene;
use tests::unwatched;
use tracer::{RenderSettings, trace_frame};

use crate::load_shipped;

/// Settings of an engine's output, with noise of its own in every frame.
fn settings(size: [u32; 2], seed: u64) -> RenderSettings {
    let mut settings = tests::settings_of(size, 16, 1);
    settings.options.velocity = VelocityKind::PreviousFrame;
    settings.seed = seed;
    settings
}

/// Captures the scene as an engine draws it some frames after the instant.
fn draw(scene: &Scene, size: [u32; 2], time: f64, seed: u64) -> Capture {
    let seed = 1000 * seed + (100.0 + time) as u64;
    let scene = scene.clone().later_by(time);
    let frame = trace_frame(&scene, &settings(size, seed), &unwatched).unwrap();
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

/// Draws frames that end at the instant.
fn draw_frames(name: &str, size: [u32; 2], count: u32, seed: u64) -> Vec<Capture> {
    let scene = load_shipped(name);
    let times = (0..count).map(|index| f64::from(index) - f64::from(count - 1));
    times.map(|time| draw(&scene, size, time, seed)).collect()
}

fn audit(frames: &[Capture]) -> SequenceAudit {
    let mut read = |index: usize| Ok(frames[index].clone());
    audit_frames(frames.len(), &mut read, &mut |_, _| Ok(())).unwrap()
}
