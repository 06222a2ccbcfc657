//! Pictures that the program rendered and reads back: frames, truths, replicates, ladders, blurs.

use std::fs;
use std::path::{Path, PathBuf};

use filters::Convention;
use frame::{Frame, Ladder, Replicate, Truth, read_exr, read_passes};
use suite::{read_finished_picture, score};

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
