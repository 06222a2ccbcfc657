//! Environment variables that the program needs.

/// Begins the program anew with the variables that it needs and that nobody has set: a place for Mesa to look for a display, since it
/// complains otherwise at every start, though nothing of this program needs a display; and the size of blocks that glibc gives back.
/// Only the environment of a new process can be changed without harm to threads. Where that fails, the driver complains, pictures
/// take more memory, and all else works. `loud` lets the driver complain.
#[cfg(unix)]
pub fn set_environment(loud: bool) {
    use std::os::unix::process::CommandExt;

    let mut missing = Vec::new();
    if !loud && std::env::var_os("XDG_RUNTIME_DIR").is_none_or(|folder| folder.is_empty()) {
        // No display lies below a file: nothing is found there, and nothing can be planted.
        missing.push(("XDG_RUNTIME_DIR", "/dev/null"));
    }
    // Blocks of this many bytes or more go back to the system as soon as they are freed: the plane of a picture of 512x512 pixels.
    // glibc raises its own threshold to the size of what is freed, up to 32 MiB, and from then on keeps planes below that, so that
    // pictures that do not live at the same time take memory together.
    let threshold = "MALLOC_MMAP_THRESHOLD_";
    let is_glibc = cfg!(all(target_os = "linux", target_env = "gnu"));
    if is_glibc && std::env::var_os(threshold).is_none() {
        missing.push((threshold, "1048576"));
    }
    let mut words = std::env::args_os();
    if let (Ok(program), Some(name), false) =
        (std::env::current_exe(), words.next(), missing.is_empty())
    {
        let mut command = std::process::Command::new(program);
        // It only comes back where it fails.
        let _ = command.arg0(name).args(words).envs(missing).exec();
    }
}

/// Sets nothing: only drivers of Unix look for a display.
#[cfg(not(unix))]
pub fn set_environment(_: bool) {}
