//! Data of live cases: filters, frames, and which cases are live.

use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use filters::Filter;
use flate2::read::ZlibDecoder;
use frame::Frame;
use serde_json::Value;
use tests::text::assert_contains;

use crate::make_page;
use crate::sandbox::Sandbox;

/// Reads a list of objects.
fn list<'v>(value: &'v Value, name: &str) -> &'v [Value] {
    value[name].as_array().unwrap()
}

fn text<'v>(value: &'v Value, name: &str) -> &'v str {
    value[name].as_str().unwrap()
}

#[test]
fn the_data_of_every_built_in_filter_binds_all_that_its_kernels_declare() {
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).unwrap();
        let live = filter.live(320, false).unwrap();
        let named = |list_name| list(&live, list_name).iter().map(|item| text(item, "name"));
        let known: BTreeSet<&str> = (named("inputs").chain(named("textures")))
            .chain(["output"])
            .collect();
        let mut bound = BTreeSet::new();
        for pass in list(&live, "passes") {
            for binding in list(pass, "bindings") {
                bound.insert(binding["binding"].as_u64().unwrap());
                match text(binding, "role") {
                    "block" => assert!(!list(binding, "numbers").is_empty(), "{name}"),
                    _ => assert!(known.contains(text(binding, "resource")), "{name}"),
                }
            }
        }
        let module = &live["modules"][0];
        let whole = format!("{}\n{}", text(module, "wgsl"), text(module, "appended"));
        let declared = whole.split("@group(0) @binding(").skip(1);
        let declared = declared.map(|rest| rest.split(')').next().unwrap().parse().unwrap());
        assert_eq!(bound, declared.collect(), "{name}");
        let scaled = filter.settings(None).unwrap().scaled_to(&filter, 320);
        let values = serde_json::to_value(scaled.values).unwrap();
        assert_eq!(live["presets"][0]["values"], values, "{name}");
        assert_eq!(live["features"], serde_json::json!([]), "{name}");
    }
}

#[test]
fn a_folder_of_translated_shaders_binds_what_the_engines_own_do() {
    let folder = tests::root().join("examples/first_blur");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        // Not every machine has each language's compiler.
        let Ok(filter) = Filter::load(&entry.unwrap().path()) else {
            continue;
        };
        count += 1;
        let name = &filter.name;
        let live = filter.live(320, false).unwrap();
        let saved = tempfile::tempdir().unwrap();
        fs::write(saved.path().join("filter.toml"), text(&live, "toml")).unwrap();
        for module in list(&live, "modules")
            .iter()
            .filter(|module| module.get("file").is_some())
        {
            fs::write(
                saved.path().join(text(module, "file")),
                text(module, "wgsl"),
            )
            .unwrap();
        }
        let again = Filter::load(saved.path())
            .unwrap()
            .live(320, false)
            .unwrap();
        assert_eq!(again["presets"], live["presets"], "{name}");
        for (pass, other) in list(&live, "passes").iter().zip(list(&again, "passes")) {
            for part in ["bindings", "vertex", "targets", "stage", "workgroup"] {
                assert_eq!(pass[part], other[part], "{name}: {part}");
            }
        }
    }
    assert!(count >= 4);
}

/// Reads a file that the page loads.
fn read_file(page: &Path, name: &str) -> Value {
    let folder = page.with_file_name("a report_files");
    let text = fs::read_to_string(folder.join(format!("{name}.js"))).unwrap();
    let start = format!("shuttertruth.arrived(\"{name}\", ");
    let json = text
        .strip_prefix(&start)
        .and_then(|rest| rest.strip_suffix(");\n"));
    serde_json::from_str(json.unwrap()).unwrap()
}

/// Reads an input of a scene.
fn read_input(scene: &Value, name: &str) -> Vec<f32> {
    let packed = STANDARD.decode(text(&scene["inputs"], name)).unwrap();
    let mut bytes = Vec::new();
    ZlibDecoder::new(&packed[..])
        .read_to_end(&mut bytes)
        .unwrap();
    let floats = bytes.chunks_exact(4);
    floats
        .map(|float| f32::from_le_bytes(float.try_into().unwrap()))
        .collect()
}

/// Reads the data of the case of this name, or the reason why it is not live.
fn read_case(page: &str, case: &str) -> Result<Value, String> {
    let section = page.split(&format!("id=\"plate/{case}\"")).nth(1).unwrap();
    let section = section.split("</article>").next().unwrap();
    match section.split("data-live=\"").nth(1) {
        Some(rest) => {
            let json = rest.split('"').next().unwrap().replace("&quot;", "\"");
            Ok(serde_json::from_str(&json).unwrap())
        }
        None => Err(section.to_owned()),
    }
}

#[test]
fn filters_with_kernels_are_live_and_get_the_frame_of_the_run() {
    let sandbox = Sandbox::new();
    let body = "textureStore(output, pixel, 0.5 * textureLoad(color, pixel, 0));";
    sandbox.write_kernel("own", "", &[], body);
    sandbox.write_program("program", "cp $1 $2", "");
    sandbox.measure(
        "--filter blender:compositor,kino:default,./own,./program --set kino.samples=6 --guard-band 8 --allow-commands",
    );
    let page = make_page(&sandbox);
    let text = fs::read_to_string(&page).unwrap();
    let kino = read_case(&text, "kino:default~20samples~3d6").unwrap();
    assert_eq!(kino["parameters"]["samples"], 6);
    assert_eq!(kino["values"]["frame.size[0]"], 64.0 + 16.0);
    let measured = sandbox.read_filter_cases();
    let measured = measured.iter().find(|case| case.filter == "kino").unwrap();
    let flip = measured.measured(metrics::Metric::FLIP).value().unwrap();
    assert_eq!(kino["stored"]["flip"], flip);
    let case = read_case(&text, "own:default").unwrap();
    let filter = read_file(&page, &format!("live_filter_{}", case["filter"]));
    assert_contains(filter["modules"][0]["wgsl"].as_str().unwrap(), &[body]);
    let scene = read_file(&page, "live_scene_0");
    let frame = Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    assert_eq!(
        read_input(&scene, "velocity"),
        frame.velocity.pixels.as_flattened()
    );
    assert_eq!(
        read_input(&scene, "color"),
        frame.color.pixels.as_flattened()
    );
    assert_eq!(read_input(&scene, "depth"), frame.depth.pixels);
    assert_eq!(read_input(&scene, "velocity_next").len(), 2 * 80 * 48);
    assert_eq!(
        scene["crop"],
        serde_json::json!({"x": 8, "y": 8, "width": 64, "height": 32})
    );
    let refused = read_case(&text, "program:default").unwrap_err();
    assert_contains(
        &refused,
        &["A browser cannot run this filter: it is a program."],
    );
    let reference = read_case(&text, "accumulate:4@centred").unwrap_err();
    assert!(!reference.contains("live"), "{reference}");
}
