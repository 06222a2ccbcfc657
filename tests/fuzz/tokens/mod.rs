//! Words that are worth trying in place of others.

mod filter;
mod program;
mod records;
mod scene;

pub use filter::{FILTER, WGSL};
pub use program::{SERVE, WORDS};
pub use records::{BOUNDS, JSON};
pub use scene::{MODEL, SCENE};

/// Numbers at and beyond every limit.
pub const NUMBERS: [&str; 44] = [
    "0",
    "-0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "16",
    "64",
    "0.5",
    "1e-3",
    "1e-7",
    "1e-20",
    "1e-38",
    "1e-45",
    "1e-308",
    "5e-324",
    "1e3",
    "1e6",
    "1e10",
    "1e19",
    "1e20",
    "1e30",
    "3.4e38",
    "-3.4e38",
    "1e39",
    "-1e39",
    "1e50",
    "1e308",
    "-1e308",
    "1e309",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "127",
    "255",
    "65535",
    "65536",
    "2147483648",
    "4294967295",
    "18446744073709551616",
];

/// Texts that make bad names, or mean something to a terminal, a page or a file system.
pub const TEXTS: [&str; 30] = [
    "",
    " ",
    ".",
    "..",
    "../",
    "../../canary.txt",
    "../canary.txt",
    "/dev/zero",
    "/dev/null",
    "/dev/stdin",
    "/proc/self/mem",
    "a/b",
    "a\\b",
    "@",
    "a@b",
    ":",
    "a:b",
    ",",
    "\u{e9}",
    "\u{65e5}\u{672c}",
    "\u{202e}x",
    "\u{1b}[31mred\u{1b}[0m",
    "::error::x",
    "<script>alert(1)</script>",
    "]]>",
    "a\0b",
    "a\nb",
    "%s%n",
    "'; --",
    "\"",
];
