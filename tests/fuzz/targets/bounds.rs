//! bounds.toml, and judgements by it.

use cli::{Programs, select_filters};
use filters::Filter;
use judge::{
    check_lengths, check_names, judge, read_bounds, read_bounds_file, require_bounds,
    size_for_bounds,
};
use suite::{Frames, Run};

use super::run_json::of;
use crate::place::Place;
use crate::seeds::{Seed, read_shipped};
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// bounds.toml beside the scenes, and beside a scene.
pub static TARGET: Target = Target {
    name: "bounds",
    share: 1_300,
    batch: 500,
    shape: Shape::Text,
    tokens: tokens::BOUNDS,
    seeds: |place| {
        let mut seeds = vec![of(place, "scenes/bounds.toml")];
        seeds.extend(read_shipped("scenes", "bounds.toml").into_iter().take(8));
        seeds.extend([Seed::Made(huge::deep_toml), Seed::Made(huge::long_key)]);
        seeds
    },
    run,
};

fn run(place: &mut Place, input: &[u8]) {
    if place.filters.is_empty() {
        place.filters =
            select_filters(&Filter::builtin_names(), None, &[], Programs::Refused).unwrap();
    }
    let root = place.copy("scenes");
    let path = place.write("scenes/bounds.toml", input);
    drop(read_bounds_file(&path));
    let scene = root.join("plate");
    let beside = place.write("scenes/plate/bounds.toml", input);
    drop(read_bounds(&root, &scene, None));
    std::fs::remove_file(beside).unwrap();
    let sized = place.write("scenes/plate/bounds_16x16.toml", input);
    drop(read_bounds(&root, &scene, Some((16, 16))));
    std::fs::remove_file(sized).unwrap();
    let Ok(bounds) = read_bounds(&root, &scene, None) else {
        return;
    };
    let filters = &place.filters;
    drop(check_names(&root, std::iter::once(&bounds), filters));
    drop(require_bounds(
        &root,
        std::iter::once(("plate", &bounds)),
        filters,
        Frames::default(),
    ));
    let frames = Frames {
        count: 4,
        per_second: 60.0,
    };
    drop(check_lengths(std::iter::once(&bounds), filters, frames));
    drop(size_for_bounds(std::iter::once(&bounds), filters, None));
    drop(size_for_bounds(
        std::iter::once(&bounds),
        filters,
        Some((16, 16)),
    ));
    let measured = Run::read(&place.fixture.join("out/run.json")).unwrap();
    let bounds = (measured.cases.iter())
        .map(|case| (case.scene.clone(), bounds.clone().at((16, 16))))
        .collect();
    drop(judge(&measured, &bounds));
}
