//! The filter that `new --from wgsl` writes, and the messages about mistakes in it.

use crate::sandbox::{Sandbox, stderr};

/// Files of the filter.
const FILES: [(&str, &str); 2] = [
    (
        "filter.toml",
        include_str!("../../examples/first_blur/wgsl/filter.toml"),
    ),
    (
        "my_blur.wgsl",
        include_str!("../../examples/first_blur/wgsl/my_blur.wgsl"),
    ),
];

/// Writes the filter, with a mistake if asked.
fn write(sandbox: &Sandbox, change: Option<&Mistake>) {
    let [manifest, kernels] = FILES.map(|(name, text)| match change {
        Some(change) if change.file == name => {
            assert!(text.contains(change.from), "{name} holds {}", change.from);
            text.replace(change.from, change.to)
        }
        _ => text.to_owned(),
    });
    sandbox.write_filter("my_blur", &manifest, &kernels);
}

/// Mistake: a file, a text and its replacement, and the program's message.
struct Mistake {
    file: &'static str,
    from: &'static str,
    to: &'static str,
    says: &'static str,
}

/// An entry point that is not there, a parameter that the shader does not have, a texture that
/// nobody provides, and a line that does not compile.
const MISTAKES: [Mistake; 4] = [
    Mistake {
        file: "filter.toml",
        from: "entry = \"blur\"",
        to: "entry = \"blurr\"",
        says: "\
error: ./my_blur/filter.toml:12: pass \"blurr\": ./my_blur/my_blur.wgsl has no such @compute entry \
point; it has: blur
",
    },
    Mistake {
        file: "filter.toml",
        from: "name = \"taps\"",
        to: "name = \"samples\"",
        says: "\
error: ./my_blur/my_blur.wgsl:2: `parameters` member 1 is `taps: i32`, but ./my_blur/filter.toml:5 \
declares `samples: i32`
",
    },
    Mistake {
        file: "my_blur.wgsl",
        from: "velocity",
        to: "motion",
        says: "\
error: ./my_blur/my_blur.wgsl:4: \"motion\" is no known input or output; uniforms: parameters, frame; \
read: color, velocity, depth, velocity_next, velocity_z, exclusion, those of the frame before as \
color_before and so on if `history` names them, or a [[texture]] by its name; written: output or a \
[[texture]] as <name>_out; textures of ./my_blur/filter.toml: none
",
    },
    Mistake {
        file: "my_blur.wgsl",
        from: "frame.exposure",
        to: "frame.exposed",
        says: "\
error: ./my_blur/my_blur.wgsl:11:23: invalid field accessor `exposed`
   ┌─ my_blur.wgsl:11:23
   │
11 │     let trail = frame.exposed * textureLoad(velocity, pixel, 0).xy;
   │                       ^^^^^^^ invalid accessor
",
    },
];

#[test]
fn the_written_filter_runs_and_beats_the_identity() {
    let sandbox = Sandbox::new();
    write(&sandbox, None);
    assert!(FILES[1].1.lines().count() <= 20);
    sandbox.measure("--filters identity --filter my_blur");
    let cases = sandbox.read_filter_cases();
    let flip = |case: usize| cases[case].scores.moving.flip.value().unwrap();
    assert_eq!(cases[1].filter, "my_blur");
    // A gather along the pixel's own velocity blurs the inside of the plate correctly, but not the
    // smear outside it: about half.
    assert!(flip(1) < 0.8 * flip(0), "{} of {}", flip(1), flip(0));
}

#[test]
fn each_mistake_is_named_with_its_place_and_what_is_allowed() {
    let sandbox = Sandbox::new();
    for mistake in &MISTAKES {
        write(&sandbox, Some(mistake));
        let output = sandbox.run(&["--filter", "my_blur"]);
        assert_eq!(stderr(&output), mistake.says);
        assert_eq!(output.status.code(), Some(2));
        assert!(!sandbox.path("out").exists());
    }
}
