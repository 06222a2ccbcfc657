//! Ctrl-C: every command ends within two seconds, whatever the GPU is doing.

use std::time::{Duration, Instant};

use tests::filter_folder::one_kernel_without_parameters;

use crate::sandbox::{Sandbox, assert_done, press_ctrl_c, quick_command};

/// Manifest of a filter whose passes take minutes together.
const MANIFEST: &str = r#"
name = "slow"
summary = "Takes its time."
alignment = "trailing"

[[pass]]
entry = "work"
repeat = 1000
"#;

const BODY: &str = "
    var sum = vec4<f32>(0.0);
    for (var i = 0; i < 8000; i++) {
        sum += textureLoad(color, (pixel + i) % frame.size, 0);
    }
    textureStore(output, pixel, sum / 8000.0);
";

/// Longest time from Ctrl-C to the end of the process.
const LIMIT: Duration = Duration::from_secs(2);

#[test]
fn ctrl_c_ends_work_on_the_gpu_within_two_seconds() {
    let sandbox = Sandbox::new();
    sandbox.write_filter("slow", MANIFEST, &one_kernel_without_parameters(BODY));
    // The frame and the truth are there, so that both commands soon reach the GPU.
    assert_done(&sandbox.run(&["--filters", "identity"]));
    let frame = sandbox.path("out/plate/frame.exr").display().to_string();
    let blur = [
        "engine", "blur", "--filter", "./slow", "--frame", &frame, "--out", "b.exr",
    ];
    let quick = quick_command("run", "16");
    let run = [&quick[..], &["--filter", "slow"]].concat();
    for words in [blur.to_vec(), run] {
        let mut child = sandbox.command(&words).spawn().unwrap();
        std::thread::sleep(Duration::from_secs(2));
        assert!(
            child.try_wait().unwrap().is_none(),
            "it ended by itself: {words:?}"
        );
        let pressed = Instant::now();
        press_ctrl_c(&child);
        let status = child.wait().unwrap();
        assert_eq!(status.code(), Some(130), "{words:?}");
        assert!(
            pressed.elapsed() < LIMIT,
            "{words:?}: {:?}",
            pressed.elapsed()
        );
    }
    assert!(!sandbox.path("b.exr").exists());
}
