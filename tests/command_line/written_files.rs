//! Files that a run writes into its folder: by one process at a time, whole, and as the umask says.

use std::fs::{self, File};
use std::process::Command;

use frame::{read_exr, write_exr};
use tests::text::assert_contains;

use crate::sandbox::{IDENTITY, Sandbox, quick_command, stderr};

const RUN: &str = "--filters identity";

/// A lock of the test is that of another process.
#[test]
fn a_folder_has_one_writer_at_a_time() {
    let sandbox = Sandbox::measured();
    let lock = File::options()
        .write(true)
        .open(sandbox.path("out/.shuttertruth.lock"))
        .unwrap();
    lock.try_lock().unwrap();
    let line = quick_command("run", "16").join(" ");
    let parts = [
        "another shuttertruth is writing to out",
        "take another output folder",
    ];
    sandbox.refuse(&format!("{line} {RUN}"), &parts);
    drop(lock);
    sandbox.measure(RUN);
}

#[test]
fn what_a_killed_run_left_half_written_is_removed() {
    let sandbox = Sandbox::measured();
    let left = ["out", "out/plate", "out/plate/identity_default"]
        .map(|folder| format!("{folder}/.shuttertruth-dead.tmp"));
    for file in &left {
        sandbox.put(file, "half a pic");
    }
    sandbox.measure(RUN);
    for file in &left {
        assert!(!sandbox.path(file).exists(), "{file} is still there");
    }
}

#[cfg(unix)]
#[test]
fn the_umask_says_who_may_read_what_is_written() {
    use std::os::unix::fs::PermissionsExt;
    let sandbox = Sandbox::new();
    let run = sandbox.command(&[&quick_command("run", "16")[..], &IDENTITY].concat());
    let mut shell = Command::new("sh");
    shell.args(["-c", "umask 027; exec \"$0\" \"$@\""]);
    shell.arg(run.get_program()).args(run.get_args());
    let status = shell.current_dir(sandbox.path("")).status().unwrap();
    assert!(status.success());
    for name in ["run.json", "report.html", "plate/frame.exr"] {
        let file = fs::metadata(sandbox.path("out").join(name)).unwrap();
        assert_eq!(file.permissions().mode() & 0o777, 0o640, "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    let sandbox = Sandbox::new();
    let mut list = sandbox.command(&["list"]);
    let full = File::options().write(true).open("/dev/full").unwrap();
    let output = list.stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_contains(&stderr(&output), &["standard output: cannot write"]);
}

#[test]
fn a_truth_with_a_nan_or_without_a_channel_is_rendered_again() {
    let sandbox = Sandbox::measured();
    let path = sandbox.path("out/plate/truth_trailing.exr");
    let whole = fs::read(&path).unwrap();
    for with_nan in [true, false] {
        let mut file = read_exr(&path).unwrap();
        let name = file.channels[0].name.clone();
        let mut plane = file.plane(&name).unwrap();
        file.channels.remove(0);
        if with_nan {
            plane.pixels[9] = f32::NAN;
            file.push_plane(&name, &plane);
        }
        write_exr(&path, &file).unwrap();
        assert!(fs::read(&path).unwrap() != whole);
        // Its record would show that the file was altered; here the file itself has to.
        fs::remove_file(path.with_extension("json")).unwrap();
        sandbox.measure(RUN);
        assert!(fs::read(&path).unwrap() == whole, "NaN: {with_nan}");
    }
}
