//! The pictures of a report, each kept once however many cases show it.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use frame::FileError;

use crate::Error;

/// The first bytes of every PNG.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Pictures by the order in which they were first asked for. Equal bytes are one picture, whatever their files are called:
/// two filters may make the same.
#[derive(Default)]
pub struct Gallery {
    addresses: Vec<String>,
    known: HashMap<Vec<u8>, usize>,
}

impl Gallery {
    /// The number of a PNG's picture.
    pub fn add(&mut self, path: &Path) -> Result<usize, Error> {
        let bytes = fs::read(path).map_err(|source| FileError::io(path, "read", source))?;
        if !bytes.starts_with(SIGNATURE) {
            return Err(Error::Usage(format!(
                "{}: is no PNG, which a report shows; run the case again",
                path.display()
            )));
        }
        if let Some(number) = self.known.get(&bytes) {
            return Ok(*number);
        }
        let number = self.addresses.len();
        let text = STANDARD.encode(&bytes);
        self.addresses.push(format!("data:image/png;base64,{text}"));
        self.known.insert(bytes, number);
        Ok(number)
    }

    /// Every picture as a data address, as JSON: an array of strings that hold no character that HTML or JSON escapes.
    pub fn json(&self) -> String {
        let quoted: Vec<String> = (self.addresses.iter())
            .map(|address| format!("\"{address}\""))
            .collect();
        format!("[{}]", quoted.join(",\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_are_one_and_no_png_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            fs::write(&path, bytes).unwrap();
            path
        };
        let one = file("one.png", &[SIGNATURE, b"one"].concat());
        let same = file("same.png", &[SIGNATURE, b"one"].concat());
        let other = file("other.png", &[SIGNATURE, b"other"].concat());
        let mut gallery = Gallery::default();
        let numbers = [&one, &other, &same].map(|path| gallery.add(path).unwrap());
        assert_eq!(numbers, [0, 1, 0]);
        assert_eq!(gallery.json().matches("data:image/png").count(), 2);
        // As any other encoder has it: the signature and "one".
        assert!(
            gallery.json().contains("base64,iVBORw0KGgpvbmU="),
            "{}",
            gallery.json()
        );
        let wrong = file("wrong.png", b"GIF89a");
        let message = gallery.add(&wrong).unwrap_err().to_string();
        assert!(message.contains("wrong.png: is no PNG"), "{message}");
    }
}
