//! Printing to standard output and to standard error.

use std::collections::BTreeSet;
use std::io::{ErrorKind, IsTerminal, Write};

use store::{printable, printable_lines, printable_table};
use suite::Error;
use tracer::Scene;

use super::push_wrapped;

/// Prints to standard output, in colours where that is a terminal that shows them; other control characters become escapes. A
/// reader that has read enough, such as `head`, is no error.
pub fn print(text: &str) -> Result<(), Error> {
    let mut out = anstream::stdout();
    let text = printable_table(text);
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            refuse!("standard output: cannot write: {error}")
        }
        _ => Ok(()),
    }
}

/// Prints plain data as JSON, which ends with a line break.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), Error> {
    let json = serde_json::to_string_pretty(value).expect("results are plain data");
    print(&format!("{json}\n"))
}

/// Writes a line to standard error. Nobody need read it: errors are ignored.
pub fn print_error(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Writes the error that ends a command to standard error.
pub fn print_failure(error: &Error) {
    print_wrapped(&printable_lines(&format!("error: {error}")));
}

/// Writes lines to standard error, wrapped where that is a terminal.
fn print_wrapped(text: &str) {
    if !std::io::stderr().is_terminal() {
        return print_error(text);
    }
    for line in text.lines() {
        // Lines of a compiler stand below one another.
        match line.contains(['┌', '│']) {
            true => print_error(line),
            false => {
                let mut wrapped = String::new();
                push_wrapped(&mut wrapped, 0, line);
                print_error(wrapped.trim_end());
            }
        }
    }
}

/// Writes a note to standard error: something is worth knowing, and nothing is wrong.
pub fn print_note(text: &str) {
    print_wrapped(&format!("note: {}", printable(text)));
}

/// Writes what the loader left out of scenes, each note once.
pub fn print_scene_notes<'a>(scenes: impl IntoIterator<Item = &'a Scene>) {
    let notes: BTreeSet<&String> = scenes.into_iter().flat_map(|scene| &scene.notes).collect();
    for note in notes {
        print_note(note);
    }
}
