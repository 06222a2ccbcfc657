//! Ctrl-C: every command ends within two seconds, even during GPU work.

use crate::child::{assert_ends_at_ctrl_c, wait_until_busy};
use crate::sandbox::{Sandbox, quick_command, split};

/// Many passes that together take minutes.
const PASSES: &str = "[[pass]]\nentry = \"work\"\nrepeat = 1000";

const BODY: &str = "
    var sum = vec4<f32>(0.0);
    for (var i = 0; i < 8000; i++) {
        sum += textureLoad(color, (pixel + i) % frame.size, 0);
    }
    textureStore(output, pixel, sum / 8000.0);
";

#[test]
fn ctrl_c_ends_work_on_the_gpu_within_two_seconds() {
    // The frame and the truth exist, so that both commands soon reach the GPU.
    let sandbox = Sandbox::measured();
    sandbox.write_kernel("slow", PASSES, &[], BODY);
    let blur = split("engine blur --filter ./slow --frame out/plate/frame.exr --out b.exr");
    let run = [&quick_command("run", "16")[..], &["--filter", "slow"]].concat();
    for words in [blur, run] {
        println!("{words:?}");
        let mut child = sandbox.command(&words).spawn().unwrap();
        // Without the kernel, neither command takes half of this time.
        wait_until_busy(&mut child, 80);
        assert_ends_at_ctrl_c(child);
    }
    assert!(!sandbox.path("b.exr").exists());
}
