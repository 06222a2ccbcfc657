//! Pictures that the program rendered and reads again: frames, truths, replicates, ladders, blurs.

use std::fs;
use std::path::{Path, PathBuf};

use filters::Convention;
use frame::{Frame, Ladder, Replicate, Truth, read_exr};
use suite::{merge, read_finished_picture, score};

use super::none;
use crate::fixture::files;
use crate::huge;
use crate::seeds::{Seed, read_shipped};
use crate::target::{Shape, Target};

/// Frames, truths and ladders, as `score` reads them.
pub static EXR: Target = Target {
    name: "exr",
    share: 800,
    batch: 100,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |place| {
        let out = place.fixture.join("out");
        let mut seeds = Vec::new();
        for end in [
            "frame.exr",
            "trailing.exr",
            "output.exr",
            "replicate_0000.exr",
        ] {
            let found = files(&out, end);
            seeds.extend(
                found
                    .iter()
                    .map(|path| Seed::Bytes(fs::read(path).unwrap())),
            );
        }
        seeds.push(Seed::Made(huge::exr_that_boasts));
        seeds
    },
    run: |place, input| {
        let path = place.write("input.exr", input);
        drop(read_exr(&path));
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
        if Ladder::read(&path).is_ok() {
            score_picture(&frame, &truth, Some(&path), &scene);
        }
    },
};

/// Pictures of other programs.
pub static PICTURE: Target = Target {
    name: "picture",
    share: 500,
    batch: 100,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |place| {
        let pictures = files(&place.fixture.join("out"), "output.exr");
        let mut seeds: Vec<Seed> = (pictures.iter())
            .map(|path| Seed::Bytes(fs::read(path).unwrap()))
            .collect();
        seeds.extend(read_shipped("tests/fuzz/corpus/texture", ""));
        seeds
    },
    run: |place, input| {
        let scene = place.copy("out").join("plate");
        let [frame, truth, _] = rendered_files(&scene).map(PathBuf::from);
        let end = match input.starts_with(b"\x89PNG") {
            true => "png",
            false => "exr",
        };
        let path = place.write(&format!("picture.{end}"), input);
        let (Ok(frame), Ok(truth)) = (Frame::read(&frame), Truth::read(&truth)) else {
            unreachable!("the fixture can be read");
        };
        if let Ok(picture) = read_finished_picture(&path, &Convention::default(), &frame, &truth) {
            drop(score(&picture, &frame, &truth, None));
        }
    },
};

/// Replicates that `merge` joins.
pub static MERGE: Target = Target {
    name: "merge",
    share: 300,
    batch: 100,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |place| {
        let replicates = files(&place.fixture.join("out"), ".exr");
        let seeds = (replicates.iter())
            .filter(|path| path.to_string_lossy().contains("replicate_"))
            .map(|path| Seed::Bytes(fs::read(path).unwrap()));
        seeds.take(4).collect()
    },
    run: |place, input| {
        let part = place.copy("out");
        let replicates = files(&part, ".exr");
        let one = (replicates.iter())
            .find(|path| path.to_string_lossy().contains("replicate_"))
            .expect("a run leaves replicates");
        fs::write(one, input).unwrap();
        let out = place.folder.join("merged");
        drop(merge(&[part], &out));
        let _ = fs::remove_dir_all(out);
    },
};

/// Returns the frame, the truth and the ladder's folder of a scene's folder.
fn rendered_files(scene: &Path) -> [PathBuf; 3] {
    ["frame.exr", "truth_trailing.exr", "ladder_trailing"].map(|name| scene.join(name))
}

/// Scores a picture of the run as `score` does; one of the files is foreign.
fn score_picture(frame: &Path, truth: &Path, ladder: Option<&Path>, scene: &Path) {
    let (Ok(frame), Ok(truth)) = (Frame::read(frame), Truth::read(truth)) else {
        return;
    };
    if frame.provenance.scene != truth.provenance.scene {
        return;
    }
    let ladder = ladder.map(Ladder::read).transpose();
    let pictures = files(scene, "output.exr");
    let picture = pictures.first().expect("a run leaves pictures");
    if let (Ok(ladder), Ok(picture)) = (
        ladder,
        read_finished_picture(picture, &Convention::default(), &frame, &truth),
    ) {
        drop(score(&picture, &frame, &truth, ladder.as_ref()));
    }
}
