//! Refused command lines: their messages, their exit codes, and no files left behind.

use std::fs;

use tests::filter_folder::one_kernel_without_parameters;

use crate::sandbox::{
    OBJ, SCENE, Sandbox, assert_done, assert_refused, files_below, press_ctrl_c, split,
};

#[test]
fn a_missing_adapter_gives_exit_code_3_and_the_way_out() {
    let sandbox = Sandbox::new();
    let output = sandbox
        .command(&["run", "--out", "out"])
        .env("VK_DRIVER_FILES", "/no/driver.json")
        .env("VK_ICD_FILENAMES", "/no/driver.json")
        .output()
        .unwrap();
    assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
    assert!(!sandbox.path("out").exists());
}

#[test]
fn bad_arguments_are_refused_with_the_allowed_values() {
    let sandbox = Sandbox::new();
    let rows: &[(&[&str], &[&str])] = &[
        (
            &["--scenes", "plates"],
            &["no scene \"plates\"", "did you mean plate?"],
        ),
        (&["--scenes", "plate@fast"], &["fast"]),
        (
            &["--scenes", "plate,plate"],
            &["plate is named twice", "each name once"],
        ),
        (
            &["--scenes", "plate,./scenes/plate"],
            &["plate is named twice", "./scenes/plate"],
        ),
        (
            &["--filters", "identity,identity:default"],
            &["identity:default is named twice"],
        ),
        (&["--filters", "jumpflood"], &["jumpflood", "jump_flood"]),
        (&["--filters", "no/such/folder"], &["no/such/folder"]),
        (&["--filters", "jump_flood:fastest"], &["fastest", "paper"]),
        (&["--set", "jump_flood.sample=3"], &["sample", "samples"]),
        (&["--set", "jump_flood.samples=many"], &["samples", "many"]),
        (
            &["--set", "jump_flood.samples=1000000"],
            &["samples", "1000000"],
        ),
        (&["--set", "samples=3"], &["filter.parameter=value"]),
        (
            &["--set", "bokeh.samples=3"],
            &["no filter \"bokeh\" takes part"],
        ),
        (
            &["--exposure", "0"],
            &["exposure is 0 frames", "allowed: above 0"],
        ),
        (&["--exposure=-0.5"], &["exposure is -0.5 frames"]),
        (&["--samples-per-pixel", "100"], &["100", "allowed"]),
        (
            &["--threads", "0"],
            &["'0' for '--threads <N>'", "1..=1024"],
        ),
        (
            &["--velocity", "backwards"],
            &["backwards", "instantaneous, previous_frame, camera_only"],
        ),
        (&["--size", "10"], &["WIDTHxHEIGHT"]),
        (&["--size=-1"], &["'-1' for '--size <WxH>'", "WIDTHxHEIGHT"]),
        (
            &["--samples-per-pixel=-8"],
            &["'-8' for '--samples-per-pixel <N>'", "invalid digit"],
        ),
        (
            &["--seed", "1e9"],
            &["'1e9' for '--seed <S>'", "invalid digit"],
        ),
        (&["--exposure", "half"], &["invalid float literal"]),
        (
            &["--guard-band", "1000000000"],
            &["2000000320", "allowed: 1 to 16384"],
        ),
        (
            &["--scenes", "plate,"],
            &["--scenes: one of its names is empty"],
        ),
        (&["--filter", ""], &["--filter: one of its names is empty"]),
        (&["--html", "scenes"], &["--html: scenes is a folder"]),
        (&["--scenes-dir", "nowhere"], &["nowhere"]),
    ];
    for (more, parts) in rows {
        let words = [&["run", "--quiet", "--out", "out"], *more].concat();
        assert_refused(&sandbox.shuttertruth(&words), 2, parts);
        assert!(
            !sandbox.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    fs::write(sandbox.path("file"), "no folder").unwrap();
    for out in ["file", "file/below"] {
        let words = ["run", "--quiet", "--filter", "identity", "--out", out];
        let parts = ["file: is a file, where the output folder is to be"];
        assert_refused(&sandbox.shuttertruth(&words), 2, &parts);
    }
    for command in [&["run"][..], &["truths", "render"]] {
        let before = files_below(&sandbox.path("scenes"));
        let words = [command, &["--quiet", "--out", "scenes"]].concat();
        assert_refused(
            &sandbox.shuttertruth(&words),
            2,
            &["scenes/plate holds a scene"],
        );
        assert_eq!(files_below(&sandbox.path("scenes")), before, "{command:?}");
    }
    assert_refused(
        &sandbox.shuttertruth(&[]),
        2,
        &["Usage: shuttertruth [OPTIONS] <COMMAND>"],
    );
}

#[test]
fn a_bad_scene_is_refused_with_file_and_line_and_leaves_nothing_behind() {
    let scene = |from: &str, to: &str| {
        assert!(SCENE.contains(from), "the scene has no \"{from}\"");
        ("scene.toml", SCENE.replace(from, to))
    };
    let obj = |from: &str, to: &str| ("plate.obj", OBJ.replacen(from, to, 1));
    let rows: Vec<((&str, String), &[&str])> = vec![
        (
            scene("family", "familiar = 3\nfamily"),
            &["scene.toml:2:", "familiar"],
        ),
        (scene("plate.obj", "plane.obj"), &["plane.obj"]),
        (
            ("plate.obj", "# nothing\n".into()),
            &["plate.obj: holds no faces"],
        ),
        (
            obj("v 0.5 -0.5 0", "v 0.5 nan 0"),
            &["plate.obj:3:", "allowed"],
        ),
        (obj("f 1 3 4", "f 1 3 9"), &["plate.obj:8:", "9", "4"]),
        (
            scene("keys = [", "rotation = [0, 0, 0, 0]\nunused = ["),
            &["scene.toml:"],
        ),
        (
            scene(
                "translation = [0, 0, 0] },",
                "translation = [0, 0, 0], rotation = [0, 0, 0, 0] },",
            ),
            &["scene.toml:18:", "which has no length"],
        ),
        (scene("time = -1", "time = 2"), &["scene.toml:", "time"]),
        (
            scene("exposure = 0.5", "exposure = -0.5"),
            &["scene.toml:3:", "-0.5", "above 0"],
        ),
        (
            scene("look_at = [0, 0, 0]", "look_at = [0, 0, 4]"),
            &["scene.toml:", "look_at"],
        ),
        (
            scene("vertical_fov = 60.0", "vertical_fov = 180.0"),
            &["scene.toml:9:", "180"],
        ),
    ];
    for ((name, text), parts) in rows {
        let sandbox = Sandbox::new();
        sandbox.write(name, &text);
        let output = sandbox.run(&["--filters", "identity"]);
        assert_refused(&output, 2, parts);
        assert!(
            !sandbox.path("out").exists(),
            "{parts:?} left something behind"
        );
    }
}

#[test]
fn bounds_of_an_unknown_metric_are_refused() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.0001);
    assert_done(&sandbox.run(&["--filters", "identity"]));
    assert_eq!(sandbox.read_findings().len(), 1);
    sandbox.write(
        "bounds.toml",
        "[default]\nflip = { limit = 0.1, why = \"it serves a test\" }\n",
    );
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    let output = sandbox.run(&["--filters", "identity"]);
    assert_refused(
        &output,
        2,
        &["bounds.toml:2", "metric \"flip\" is unknown", "flip_moving"],
    );
    assert!(!sandbox.path("out").exists());
}

