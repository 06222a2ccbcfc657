//! Altered files of this program: pictures, parts of truths, runs, journals.

mod damage;
mod journals;
mod names;
mod parts;
mod pictures;
