//! Data URIs, and names in URIs.

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

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
    let decoded = BASE64.decode(text);
    decoded.map_err(|error| format!("is no base64: {error}; export the file again"))
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
        assert!(refused.contains("is no base64: "), "{refused}");
        assert!(decode_data_uri("data:text/plain,abc").is_err());
    }

    #[test]
    fn escapes_in_names_are_decoded() {
        assert_eq!(decode_percent("my%20red%2Fcar.png%"), "my red/car.png%");
    }
}