#[test]
fn ctrl_c_leaves_no_partial_file() {
    let sandbox = Sandbox::new();
    // Far more samples than the program can render before the interrupt.
    let mut child = sandbox
        .command(&split(
            "truths render --quiet --out out --size 1024x512 --samples-per-pixel 65536",
        ))
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    press_ctrl_c(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let out = sandbox.path("out");
    let mut left = if out.exists() {
        files_below(&out)
    } else {
        Vec::new()
    };
    // Empty; the next process locks it.
    left.retain(|path| !path.ends_with(".shuttertruth.lock"));
    assert!(left.is_empty(), "left behind: {left:?}");
}

#[test]
fn names_that_no_folder_can_have_are_refused_before_anything_is_rendered() {
    let sandbox = Sandbox::new();
    let long = "n".repeat(250);
    let (manifest, kernels) = (
        "summary = \"It copies.\"\nalignment = \"trailing\"\n[[pass]]\nentry = \"work\"\n",
        one_kernel_without_parameters("textureStore(output, pixel, textureLoad(color, pixel, 0));"),
    );
    sandbox.write_filter(&long, &format!("name = \"{long}\"\n{manifest}"), &kernels);
    sandbox.copy_scene(&long, |text| text.replace("-1.6", "-0.8"));
    let filter = format!("./{long}");
    for words in [
        &["run", "--filter", &filter, "--scenes", "plate"][..],
        &["run", "--filter", "identity", "--scenes", &long],
        &["check", "--filter", "identity", "--scenes", &long],
        &["truths", "render", "--scenes", &long],
    ] {
        sandbox.write_bound(1.0);
        sandbox.copy_bound(&long);
        let output = sandbox.outside_ci(words);
        let parts = [
            "folder \"nnnnnn",
            "allowed: up to 240",
            "give them shorter ones",
        ];
        assert_refused(&output, 2, &parts);
        assert!(!sandbox.path("out").exists(), "{words:?}");
    }
}
