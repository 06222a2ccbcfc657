//! Environment variables that the program needs.

/// Restarts the program with two variables, if they are unset: the place where Mesa looks for a
/// display, and the size of blocks that glibc gives back. The program needs no display, but without
/// a place Mesa complains at every start; `loud` lets it complain. The restart is there because
/// only a new process's environment can be changed without harm to threads. If it fails, Mesa
/// complains, pictures need more memory, and all else works.
#[cfg(unix)]
pub fn set_environment(loud: bool) {
    use std::os::unix::process::CommandExt;

    let mut missing = Vec::new();
    if !loud && std::env::var_os("XDG_RUNTIME_DIR").is_none_or(|folder| folder.is_empty()) {
        // Nothing can be below a file: no display is found there, and nothing can be planted.
        missing.push(("XDG_RUNTIME_DIR", "/dev/null"));
    }
    // Blocks of at least this many bytes, the plane of a 512x512 picture, go back to the system as
    // soon as they are freed. Otherwise glibc raises its threshold to the size of the largest freed
    // block, up to 32 MiB, and keeps smaller planes, so that pictures which are never alive at the
    // same time add up in memory.
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
        // `exec` returns only if it fails.
        let _ = command.arg0(name).args(words).envs(missing).exec();
    }
}

/// Sets nothing: only Unix drivers look for a display.
#[cfg(not(unix))]
pub fn set_environment(_: bool) {}
