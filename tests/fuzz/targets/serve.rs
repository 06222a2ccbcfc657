//! The lines that `serve` reads.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use crate::fixture::{PROGRAM, RENDER};
use crate::huge;
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::tokens;

/// Lines of standard input, to a program that goes on.
pub static TARGET: Target = Target {
    name: "serve",
    share: 600,
    batch: 350,
    shape: Shape::Text,
    tokens: tokens::SERVE,
    seeds: |_| vec![Seed::Made(huge::deep_json)],
    run: |place, input| {
        let mut service = place
            .service
            .take()
            .unwrap_or_else(|| Service::start(place));
        service.ask(input);
        place.service = Some(service);
    },
};

/// A program that answers.
pub struct Service {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    asked: u64,
}

impl Service {
    fn start(place: &Place) -> Self {
        place.copied("scenes");
        place.copied("out");
        let mut child = Command::new(PROGRAM)
            .current_dir(&place.folder)
            .arg("serve")
            .args(RENDER)
            .args([
                "--filter",
                "velocity_gather",
                "--objective",
                "flip",
                "--out",
                "out",
            ])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program can be started");
        let mut service = Self {
            requests: child.stdin.take().expect("a pipe"),
            answers: BufReader::new(child.stdout.take().expect("a pipe")),
            child,
            asked: 0,
        };
        let ready = service.line();
        assert!(ready.contains("ready"), "{ready}");
        service
    }

    /// Sends an input and then a request that is refused at once: when its answer comes, the input is done with.
    fn ask(&mut self, input: &[u8]) {
        self.asked += 1;
        // No input has so large a number but by chance.
        let id = 1_000_000_000_000_000 + self.asked;
        let last = format!("\n{{\"id\": {id}, \"params\": {{}}, \"scenes\": [\"none\"]}}\n");
        let sent = (self.requests.write_all(input))
            .and_then(|()| self.requests.write_all(last.as_bytes()))
            .and_then(|()| self.requests.flush());
        if sent.is_err() {
            self.gone();
        }
        let awaited = format!("\"id\":{id}");
        while !self.line().contains(&awaited) {}
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        match self.answers.read_line(&mut line) {
            Ok(0) | Err(_) => self.gone(),
            Ok(_) => line,
        }
    }

    fn gone(&mut self) -> ! {
        let status = self.child.wait().expect("a child that was started");
        panic!("serve ended, or reads no more: {status}");
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
