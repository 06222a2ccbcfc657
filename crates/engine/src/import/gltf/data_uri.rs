//! Data URIs, and names in URIs.

/// Decodes the base64 data of a `data:` URI. The error follows the name of the place.
pub fn decode_data_uri(uri: &str) -> Result<Vec<u8>, String> {
    let Some((head, text)) = uri.split_once(',') else {
        return Err("is a data URI without a comma; allowed: data:TYPE;base64,DATA".into());
    };
    if !head.ends_with(";base64") {
        return Err(format!(
            "begins with {head:.40}; allowed: data:TYPE;base64,DATA"
        ));
    }
    decode_base64(text.trim_end_matches('=').as_bytes()).map_err(|letter| {
        format!(
            "is no base64: it holds \"{}\"; export the file again",
            letter.escape_default()
        )
    })
}

/// Decodes base64 without its padding; the error is the first wrong letter.
fn decode_base64(text: &[u8]) -> Result<Vec<u8>, char> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for letters in text.chunks(4) {
        let mut bits = 0u32;
        for letter in letters {
            let value = match letter {
                b'A'..=b'Z' => letter - b'A',
                b'a'..=b'z' => letter - b'a' + 26,
                b'0'..=b'9' => letter - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                other => return Err(char::from(*other)),
            };
            bits = bits << 6 | u32::from(value);
        }
        let missing = 4 - letters.len();
        bits <<= 6 * missing;
        let [_, decoded @ ..] = bits.to_be_bytes();
        bytes.extend(&decoded[..3 - missing.min(2)]);
    }
    Ok(bytes)
}

/// Decodes `%20` and the like in a name; other text stays.
pub fn decode_percent(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        let digits = after
            .get(..2)
            .and_then(|digits| std::str::from_utf8(digits).ok());
        let value = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        let (byte, after) = match (first, value) {
            (b'%', Some(value)) => (value, &after[2..]),
            _ => (*first, after),
        };
        bytes.push(byte);
        rest = after;
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_every_length_is_decoded() {
        for (text, expected) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg", "foob"),
        ] {
            let uri = format!("data:application/octet-stream;base64,{text}");
            assert_eq!(decode_data_uri(&uri), Ok(expected.into()));
        }
        let refused = decode_data_uri("data:;base64,Zm9*").unwrap_err();
        assert!(
            refused.contains("is no base64: it holds \"*\""),
            "{refused}"
        );
        assert!(decode_data_uri("data:text/plain,abc").is_err());
    }

    #[test]
    fn escapes_in_names_are_decoded() {
        assert_eq!(decode_percent("my%20red%2Fcar.png%"), "my red/car.png%");
    }
}
