//! Enums with names for people: in run.json and on the command line.

/// Defines an enum with `ALL` its values, their `name()`, and their documentation as `help()`. The
/// first value is the default.
#[macro_export]
macro_rules! named {
    (
        $(#[doc = $about:literal])+
        pub enum $kind:ident {
            $($(#[doc = $help:literal])+ $value:ident = $name:literal,)+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        pub enum $kind {
            $($(#[doc = $help])+ #[serde(rename = $name)] $value,)+
        }

        impl Default for $kind {
            fn default() -> Self {
                Self::ALL[0]
            }
        }

        impl $kind {
            /// Description of the values, in a sentence.
            pub const ABOUT: &str = concat!($($about),+).trim_ascii();

            /// Every value.
            pub const ALL: &[Self] = &[$(Self::$value),+];

            /// Returns the value's name.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $name,)+
                }
            }

            /// Returns the value's description, in a sentence.
            pub fn help(self) -> &'static str {
                match self {
                    $(Self::$value => concat!($($help),+).trim_ascii(),)+
                }
            }
        }
    };
}
