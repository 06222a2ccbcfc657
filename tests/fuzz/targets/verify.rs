//! Kept renders of a scene that is traced again: a file with other attributes is never taken.

use std::fs;

use frame::read_exr;
use suite::{Monitor, TRAVERSALS, Verification, list_scene_renders, verify_scene};
use tracer::load_scene;

use super::none;
use crate::fixture::files;
use crate::seeds::Seed;
use crate::target::{Shape, Target};

/// Frames, truths, replicates and rungs of the fixture's scene, each in its own place, with right checksums.
pub static TARGET: Target = Target {
    name: "verify",
    share: 150,
    batch: 25,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |place| {
        let found = files(&place.fixture.join("out/plate"), ".exr");
        let found = found.iter().filter(|path| is_kept(&path.to_string_lossy()));
        let honest = found.map(|path| (path, read_exr(path).unwrap()));
        honest
            .flat_map(|(path, honest)| {
                let mut drawn = honest;
                drawn.set("engine", "another");
                let copy = place.folder.join("drawn.exr");
                frame::write_exr(&copy, &drawn).unwrap();
                [path, &copy].map(|path| Seed::Bytes(fs::read(path).unwrap()))
            })
            .collect()
    },
    run: |place, input| {
        let path = place.write("input.exr", input);
        let Ok(input) = read_exr(&path) else {
            return;
        };
        let out = place.copy("out");
        let kept = files(&out.join("plate"), ".exr");
        let kept = kept.iter().filter(|path| is_kept(&path.to_string_lossy()));
        // The file whose attributes are most like those of the input.
        let alike = |path: &&std::path::PathBuf| {
            let own = read_exr(path).unwrap().attributes;
            own.iter()
                .filter(|(name, value)| input.attributes.get(*name) == Some(value))
                .count()
        };
        let place_of = kept.max_by_key(alike).expect("a run leaves pictures");
        let (bytes, honest) = (fs::read(place_of).unwrap(), read_exr(place_of).unwrap());
        fs::copy(&path, place_of).unwrap();
        let scenes = place.copy("scenes");
        let scene = load_scene(scenes.join("plate"), None).unwrap();
        let kept = list_scene_renders(&out, &out).unwrap();
        let verification = Verification { seed: 1, tiles: 1 };
        let verified = verify_scene(&scene, &kept[0], &verification, Monitor::SILENT);
        fs::write(place_of, bytes).unwrap();
        if verified.is_ok_and(|own| own.differences.is_empty()) {
            let all = [honest, input].map(|file| {
                let mut own = file.attributes;
                own.remove("checksum");
                let word = own.remove("traversal");
                assert!(word.is_some_and(|word| TRAVERSALS.contains(&&*word)));
                own
            });
            assert_eq!(all[0], all[1], "a forged file was taken");
        }
    },
};

/// Tells whether a file is rendered, and not made by a filter.
fn is_kept(path: &str) -> bool {
    path.ends_with("frame.exr") || path.contains("/truth_") || path.contains("/ladder_")
}
