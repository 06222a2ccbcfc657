//! Processes that a program started, even those that left its process group (Linux).

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use rustix::process::{
    Pid, Signal, WaitOptions, getpid, kill_process, set_child_subreaper, waitpid,
};

/// Longest wait for killed processes to disappear. One that waits for a broken disk may take for
/// ever.
const LONGEST_WAIT: Duration = Duration::from_secs(1);

/// Time between two checks.
const PAUSE: Duration = Duration::from_millis(1);

/// All processes below this one, except those that were there before.
pub struct Descendants {
    before: BTreeSet<i32>,
}

impl Descendants {
    /// Makes this process the parent of orphans, and remembers its current children.
    ///
    /// If the parent of a process that calls `setsid` ends, the nearest such parent adopts the
    /// process instead of init. So it stays below this process, and is found.
    pub fn new() -> Self {
        // If the system refuses, init adopts such orphans, and they are not found.
        let _ = set_child_subreaper(Some(getpid()));
        Self {
            before: list_children(),
        }
    }

    /// Kills all of them, and those that they start meanwhile. The children of a killed child
    /// become children of this process and are killed at the next check.
    pub fn kill(&self) {
        let start = Instant::now();
        loop {
            let children = list_children();
            let mut alive = children.difference(&self.before).peekable();
            if alive.peek().is_none() || start.elapsed() > LONGEST_WAIT {
                return;
            }
            for pid in alive.filter_map(|id| Pid::from_raw(*id)) {
                // A process of another user cannot be killed; one that has ended is as good as
                // killed.
                let _ = kill_process(pid, Signal::KILL);
                let _ = waitpid(Some(pid), WaitOptions::NOHANG);
            }
            std::thread::sleep(PAUSE);
        }
    }
}

/// Lists the children of this process in /proc; empty if it cannot be read.
fn list_children() -> BTreeSet<i32> {
    let pid = getpid().as_raw_nonzero().get();
    let entries = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let children = entries.filter_map(|entry| {
        let id = entry.file_name().to_str()?.parse().ok()?;
        // A process may have ended since the folder was listed.
        let stat = std::fs::read(entry.path().join("stat")).ok()?;
        (parse_parent(&stat)? == pid).then_some(id)
    });
    children.collect()
}

/// Parses the parent's id in a line of /proc/<pid>/stat: `pid (name) state parent ..`, where
/// the name may contain anything.
fn parse_parent(stat: &[u8]) -> Option<i32> {
    let name_end = stat.iter().rposition(|byte| *byte == b')')?;
    let rest = std::str::from_utf8(&stat[name_end + 1..]).ok()?;
    rest.split_whitespace().nth(1)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::parse_parent;

    #[test]
    fn the_parent_is_read_whatever_the_name_holds() {
        assert_eq!(parse_parent(b"12 (sh) S 7 12 12 0"), Some(7));
        assert_eq!(parse_parent(b"12 (a) S 9 (b) S 7 12"), Some(7));
        assert_eq!(parse_parent(b"12 (\xff\n) Z 7 12"), Some(7));
        assert_eq!(parse_parent(b""), None);
        assert_eq!(parse_parent(b"12 (sh"), None);
    }
}
