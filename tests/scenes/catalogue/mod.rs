//! Proofs that each scene of the catalogue exposes its cause: a filter that fails is clearly worse
//! there than in the variant without it.
//!
//! Renders are small, so speeds in pixels are a quarter of those in the scenes' files.

mod limits;
mod rendered_scene;

use std::collections::BTreeMap;

use rendered_scene::{RenderedScene, small_settings};
use serde::Deserialize;

/// A row of `proofs.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    scene: String,
    filter: String,
    score: String,
    above: Option<f64>,
    below: Option<f64>,
    /// Variant or filter whose score is the unit.
    of: Option<String>,
    /// Score that was measured, in the same unit.
    measured: f64,
}

#[derive(Deserialize)]
struct Proofs {
    proof: Vec<Proof>,
}

impl Proof {
    /// Name of the scene without variants.
    fn base(&self) -> &str {
        self.scene.split('@').next().expect("a first part")
    }

    fn assert_holds(&self, scenes: &mut BTreeMap<String, RenderedScene>) {
        let mut score = |scene: String, filter: &str| {
            let rendered = (scenes.entry(scene)).or_insert_with_key(|name| render(name));
            rendered.score(filter, &self.score)
        };
        let value = score(self.scene.clone(), &self.filter);
        let unit = match self.of.as_deref() {
            None => 1.0,
            Some(variant) if variant.starts_with('@') => {
                score(format!("{}{variant}", self.base()), &self.filter)
            }
            Some(filter) => score(self.scene.clone(), filter),
        };
        let times = value / unit;
        println!("{self:?}: {value:.4}, {times:.2}; once {}", self.measured);
        let holds = match (self.above, self.below) {
            (Some(least), None) => times > least,
            (None, Some(most)) => times < most,
            _ => panic!("{self:?}: needs one of above and below"),
        };
        assert!(holds, "{self:?}: {times}");
    }
}

fn render(name: &str) -> RenderedScene {
    let mut settings = small_settings();
    if name.starts_with("shallow_focus") {
        // The noise of its lens.
        settings.samples_per_pixel = 256;
    }
    RenderedScene::with_settings(name, settings)
}

/// Proves all rows of the scenes with chosen names.
fn prove_scenes(is_chosen: impl Fn(&str) -> bool) {
    let proofs: Proofs = toml::from_str(include_str!("proofs.toml")).unwrap();
    let mut proofs = proofs.proof;
    proofs.retain(|proof| is_chosen(proof.base()));
    for rows in proofs.chunk_by(|one, other| one.base() == other.base()) {
        let mut scenes = BTreeMap::new();
        for proof in rows {
            proof.assert_holds(&mut scenes);
        }
    }
}

/// Scene whose rows each `make test` proves: above and below a number, of a variant and plain.
const QUICK: &str = "ramp_floor";

#[test]
fn a_filter_fails_at_the_cause_that_a_scene_exposes() {
    prove_scenes(|scene| scene == QUICK);
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn filters_fail_at_the_cause_that_each_scene_exposes() {
    prove_scenes(|scene| scene != QUICK);
}

/// Asserts that a score is at least a multiple of the score without the cause, and prints both.
fn assert_worse(what: &str, [there, without]: [f64; 2], times: f64) {
    println!("{what}: {there:.4}, without the cause {without:.4}");
    let is_worse = there > times * without;
    assert!(is_worse, "{what}: {there} is not {times} times {without}");
}
