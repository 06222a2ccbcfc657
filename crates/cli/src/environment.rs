//! Environment variables that the program needs.

/// Variable that Mesa complains about where no login session has set it.
#[cfg(unix)]
const RUNTIME_FOLDER: &str = "XDG_RUNTIME_DIR";
/// Variable of glibc: blocks of this many bytes or more go back to the system as soon as they are freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const GIVE_BACK_FROM: &str = "MALLOC_MMAP_THRESHOLD_";
/// The plane of a picture of 512x512 pixels. glibc raises its own threshold to the size of what is freed, up to 32 MiB, and
/// from then on keeps planes below that, so that pictures that do not live at the same time take memory together.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const PLANE: &str = "1048576";

/// Begins the program anew with the variables that it needs and that nobody has set: a place for Mesa to look for a display, since it
/// complains otherwise at every start, though nothing of this program needs a display; and the size of blocks that glibc gives back.
/// Only the environment of a new process can be changed without harm to threads. Where that fails, the driver complains, pictures
/// take more memory, and all else works. `loud` lets the driver complain.
pub fn set_environment(loud: bool) {
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;

        let mut due = Vec::new();
        if !loud && std::env::var_os(RUNTIME_FOLDER).is_none_or(|folder| folder.is_empty()) {
            // No display lies below a file: nothing is found there, and nothing can be planted.
            due.push((RUNTIME_FOLDER, "/dev/null"));
        }
        #[cfg(all(target_os = "linux", target_env = "gnu"))]
        if std::env::var_os(GIVE_BACK_FROM).is_none() {
            due.push((GIVE_BACK_FROM, PLANE));
        }
        let Ok(program) = std::env::current_exe() else {
            return;
        };
        if due.is_empty() {
            return;
        }
        let mut arguments = std::env::args_os();
        let mut command = std::process::Command::new(program);
        if let Some(name) = arguments.next() {
            command.arg0(name);
        }
        command.args(arguments).envs(due);
        // It only comes back where it fails.
        let _ = command.exec();
    }
    #[cfg(not(unix))]
    let _ = loud;
}
