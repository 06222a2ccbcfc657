//! Check of strings in JSON that others wrote.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::printable;

/// Keys of texts that may have several lines: why something failed, and words of a command line.
const FREE: [&str; 3] = ["reason", "command", "exposes"];

/// Refuses a text whose strings hold control characters; the error says where. Keys count as strings.
pub fn check_strings(text: &str) -> Result<(), serde_json::Error> {
    let mut json = serde_json::Deserializer::from_str(text);
    Printable.deserialize(&mut json)?;
    json.end()
}

/// A value whose strings are all printable.
struct Printable;

impl<'de> DeserializeSeed<'de> for Printable {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Printable {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        let shown = printable(text);
        match shown == text {
            true => Ok(()),
            false => Err(E::custom(format!(
                "\"{shown}\" holds control characters; allowed: text on one line"
            ))),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<(), A::Error> {
        while values.next_element_seed(Printable)?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        while let Some(key) = entries.next_key::<String>()? {
            Printable.visit_str(&key)?;
            match FREE.contains(&key.as_str()) {
                true => {
                    entries.next_value::<IgnoredAny>()?;
                }
                false => entries.next_value_seed(Printable)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_break_in_a_name_is_refused_with_its_place_and_in_a_reason_it_is_not() {
        check_strings(r#"{"a": ["b", 1, null, 1.5, -2, true], "reason": "two\nlines"}"#).unwrap();
        for (text, found) in [
            (r#"{"a": ["b\n::error::c"]}"#, "\\n::error::c"),
            (r#"{"a\u001b": 1}"#, "a\\u001b"),
        ] {
            let error = check_strings(text).unwrap_err().to_string();
            assert!(error.contains(found) && error.contains("line 1"), "{error}");
        }
    }
}
