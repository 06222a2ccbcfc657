//! What commands share in a terminal: arguments, the selection of scenes and filters, tables, progress,
//! and the result that they print and write.

/// Returns a usage error from a function.
#[macro_export]
macro_rules! refuse {
    ($($text:tt)*) => {
        return Err(measure::Error::Refused(format!($($text)*)))
    };
}

pub mod arguments;
pub mod expected;
pub mod output;
pub mod result;
pub mod selection;
pub mod settings;
pub mod table;
