//! Targets: everything that the program reads.

mod commands;
mod engine;
mod filter;
mod pictures;
mod planted;
mod program;
mod scene;

use report::{TuneFolder, tuning_page};
use tune::Journal;

use crate::seeds::{made, shipped};
use crate::target::Shape::{Bytes, CommandLine, Picture, Spirv, Text};
use crate::target::Target;

/// All targets.
pub static ALL: [Target; 28] = [
    Target::new("scene", 3_500, Text("scene"), |place, input| {
        scene::load(place, "scene.toml", input).map(drop)
    })
    .seeds(scene::shipped_scenes),
    // Builds the tree as well.
    Target::new("obj", 1_500, Text("model"), |place, input| {
        scene::load(place, "mesh.obj", input).map(scene::render_few_pixels)
    })
    .seeds(|place| made(place, "square", &["mesh.obj"])),
    Target::new("mtl", 1_500, Text("model"), |place, input| {
        scene::load(place, "mesh.mtl", input).map(drop)
    })
    .seeds(|place| made(place, "square", &["mesh.mtl"])),
    Target::new("import", 400, Text("model"), commands::read)
        .seeds(|_| shipped("tests/fuzz/corpus/obj", "")),
    Target::new("render", 800, Text("scene"), |place, input| {
        scene::load(place, "scene.toml", input).map(scene::render_few_pixels)
    })
    .seeds(|place| made(place, "square", &["scene.toml"])),
    Target::new("texture", 1_500, Picture, |place, input| {
        scene::load(place, "dots.png", input).map(drop)
    })
    .seeds(|place| made(place, "square", &["dots.png"])),
    Target::new("sky_hdr", 600, Bytes, |place, input| {
        scene::load_sky(place, "sky.hdr", input)
    })
    .seeds(|place| made(place, "square", &["sky.hdr"])),
    Target::new("sky_exr", 600, Picture, |place, input| {
        scene::load_sky(place, "sky.exr", input)
    })
    .seeds(|place| made(place, "out", &["frame.exr"])),
    Target::new("exr", 800, Picture, pictures::exr).seeds(pictures::rendered),
    Target::new("merge", 300, Picture, commands::read).seeds(commands::replaced),
    Target::new("picture", 500, Picture, |place, input| {
        let file = match input.starts_with(b"\x89PNG") {
            true => "picture.png",
            false => "picture.exr",
        };
        let rendered = "--truth out/plate/truth_trailing.exr --frame out/plate/frame.exr";
        let line = format!("score {rendered} --image {file}");
        commands::run(place, file, input, &[line])
    })
    .seeds(pictures::finished),
    Target::new("capture", 300, Text("capture"), engine::capture),
    Target::new("ingested", 300, Text("json"), engine::ingested),
    Target::new("filter", 2_000, Text("filter"), filter::manifest)
        .seeds(|_| shipped("shaders", "filter.toml")),
    Target::new("wgsl", 1_200, Text("wgsl"), filter::wgsl).seeds(filter::kernels),
    Target::new("kernels", 150, Text("wgsl"), |place, input| {
        let filter = filter::write(place, input).display().to_string();
        place.copy("out");
        let out = "--out blurred.exr --exposure 0.5";
        let line = format!("engine blur --filter {filter} --frame out/plate/frame.exr {out}");
        program::run_line(place, &line);
        Some(())
    })
    .seeds(filter::kernels),
    Target::new("spirv", 2_000, Spirv, filter::spirv),
    Target::new("includes", 200, Text("includes"), filter::includes),
    Target::new("run_json", 600, Text("json"), commands::read).seeds(commands::replaced),
    Target::new("baseline", 450, Text("json"), commands::read).seeds(commands::replaced),
    Target::new("bench_json", 150, Text("json"), commands::read).seeds(commands::replaced),
    Target::new("judgement", 250, Text("json"), commands::read).seeds(commands::replaced),
    Target::new("bounds", 650, Text("bounds"), commands::read).seeds(|place| {
        let mut all = commands::replaced(place);
        all.extend(shipped("scenes", "bounds.toml").into_iter().take(8));
        all
    }),
    Target::new("journal", 700, Text("json"), |place, input| {
        let folder = place.copy("tuned");
        let journal = place.write("tuned/journal.jsonl", input);
        drop(TuneFolder::read(&folder).map(|folder| tuning_page(&folder)));
        // The same command again, which continues the journal.
        let original = TuneFolder::read(&place.fixture.join("tuned")).unwrap();
        let header = original.header.expect("a tuning has a journal");
        Journal::open(&journal, &header).ok().map(drop)
    })
    .seeds(|place| made(place, "tuned", &["journal.jsonl"])),
    Target::new("tune_json", 450, Text("json"), commands::read).seeds(commands::replaced),
    Target::new("records", 50, Text("json"), program::records).seeds(|place| {
        made(
            place,
            "out",
            &["paper/case.json", "departure/case.json", "frame.json"],
        )
    }),
    Target::new("command_line", 350, CommandLine, program::command_line),
    Target::new("planted", 0, Bytes, planted::fail),
];
