//! Replies of `tune serve`: lines of JSON on standard output.

use suite::Error;

use crate::output::print::print;

/// Prints one reply.
pub fn print_reply(value: serde_json::Value) -> Result<(), Error> {
    print(&format!("{value}\n"))
}
