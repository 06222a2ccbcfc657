//! A running program, with everything that it starts.

use std::io;
use std::process::{Command, ExitStatus};

use process_wrap::std::{ChildWrapper, CommandWrap};

#[cfg(target_os = "linux")]
use super::descendants::Descendants;

/// A process group, or a job object of Windows, which no process leaves. On Linux the group includes processes that left it;
/// elsewhere a process that calls `setsid` escapes.
pub struct ProcessGroup {
    group: Box<dyn ChildWrapper>,
    #[cfg(target_os = "linux")]
    descendants: Descendants,
}

impl ProcessGroup {
    /// Starts the program.
    pub fn spawn(command: Command) -> io::Result<Self> {
        #[cfg(target_os = "linux")]
        let descendants = Descendants::new();
        let mut command = CommandWrap::from(command);
        #[cfg(unix)]
        command.wrap(process_wrap::std::ProcessGroup::leader());
        #[cfg(windows)]
        command.wrap(process_wrap::std::JobObject);
        Ok(Self {
            group: command.spawn()?,
            #[cfg(target_os = "linux")]
            descendants,
        })
    }

    /// Returns the exit status of the program itself, if it has ended.
    pub fn try_wait(&mut self) -> io::Result<Option<ExitStatus>> {
        self.group.inner_mut().try_wait()
    }
}

impl Drop for ProcessGroup {
    /// Kills whatever is left.
    fn drop(&mut self) {
        // A group that is empty is gone.
        let _ = self.group.start_kill();
        let _ = self.group.inner_mut().wait();
        #[cfg(target_os = "linux")]
        self.descendants.kill();
    }
}
