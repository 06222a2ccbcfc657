//! Ctrl-C: every command ends within two seconds, whatever the GPU is doing.

use std::time::{Duration, Instant};

use tests::filter_folder::one_kernel_without_parameters;

use crate::sandbox::{Sandbox, press_ctrl_c, quick_command, split, wait_until_busy};

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

#[test]
fn ctrl_c_ends_work_on_the_gpu_within_two_seconds() {
    // The frame and the truth are there, so that both commands soon reach the GPU.
    let sandbox = Sandbox::measured();
    sandbox.write_filter("slow", MANIFEST, &one_kernel_without_parameters(BODY));
    let blur = split("engine blur --filter ./slow --frame out/plate/frame.exr --out b.exr");
    let run = [&quick_command("run", "16")[..], &["--filter", "slow"]].concat();
    for words in [blur, run] {
        let mut child = sandbox.command(&words).spawn().unwrap();
        // Neither command takes half of this without the kernel.
        wait_until_busy(&mut child, 150);
        let pressed = Instant::now();
        press_ctrl_c(&child);
        let status = child.wait().unwrap();
        assert_eq!(status.code(), Some(130), "{words:?}");
        let took = pressed.elapsed();
        assert!(took < Duration::from_secs(2), "{words:?}: {took:?}");
    }
    assert!(!sandbox.path("b.exr").exists());
}
