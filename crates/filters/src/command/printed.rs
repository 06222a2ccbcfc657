//! Output of a program: all of it is read, its end is kept.

use std::io::{self, ErrorKind, PipeReader, PipeWriter, Read};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Lines, and bytes, of what a program printed that a message shows.
const LAST_LINES: usize = 10;
const LAST_BYTES: usize = 4096;

/// How long to wait for the end of a pipe that a process beyond reach may still hold.
const PATIENCE: Duration = Duration::from_secs(1);

/// A pipe, read by a thread until all of its writers are gone.
pub struct Printed {
    tail: Arc<Mutex<Vec<u8>>>,
    ended: Receiver<()>,
}

impl Printed {
    /// The pipe's end for the program comes beside it.
    pub fn new() -> io::Result<(Self, PipeWriter)> {
        let (reader, writer) = io::pipe()?;
        let tail = Arc::new(Mutex::new(Vec::new()));
        let (sender, ended) = channel();
        let kept = Arc::clone(&tail);
        std::thread::spawn(move || {
            read_all(reader, &kept);
            // Nobody may be waiting any more.
            let _ = sender.send(());
        });
        Ok((Self { tail, ended }, writer))
    }

    /// The last lines, once the program has ended.
    pub fn last_lines(self) -> String {
        let _ = self.ended.recv_timeout(PATIENCE);
        let tail = self.tail.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&tail);
        let lines: Vec<&str> = text.trim_end().lines().collect();
        lines[lines.len().saturating_sub(LAST_LINES)..].join("\n")
    }
}

fn read_all(mut reader: PipeReader, kept: &Mutex<Vec<u8>>) {
    let mut bytes = vec![0; 1 << 16];
    loop {
        match reader.read(&mut bytes) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) | Ok(0) => return,
            Ok(count) => {
                let mut tail = kept.lock().unwrap_or_else(PoisonError::into_inner);
                tail.extend_from_slice(&bytes[..count]);
                let surplus = tail.len().saturating_sub(LAST_BYTES);
                tail.drain(..surplus);
            }
        }
    }
}
