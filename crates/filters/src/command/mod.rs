//! Filters that are programs: a frame goes out as a file, and a picture comes back as one.

mod blur;
mod output_tail;

pub use blur::CommandBlur;
