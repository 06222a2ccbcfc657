//! Lines that `serve` reads.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::thread;

use crate::fixture::{PROGRAM, RENDER};
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// Lines of standard input to a running program.
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

/// Running program that answers.
pub struct Service {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    asked: u64,
}

impl Service {
    fn start(place: &Place) -> Self {
        place.copy("scenes");
        place.copy("out");
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
        let ready = line(&mut service.answers).unwrap_or_else(|| service.gone());
        assert!(ready.contains("ready"), "{ready}");
        service
    }

    /// Sends an input, and then a request that is refused at once: its answer means that the input has been read.
    fn ask(&mut self, input: &[u8]) {
        self.asked += 1;
        // No input has such a large number except by chance.
        let id = 1_000_000_000_000_000 + self.asked;
        let last = format!("\n{{\"id\": {id}, \"params\": {{}}, \"scenes\": [\"none\"]}}\n");
        let (requests, answers) = (&mut self.requests, &mut self.answers);
        // Another thread reads the answers meanwhile: a full pipe would stop the program, and then its reading.
        let answered = thread::scope(|scope| {
            let sending = scope.spawn(|| {
                requests.write_all(input)?;
                requests.write_all(last.as_bytes())?;
                requests.flush()
            });
            let awaited = format!("\"id\":{id}");
            let is_answered = std::iter::repeat_with(|| line(answers))
                .take_while(Option::is_some)
                .flatten()
                .any(|line| line.contains(&awaited));
            is_answered && sending.join().is_ok_and(|sent| sent.is_ok())
        });
        if !answered {
            self.gone();
        }
    }

    fn gone(&mut self) -> ! {
        let status = self.child.wait().expect("a child that was started");
        panic!("serve ended, or reads no more: {status}");
    }
}

/// Reads the next line; none if the program has ended.
fn line(answers: &mut BufReader<ChildStdout>) -> Option<String> {
    let mut line = String::new();
    let count = answers.read_line(&mut line).unwrap_or(0);
    (count > 0).then_some(line)
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
