//! Pictures that the program rendered and reads back: frames, truths, replicates, ladders, blurs.

use std::fs;
use std::path::{Path, PathBuf};

use filters::Convention;
use frame::{ExrFile, Frame, Ladder, Replicate, Truth, read_exr, read_passes, write_exr};
use suite::{
    Monitor, TRAVERSALS, Verification, list_scene_renders, read_finished_picture, score,
    verify_scene,
};
use tracer::load_scene;

use crate::fixture::files;
use crate::place::Place;
use crate::seeds::{made, shipped};

/// Reads frames, truths and the rungs of ladders as `score` does.
pub fn exr(place: &mut Place, input: &[u8]) -> Option<()> {
    let path = place.write("input.exr", input);
    drop(read_exr(&path));
    drop(read_passes(&path));
    drop(Replicate::read(&path).map(|replicate| Truth::of(&[replicate.clone(), replicate])));
    let scene = place.copy("out").join("plate");
    let [frame, truth, ladder] = rendered_files(&scene);
    if Frame::read(&path).is_ok() {
        score_picture(&path, &truth, None, &scene);
    }
    if let Ok(read) = Truth::read(&path) {
        drop(read.noise_floors());
        drop(read.at_instant_mean());
        score_picture(&frame, &path, Some(&ladder), &scene);
    }
    let rung = ladder.join("n4.exr");
    let honest = fs::read(&rung).expect("a ladder has rungs");
    fs::write(&rung, input).unwrap();
    let scored = score_picture(&frame, &truth, Some(&ladder), &scene);
    fs::write(rung, honest).unwrap();
    scored
}

/// Returns files of every kind that a run renders.
pub fn rendered(place: &Place) -> Vec<Vec<u8>> {
    let ends = "frame.exr trailing.exr output.exr replicate_000.exr n4.exr";
    made(place, "out", &ends.split(' ').collect::<Vec<_>>())
}

/// Returns blurs and textures.
pub fn finished(place: &Place) -> Vec<Vec<u8>> {
    let textures = shipped("tests/fuzz/corpus/texture", "");
    [made(place, "out", &["output.exr"]), textures].concat()
}

/// Verifies a kept render in its own place by tracing it again: a file with other attributes is never accepted.
pub fn verify(place: &mut Place, input: &[u8]) -> Option<()> {
    let path = place.write("input.exr", input);
    let input = read_exr(&path).ok()?;
    let out = place.copy("out");
    // The file with attributes most like the input's.
    let alike = |path: &PathBuf| {
        let own = read_exr(path).unwrap().attributes.into_iter();
        let same = own.filter(|(name, value)| input.attributes.get(name) == Some(value));
        same.count()
    };
    let kept = list_kept(&out).into_iter().max_by_key(alike);
    let place_of = kept.expect("a run leaves pictures");
    let (bytes, honest) = (fs::read(&place_of).unwrap(), read_exr(&place_of).unwrap());
    fs::copy(&path, &place_of).unwrap();
    let scene = load_scene(place.copy("scenes").join("plate"), None).unwrap();
    let kept = list_scene_renders(&out, &out).unwrap();
    let verification = Verification { seed: 1, tiles: 1 };
    let verified = verify_scene(&scene, &kept[0], &verification, Monitor::SILENT);
    fs::write(place_of, bytes).unwrap();
    if verified.ok()?.differences.is_empty() {
        let own_attributes = |file: ExrFile| {
            let mut own = file.attributes;
            own.remove("checksum");
            let word = own.remove("traversal");
            assert!(word.is_some_and(|word| TRAVERSALS.contains(&&*word)));
            own
        };
        let [honest, input] = [honest, input].map(own_attributes);
        assert_eq!(honest, input, "a forged file was taken");
    }
    Some(())
}

/// Returns frames, truths, first replicates and rungs, each with a copy that claims to be an engine's.
pub fn kept(place: &Place) -> Vec<Vec<u8>> {
    let copy = place.folder.join("drawn.exr");
    let both = |path: PathBuf| {
        let mut drawn = read_exr(&path).unwrap();
        drawn.set("engine", "another");
        write_exr(&copy, &drawn).unwrap();
        [path, copy.clone()].map(|path| fs::read(path).unwrap())
    };
    let mut kept = list_kept(&place.fixture.join("out"));
    kept.retain(|path| {
        !path.to_string_lossy().contains("replicate_00") || path.ends_with("replicate_000.exr")
    });
    kept.into_iter().flat_map(both).collect()
}

/// Lists the rendered files of a run, not those of filters.
fn list_kept(out: &Path) -> Vec<PathBuf> {
    let mut found = files(&out.join("plate"), ".exr");
    found.retain(|path| {
        let path = path.to_string_lossy();
        path.ends_with("frame.exr") || path.contains("/truth_") || path.contains("/ladder_")
    });
    found
}

/// Returns the frame, the truth and the ladder's folder of a scene's folder.
fn rendered_files(scene: &Path) -> [PathBuf; 3] {
    ["frame.exr", "truth_trailing.exr", "ladder_trailing"].map(|name| scene.join(name))
}

/// Scores a picture of the run as `score` does; one of the files is foreign.
fn score_picture(frame: &Path, truth: &Path, ladder: Option<&Path>, scene: &Path) -> Option<()> {
    let (frame, truth) = (Frame::read(frame).ok()?, Truth::read(truth).ok()?);
    if frame.provenance.scene != truth.provenance.scene {
        return None;
    }
    let ladder = ladder.map(Ladder::read).transpose().ok()?;
    let pictures = files(scene, "output.exr");
    let picture = pictures.first().expect("a run leaves pictures");
    let picture = read_finished_picture(picture, &Convention::default(), &frame, &truth).ok()?;
    let scores = score(&picture, &frame, &truth, ladder.as_ref());
    scores.ok().map(drop)
}
