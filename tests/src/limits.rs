//! Limits derived from sound filters.

use std::fs;

use gate::calibrate;
use judge::{SceneBounds, read_bounds_file};
use measure::Run;
use metrics::Metric;
use scene::SceneId;

/// Makes the bounds of a scene that `calibrate` proposes after several runs of sound filters.
pub fn calibrate_scene(runs: &[Run], metrics: &[Metric], scene: &SceneId) -> SceneBounds {
    assert!(!metrics.is_empty(), "limits are for metrics");
    let none = SceneBounds::default();
    let calibration = calibrate(runs, |_| &none, metrics);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bounds.toml");
    fs::write(&path, calibration.toml(scene)).unwrap();
    SceneBounds {
        files: vec![read_bounds_file(&path).unwrap()],
    }
}
