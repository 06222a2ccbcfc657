//! Scenes with very many objects, variants, keys, parents and brackets.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use super::{assert_render_refused, render};
use crate::sandbox::{OBJ, SCENE, Sandbox, assert_refused, stderr};

/// Writes the plate's scene with more text after it.
fn with_more(sandbox: &Sandbox, more: impl FnOnce(&mut String)) {
    let mut scene = SCENE.to_owned();
    more(&mut scene);
    sandbox.write("scene.toml", &scene);
}

fn objects(scene: &mut String, count: usize, more: impl Fn(usize) -> String) {
    for object in 0..count {
        let rest = more(object);
        write!(scene, "[object.o{object}]\nmesh = \"plate.obj\"\n{rest}\n").unwrap();
    }
}

/// Runs `load`, and fails if it takes long. Each of these cases once took minutes, or grew with the square or the cube
/// of its size, and now takes about 0.2 s. The limit leaves room for a slow and busy machine.
#[track_caller]
fn loads_soon<T>(load: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let loaded = load();
    let took = start.elapsed();
    assert!(took < Duration::from_secs(60), "{took:?}");
    loaded
}

#[test]
fn loading_time_grows_linearly_with_the_scene() {
    let sandbox = Sandbox::new();
    let load = || loads_soon(|| tracer::load_scene(sandbox.path("scenes/plate"), None));

    // 16,000 objects in chains of 250.
    with_more(&sandbox, |scene| {
        objects(scene, 16_000, |object| match object % 250 {
            0 => String::new(),
            _ => format!("parent = \"o{}\"", object - 1),
        });
    });
    assert_eq!(load().unwrap().objects.len(), 16_001);

    // 4,000 variants, each of which changes another object.
    with_more(&sandbox, |scene| {
        objects(scene, 4_000, |_| String::new());
        for variant in 0..4_000 {
            write!(scene, "[variant.v{variant}.object.o{variant}]\nscale = 2\n").unwrap();
        }
    });
    assert_eq!(load().unwrap().objects.len(), 4_001);
    let listings = loads_soon(|| tracer::list_scenes(sandbox.path("scenes")).unwrap());
    assert_eq!(listings[0].variants.len(), 4_000);

    // 30,000 groups with a material each, and 200 objects that show all of them.
    let mut obj = OBJ.replace("usemtl paint\n", "");
    let mut mtl = String::new();
    for group in 0..30_000 {
        let corner = 5 + group;
        write!(
            obj,
            "v 0 0 {group}\ng g{group}\nusemtl m{group}\nf 1 2 {corner}\n"
        )
        .unwrap();
        write!(mtl, "newmtl m{group}\nKd 0 0 0\n").unwrap();
    }
    sandbox.write("plate.obj", &obj);
    sandbox.write("plate.mtl", &mtl);
    with_more(&sandbox, |scene| objects(scene, 200, |_| String::new()));
    assert_eq!(load().unwrap().meshes.len(), 1);
}

#[test]
fn a_chain_of_too_many_parents_is_refused_without_recursion() {
    let sandbox = Sandbox::new();
    with_more(&sandbox, |scene| {
        objects(scene, 10_000, |object| match object {
            0 => String::new(),
            _ => format!("parent = \"o{}\"", object - 1),
        });
    });
    let found = "object \"o257\" has 257 parents above it; allowed: 256; attach it to one nearer to the world";
    assert_render_refused(&sandbox, &["scene.toml:791:", found]);

    // All of them form one circle.
    with_more(&sandbox, |scene| {
        objects(scene, 10_000, |object| {
            format!("parent = \"o{}\"", (object + 1) % 10_000)
        });
    });
    let found = "the parents of objects form a cycle: o0 -> o1 -> o2 -> o3 -> o4 -> o5 -> o6 -> o7 -> ... -> o9993";
    assert_render_refused(&sandbox, &["scene.toml:22:", found]);
}

#[test]
fn too_many_objects_variants_or_keys_are_refused() {
    let sandbox = Sandbox::new();
    with_more(&sandbox, |scene| objects(scene, 16_384, |_| String::new()));
    let found = "the scene has 16385 objects; allowed: 16384";
    assert_render_refused(&sandbox, &["scene.toml:", found]);

    with_more(&sandbox, |scene| {
        for variant in 0..4_097 {
            write!(scene, "[variant.v{variant}]\nexposure = 1\n").unwrap();
        }
    });
    let found = "the scene has 4097 variants; allowed: 4096; move some to a folder of their own";
    assert_render_refused(&sandbox, &["scene.toml:", found]);

    let mut keys = String::new();
    for key in 0..16_385 {
        write!(keys, "{{ time = {key} }},").unwrap();
    }
    with_more(&sandbox, |scene| {
        objects(scene, 1, |_| format!("keys = [{keys}]"));
    });
    let found = "object \"o0\" has 16385 keys; allowed: 1 to 16384";
    assert_render_refused(&sandbox, &["scene.toml:22:", found]);
}

#[test]
fn a_long_list_of_names_is_cut_in_messages() {
    let sandbox = Sandbox::new();
    with_more(&sandbox, |scene| {
        objects(scene, 5_000, |_| String::new());
        *scene += "[object.last]\nmesh = \"plate.obj\"\nparent = \"nobody\"\n";
    });
    let output = render(&sandbox);
    assert_refused(&output, 2, &["allowed: camera, plate, o0, o1", "4961 more"]);
    assert!(stderr(&output).len() < 1_000);
}

#[test]
fn a_deeply_nested_text_is_refused() {
    let sandbox = Sandbox::new();
    for text in [
        format!("a = {}", "[".repeat(200_000)),
        format!("a = {}", "{a=".repeat(200_000)),
        format!("[{}a]\n", "a.".repeat(200_000)),
        format!("{}a = 1\n", "a.".repeat(200_000)),
    ] {
        sandbox.write("scene.toml", &text);
        assert_render_refused(
            &sandbox,
            &["scene.toml:", "nested too deeply; allowed: up to 80"],
        );
    }
}
