//! The last lines that a program printed.

use std::io::{self, ErrorKind, PipeReader, PipeWriter, Read};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Upper limit on the lines that a message shows.
const LAST_LINES: usize = 10;
/// Upper limit on their bytes.
const LAST_BYTES: usize = 4096;

/// Longest wait for the end of a pipe, which an escaped process may keep open.
const LONGEST_WAIT: Duration = Duration::from_secs(1);

/// A pipe, read by a thread until all of its writers are gone.
pub struct OutputTail {
    tail: Arc<Mutex<Vec<u8>>>,
    ended: Receiver<()>,
}

impl OutputTail {
    /// Opens a pipe; returns the end for the program too.
    pub fn new() -> io::Result<(Self, PipeWriter)> {
        let (reader, writer) = io::pipe()?;
        let tail = Arc::new(Mutex::new(Vec::new()));
        let (sender, ended) = channel();
        let shared = Arc::clone(&tail);
        std::thread::spawn(move || {
            read_all(reader, &shared);
            // Nobody may be waiting any more.
            let _ = sender.send(());
        });
        Ok((Self { tail, ended }, writer))
    }

    /// Waits for the end of the pipe; returns the last lines.
    pub fn into_lines(self) -> String {
        let _ = self.ended.recv_timeout(LONGEST_WAIT);
        let tail = self.tail.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&tail);
        let lines: Vec<&str> = text.trim_end().lines().collect();
        lines[lines.len().saturating_sub(LAST_LINES)..].join("\n")
    }
}

/// Reads the pipe to its end, and keeps the last bytes.
fn read_all(mut reader: PipeReader, shared: &Mutex<Vec<u8>>) {
    let mut bytes = vec![0; 1 << 16];
    loop {
        match reader.read(&mut bytes) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) | Ok(0) => return,
            Ok(count) => {
                let mut tail = shared.lock().unwrap_or_else(PoisonError::into_inner);
                tail.extend_from_slice(&bytes[..count]);
                let surplus = tail.len().saturating_sub(LAST_BYTES);
                tail.drain(..surplus);
            }
        }
    }
}
