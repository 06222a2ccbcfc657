//! Lines of standard input, each of bounded length.

use std::io::{self, BufRead, Read};
use std::sync::mpsc::{Receiver, sync_channel};

/// Upper limit on the bytes of a line.
const LONGEST_LINE: usize = 1 << 20;

/// Lines that are read before they are asked for.
const AHEAD: usize = 64;

/// A line without its end, or an error in its place.
pub type Line = Result<String, String>;

/// Reads standard input while other work goes on.
pub fn read_lines() -> Receiver<Line> {
    let (sender, receiver) = sync_channel(AHEAD);
    std::thread::spawn(move || {
        let mut input = io::stdin().lock();
        while let Some(line) = read_next(&mut input) {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    receiver
}

/// Reads the next line; none where the input has ended.
fn read_next(input: &mut impl BufRead) -> Option<Line> {
    match read_line(input) {
        Ok(line) => line,
        // Whatever comes next is no line from its beginning.
        Err(error) => {
            let _ = skip(input);
            Some(Err(format!("standard input cannot be read: {error}")))
        }
    }
}

fn read_line(input: &mut impl BufRead) -> io::Result<Option<Line>> {
    let mut bytes = Vec::new();
    let most = LONGEST_LINE as u64 + 1;
    if input.take(most).read_until(b'\n', &mut bytes)? == 0 {
        return Ok(None);
    }
    if bytes.last() == Some(&b'\n') {
        bytes.pop();
    } else if bytes.len() > LONGEST_LINE {
        skip(input)?;
        return Ok(Some(Err(format!(
            "a line has more than {LONGEST_LINE} bytes, which is the most; it was left out"
        ))));
    }
    Ok(Some(String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to() + 1;
        format!("a line is not UTF-8 from its byte {byte} on; it was left out")
    })))
}

/// Reads on to the next line and keeps nothing.
fn skip(input: &mut impl BufRead) -> io::Result<()> {
    loop {
        let bytes = input.fill_buf()?;
        let (end, count) = match bytes.iter().position(|byte| *byte == b'\n') {
            Some(at) => (true, at + 1),
            None => (bytes.is_empty(), bytes.len()),
        };
        input.consume(count);
        if end {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unreadable_line_is_reported_and_the_next_one_is_read() {
        let long = "x".repeat(LONGEST_LINE);
        let input = [
            b"one\n\n\xff\ntwo\n".as_slice(),
            long.as_bytes(),
            b"\n",
            long.as_bytes(),
            b"yyy\nlast",
        ];
        let input = input.concat();
        let mut input = input.as_slice();
        let read: Vec<Line> = std::iter::from_fn(|| read_next(&mut input)).collect();
        let said = |index: usize| read[index].as_ref().unwrap_err().as_str();
        assert_eq!(read.len(), 7);
        assert_eq!(read[0].as_deref(), Ok("one"));
        assert_eq!(read[1].as_deref(), Ok(""));
        assert!(said(2).contains("not UTF-8 from its byte 1"), "{}", said(2));
        assert_eq!(read[3].as_deref(), Ok("two"));
        assert_eq!(read[4].as_ref().map(String::len), Ok(LONGEST_LINE));
        assert!(said(5).contains("more than 1048576 bytes"), "{}", said(5));
        assert_eq!(read[6].as_deref(), Ok("last"));
    }
}
