//! A running program, with everything that it starts.

use std::io;
use std::process::{Command, ExitStatus};

use process_wrap::std::{ChildWrapper, CommandWrap};

#[cfg(target_os = "linux")]
use crate::descendants::Descendants;
use crate::limits::Limits;

/// A process group, or a job object of Windows, which no process leaves.
pub struct ProcessGroup {
    group: Box<dyn ChildWrapper>,
    /// Processes that may have left the group, for a program whose whole tree ends with it.
    #[cfg(target_os = "linux")]
    descendants: Option<Descendants>,
}

impl ProcessGroup {
    /// Starts the program.
    pub fn spawn(command: Command, limits: &Limits) -> io::Result<Self> {
        #[cfg(target_os = "linux")]
        let descendants = limits.whole_tree.then(Descendants::new);
        let mut command = CommandWrap::from(command);
        #[cfg(unix)]
        command.wrap(process_wrap::std::ProcessGroup::leader());
        #[cfg(windows)]
        command.wrap(process_wrap::std::JobObject);
        let group = Self {
            group: command.spawn()?,
            #[cfg(target_os = "linux")]
            descendants,
        };
        limits.enforce(group.group.id())?;
        Ok(group)
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
        if let Some(descendants) = &self.descendants {
            descendants.kill();
        }
    }
}
