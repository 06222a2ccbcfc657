//! Scenes with very many objects, variants, keys, parents and brackets.

use std::time::{Duration, Instant};

use super::RENDER;
use crate::sandbox::{OBJ, SCENE, Sandbox, assert_refused, split, stderr};

/// Writes the plate's scene with more text after it.
fn with_more(sandbox: &Sandbox, more: &str) {
    sandbox.write("scene.toml", &format!("{SCENE}{more}"));
}

/// Writes objects with additional lines.
fn objects(count: usize, more: impl Fn(usize) -> String) -> String {
    let object = |at| format!("[object.o{at}]\nmesh = \"plate.obj\"\n{}\n", more(at));
    (0..count).map(object).collect()
}

/// Writes objects without additional lines.
fn plain(count: usize) -> String {
    objects(count, |_| String::new())
}

/// Attaches every object to the previous one, in chains of this length.
fn chained(length: usize) -> impl Fn(usize) -> String {
    move |at| match at % length {
        0 => String::new(),
        _ => format!("parent = \"o{}\"", at - 1),
    }
}

/// Runs `load`, and fails if it takes long. Each of these cases once took minutes, or grew with the square or the cube of its
/// size, and now takes about 0.2 s. The limit allows for a slow and busy machine.
#[track_caller]
fn loads_soon<T>(load: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let loaded = load();
    assert!(start.elapsed() < Duration::from_secs(60));
    loaded
}

#[test]
fn loading_time_grows_linearly_with_the_scene() {
    let sandbox = Sandbox::new();
    let load = || loads_soon(|| tracer::load_scene(sandbox.path("scenes/plate"), None)).unwrap();

    with_more(&sandbox, &objects(16_000, chained(250)));
    assert_eq!(load().objects.len(), 16_001);

    // Each of the variants changes another object.
    let variant = |at| format!("[variant.v{at}.object.o{at}]\nscale = 2\n");
    let variants: String = (0..4_000).map(variant).collect();
    with_more(&sandbox, &(plain(4_000) + &variants));
    assert_eq!(load().objects.len(), 4_001);
    let listings = loads_soon(|| tracer::list_scenes(sandbox.path("scenes")).unwrap());
    assert_eq!(listings[0].variants.len(), 4_000);

    // 30,000 groups with a material each, and 200 objects that show all of them.
    let mut obj = OBJ.replace("usemtl paint\n", "");
    let mut mtl = String::new();
    for group in 0..30_000 {
        let face = format!("usemtl m{group}\nf 1 2 {}\n", 5 + group);
        obj += &format!("v 0 0 {group}\ng g{group}\n{face}");
        mtl += &format!("newmtl m{group}\nKd 0 0 0\n");
    }
    sandbox.write("plate.obj", &obj);
    sandbox.write("plate.mtl", &mtl);
    with_more(&sandbox, &plain(200));
    assert_eq!(load().meshes.len(), 1);
}

#[test]
fn a_scene_beyond_the_limits_is_refused_with_its_line() {
    let variant = |variant| format!("[variant.v{variant}]\nexposure = 1\n");
    let key = |key| format!("{{ time = {key} }},");
    let keys: String = (0..16_385).map(key).collect();
    let sandbox = Sandbox::new();
    let refuse = |more: &str, parts: &str| {
        with_more(&sandbox, more);
        sandbox.refuse(RENDER, parts);
    };
    // Chains of parents must not be followed by recursion.
    let parts = "scene.toml:791: | object \"o257\" has 257 parents above it; allowed: 256; attach it to one nearer to the world";
    refuse(&objects(10_000, chained(10_000)), parts);
    let circle = |at| format!("parent = \"o{}\"", (at + 1) % 10_000);
    let parts = "scene.toml:22: | the parents of objects form a cycle: o0 -> o1 -> o2 -> o3 -> o4 -> o5 -> o6 -> o7 -> ... -> o9993";
    refuse(&objects(10_000, circle), parts);
    let parts = "scene.toml: | the scene has 16385 objects; allowed: 16384";
    refuse(&plain(16_384), parts);
    let parts = "scene.toml: | the scene has 4097 variants; allowed: 4096; move some to a folder of their own";
    refuse(&(0..4_097).map(variant).collect::<String>(), parts);
    let parts = "scene.toml:22: | object \"o0\" has 16385 keys; allowed: 1 to 16384";
    refuse(&objects(1, |_| format!("keys = [{keys}]")), parts);
    for text in [
        format!("a = {}", "[".repeat(200_000)),
        format!("a = {}", "{a=".repeat(200_000)),
        format!("[{}a]\n", "a.".repeat(200_000)),
        format!("{}a = 1\n", "a.".repeat(200_000)),
    ] {
        sandbox.write("scene.toml", &text);
        let parts = ["scene.toml:", "nested too deeply; allowed: up to 80"];
        sandbox.refuse(RENDER, &parts);
    }
}

#[test]
fn a_long_list_of_names_is_cut_in_messages() {
    let sandbox = Sandbox::new();
    let last = "[object.last]\nmesh = \"plate.obj\"\nparent = \"nobody\"\n";
    with_more(&sandbox, &(plain(5_000) + last));
    let output = sandbox.shuttertruth(&split(RENDER));
    assert_refused(&output, 2, &["allowed: camera, plate, o0, o1", "4961 more"]);
    assert!(stderr(&output).len() < 1_000);
}
