//! Processes that a program started, even those that left its process group (Linux).

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use rustix::process::{
    Pid, Signal, WaitOptions, getpid, kill_process, set_child_subreaper, waitpid,
};

/// Longest wait for killed processes to disappear. One that waits for a broken disk may take for ever.
const LONGEST_WAIT: Duration = Duration::from_secs(1);

/// Time between two looks.
const PAUSE: Duration = Duration::from_millis(1);

/// All processes below this one, except those that were there before.
pub struct Descendants {
    before: BTreeSet<i32>,
}

impl Descendants {
    /// Makes this process the parent of orphans, and remembers the children that it has already.
    ///
    /// A process that calls `setsid` and whose parent ends goes to the nearest such parent instead of the init process. So it
    /// stays below this process, and is found.
    pub fn new() -> Self {
        // A system that refuses leaves such orphans to the init process, where they are not found.
        let _ = set_child_subreaper(Some(getpid()));
        let own = own_id();
        let mut children = list_children();
        Self {
            before: children.remove(&own).unwrap_or_default(),
        }
    }

    /// Kills all of them, and those that they start meanwhile.
    pub fn kill(&self) {
        let start = Instant::now();
        loop {
            let alive = self.find_alive();
            if alive.is_empty() || start.elapsed() > LONGEST_WAIT {
                return;
            }
            for pid in alive.into_iter().filter_map(Pid::from_raw) {
                // A process of another user cannot be killed; one that has ended is as good as killed.
                let _ = kill_process(pid, Signal::KILL);
                let _ = waitpid(Some(pid), WaitOptions::NOHANG);
            }
            std::thread::sleep(PAUSE);
        }
    }

    fn find_alive(&self) -> Vec<i32> {
        let children = list_children();
        let of = |parent: i32| children.get(&parent).into_iter().flatten().copied();
        let mut found: Vec<i32> = of(own_id())
            .filter(|child| !self.before.contains(child))
            .collect();
        let mut next = 0;
        while let Some(parent) = found.get(next) {
            found.extend(of(*parent));
            next += 1;
        }
        found
    }
}

fn own_id() -> i32 {
    getpid().as_raw_nonzero().get()
}

/// Lists the children of every process in /proc; empty if it cannot be read.
fn list_children() -> BTreeMap<i32, BTreeSet<i32>> {
    let mut children: BTreeMap<i32, BTreeSet<i32>> = BTreeMap::new();
    for entry in std::fs::read_dir("/proc").into_iter().flatten().flatten() {
        let id = entry
            .file_name()
            .to_str()
            .and_then(|name| name.parse().ok());
        let Some(id) = id else {
            continue;
        };
        // A process may have ended since the folder was listed.
        let stat = std::fs::read(entry.path().join("stat")).unwrap_or_default();
        if let Some(parent) = parse_parent(&stat) {
            children.entry(parent).or_default().insert(id);
        }
    }
    children
}

/// Parses the parent's id in a line of /proc/<pid>/stat: `pid (name) state parent ..`, where the name may hold anything.
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
