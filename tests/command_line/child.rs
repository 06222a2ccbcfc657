//! Processes that a test starts, waits for and stops.

use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Presses Ctrl-C for a process, which must end within two seconds.
#[track_caller]
pub fn assert_ends_at_ctrl_c(mut child: Child) {
    let pressed = Instant::now();
    send(&child, "INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let took = pressed.elapsed();
    assert!(took < Duration::from_secs(2), "{took:?}");
}

/// Sends a signal to a process.
pub fn send(child: &Child, signal: &str) {
    let mut kill = Command::new("kill");
    let status = kill.args([&format!("-{signal}"), &child.id().to_string()]);
    assert!(status.status().unwrap().success());
}

/// Waits until a condition is true while a process runs, for two minutes at most.
#[track_caller]
pub fn wait_until(child: &mut Child, mut is_so: impl FnMut() -> bool) {
    let end = Instant::now() + Duration::from_secs(120);
    while !is_so() {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        assert!(Instant::now() < end, "it takes too long");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Waits until a process has computed for a number of hundredths of a second, summed over its
/// threads, or for two seconds if the system does not report that.
pub fn wait_until_busy(child: &mut Child, hundredths: u64) {
    let stat = Path::new("/proc").join(child.id().to_string()).join("stat");
    for _ in 0..if cfg!(target_os = "linux") { 6000 } else { 200 } {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        let stat = fs::read_to_string(&stat).unwrap_or_default();
        // After the name in brackets: the state, ten numbers, and the times of the process and of
        // the system for it.
        let numbers = stat.rsplit(')').next().unwrap().split_whitespace();
        let times = numbers.skip(11).take(2).map(|time| time.parse::<u64>());
        if times.map(Result::unwrap).sum::<u64>() >= hundredths {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}
