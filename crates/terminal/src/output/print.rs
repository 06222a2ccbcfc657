//! Printing to standard output and to standard error.

use std::collections::BTreeSet;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;

use measure::{Error, printable, printable_lines, printable_path};
use scene::Scene;

use super::{Text, wrap_lines};

/// Prints to standard output, in colours on a terminal that shows them.
pub fn print(text: impl Into<Text>) -> Result<(), Error> {
    write_out(anstream::stdout(), text.into().terminal_codes().as_bytes())
}

/// Writes to standard output as `out` does. A reader that stops early, such as `head`, is no error.
pub fn write_out(mut out: impl Write, bytes: &[u8]) -> Result<(), Error> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            refuse!("standard output: cannot write: {error}")
        }
        _ => Ok(()),
    }
}

/// Prints plain data as JSON with a final line break.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), Error> {
    let json = serde_json::to_string_pretty(value).expect("results are plain data");
    print(format!("{json}\n"))
}

/// Writes lines to standard error, with escapes for control characters. Ignores errors, since
/// nobody need read it.
pub fn print_error(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", Text::from(text).terminal_codes());
}

/// Writes the error that ends a command to standard error.
pub fn print_failure(error: &Error) {
    print_wrapped(&printable_lines(&format!("error: {error}")));
}

/// Writes lines to standard error, wrapped on a terminal.
fn print_wrapped(text: &str) {
    if std::io::stderr().is_terminal() {
        print_error(wrap_lines(text).trim_end())
    } else {
        print_error(text)
    }
}

/// Writes a note to standard error: worth knowing, but nothing is wrong.
pub fn print_note(text: &str) {
    print_wrapped(&format!("note: {}", printable(text)));
}

/// Opens a page in the browser. A machine without one gets a note.
pub fn open_page(page: &Path) {
    if let Err(error) = opener::open(page) {
        print_note(&format!("cannot open {}: {error}", printable_path(page)));
    }
}

/// Writes what the loader left out of scenes, each note once.
pub fn print_scene_notes<'a>(scenes: impl IntoIterator<Item = &'a Scene>) {
    let notes: BTreeSet<&String> = scenes.into_iter().flat_map(|scene| &scene.notes).collect();
    for note in notes {
        print_note(note);
    }
}
