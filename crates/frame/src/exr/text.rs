//! Texts of OpenEXR headers: UTF-8, as other readers of OpenEXR take them.

use exr::meta::attribute::Text;

/// Encodes a text as UTF-8. The encoder itself knows only Latin-1, and panics beyond it.
pub(crate) fn to_exr(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

/// Decodes UTF-8, or else the Latin-1 that older versions and other programs wrote.
pub(crate) fn from_exr(text: &Text) -> String {
    match std::str::from_utf8(text.as_slice()) {
        Ok(text) => text.to_owned(),
        Err(_) => text.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latin_1_is_still_read() {
        let latin_1 = Text::from_slice_unchecked(b"\xe9t\xe9");
        assert_eq!(from_exr(&latin_1), "\u{e9}t\u{e9}");
    }
}
