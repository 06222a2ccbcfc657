//! Scales as a scene.toml states them.

use std::fmt;

use glam::DVec3;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// One factor, or one per axis; none is 0.
#[derive(Clone, Copy)]
pub(super) struct Scale(pub(super) DVec3);

impl Default for Scale {
    fn default() -> Self {
        Self(DVec3::ONE)
    }
}

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ScaleVisitor;

        impl<'de> Visitor<'de> for ScaleVisitor {
            type Value = [f64; 3];

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number or [x, y, z]")
            }

            fn visit_i64<E: Error>(self, factor: i64) -> Result<[f64; 3], E> {
                Ok([factor as f64; 3])
            }

            fn visit_f64<E: Error>(self, factor: f64) -> Result<[f64; 3], E> {
                Ok([factor; 3])
            }

            fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<[f64; 3], A::Error> {
                <[f64; 3]>::deserialize(SeqAccessDeserializer::new(values))
            }
        }

        let factors = deserializer.deserialize_any(ScaleVisitor)?;
        if factors.contains(&0.0) {
            let reason = format!("scale is {factors:?}; allowed: factors other than 0");
            Err(D::Error::custom(reason))
        } else {
            Ok(Self(DVec3::from(factors)))
        }
    }
}
