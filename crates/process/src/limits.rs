//! Limits of a program that runs.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

/// What a program may use. The program and all that it starts are killed when it breaks one.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Longest time that it may take.
    pub time: Duration,
    /// Most bytes of memory that each of its processes may allocate. Only Linux enforces that.
    pub memory: u64,
    /// The file that it writes.
    pub output: Option<OutputFile>,
    /// Whether processes that leave its process group end with it, too. Only Linux finds them.
    pub whole_tree: bool,
}

/// File that a program writes.
#[derive(Clone, Debug)]
pub struct OutputFile {
    /// Its path.
    pub path: PathBuf,
    /// Most bytes that it may have.
    pub bytes: u64,
}

/// Half of the machine's memory, in bytes; no limit if the system does not report its memory.
pub fn half_of_memory() -> u64 {
    #[cfg(target_os = "linux")]
    {
        let system = rustix::system::sysinfo();
        let bytes = u128::from(system.totalram) * u128::from(system.mem_unit) / 2;
        if bytes > 0 {
            return u64::try_from(bytes).unwrap_or(u64::MAX);
        }
    }
    u64::MAX
}

impl Limits {
    /// Makes the system enforce the limits on a process and on what it starts from now on. They
    /// hold even if this program is killed: the process then ends when it has used its time on
    /// every core.
    #[cfg(target_os = "linux")]
    pub(crate) fn enforce(&self, process: u32) -> io::Result<()> {
        use rustix::process::{Pid, Resource, Rlimit, prlimit};

        let process = i32::try_from(process).ok().and_then(Pid::from_raw);
        let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get() as u64);
        let cpu_seconds = (self.time.as_secs() + 1).saturating_mul(cores);
        for (resource, most) in [(Resource::Data, self.memory), (Resource::Cpu, cpu_seconds)] {
            let limit = Rlimit {
                current: Some(most),
                maximum: Some(most),
            };
            match prlimit(process, resource, limit) {
                // The process has ended, or a stricter limit of the user holds already.
                Ok(_) | Err(rustix::io::Errno::SRCH | rustix::io::Errno::PERM) => {}
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    /// Enforces nothing beyond what the caller watches.
    #[cfg(not(target_os = "linux"))]
    pub(crate) fn enforce(&self, _: u32) -> io::Result<()> {
        Ok(())
    }
}
