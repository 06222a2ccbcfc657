//! A quiet graphics driver.

/// Variable that Mesa complains about where no login session has set it.
#[cfg(unix)]
const RUNTIME_FOLDER: &str = "XDG_RUNTIME_DIR";

/// Begins the program anew with a place for Mesa to look for a display, unless a login session has set one: Mesa complains
/// otherwise at every start, though nothing of this program needs a display. Only the environment of a new process can be changed
/// without harm to threads. Where that fails, the driver complains, and all else works.
pub fn quiet_driver() {
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;

        if std::env::var_os(RUNTIME_FOLDER).is_some_and(|folder| !folder.is_empty()) {
            return;
        }
        let Ok(program) = std::env::current_exe() else {
            return;
        };
        let mut arguments = std::env::args_os();
        let mut command = std::process::Command::new(program);
        if let Some(name) = arguments.next() {
            command.arg0(name);
        }
        // No display lies below a file: nothing is found there, and nothing can be planted.
        command.args(arguments).env(RUNTIME_FOLDER, "/dev/null");
        // It only comes back where it fails.
        let _ = command.exec();
    }
}
