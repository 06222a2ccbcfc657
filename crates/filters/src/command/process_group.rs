//! A running program, together with all that it starts.

#[cfg(unix)]
pub use unix::ProcessGroup;
#[cfg(windows)]
pub use windows::ProcessGroup;

#[cfg(unix)]
mod unix {
    use std::io;
    use std::os::unix::process::CommandExt;
    use std::process::{Child, Command, ExitStatus};

    use rustix::process::{Pid, Signal, kill_process_group};

    #[cfg(target_os = "linux")]
    use super::super::descendants::Descendants;

    /// A process group. On Linux it includes processes that left the group; elsewhere a process that calls `setsid` gets away.
    pub struct ProcessGroup {
        leader: Child,
        #[cfg(target_os = "linux")]
        descendants: Descendants,
    }

    impl ProcessGroup {
        /// Starts the program.
        pub fn spawn(mut command: Command) -> io::Result<Self> {
            #[cfg(target_os = "linux")]
            let descendants = Descendants::new();
            Ok(Self {
                leader: command.process_group(0).spawn()?,
                #[cfg(target_os = "linux")]
                descendants,
            })
        }

        /// Returns the exit status of the program itself, if it has ended.
        pub fn try_wait(&mut self) -> io::Result<Option<ExitStatus>> {
            self.leader.try_wait()
        }
    }

    impl Drop for ProcessGroup {
        /// Kills whatever is left.
        fn drop(&mut self) {
            let id = i32::try_from(self.leader.id()).ok();
            if let Some(group) = id.and_then(Pid::from_raw) {
                // A group that is empty is gone.
                let _ = kill_process_group(group, Signal::KILL);
            }
            let _ = self.leader.wait();
            #[cfg(target_os = "linux")]
            self.descendants.kill();
        }
    }
}

#[cfg(windows)]
mod windows {
    use std::io;
    use std::process::{Command, ExitStatus};

    use process_wrap::std::{ChildWrapper, CommandWrap, JobObject};

    /// A job object, which no process leaves.
    pub struct ProcessGroup {
        job: Box<dyn ChildWrapper>,
    }

    impl ProcessGroup {
        /// Starts the program.
        pub fn spawn(command: Command) -> io::Result<Self> {
            let mut command = CommandWrap::from(command);
            command.wrap(JobObject);
            Ok(Self {
                job: command.spawn()?,
            })
        }

        /// Returns the exit status of the program itself, if it has ended.
        pub fn try_wait(&mut self) -> io::Result<Option<ExitStatus>> {
            self.job.inner_mut().try_wait()
        }
    }

    impl Drop for ProcessGroup {
        /// Kills whatever is left.
        fn drop(&mut self) {
            let _ = self.job.start_kill();
            let _ = self.job.inner_mut().wait();
        }
    }
}
