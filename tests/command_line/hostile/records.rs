//! Files of this program, altered: pictures, parts of truths, runs, journals.

mod damage;
mod journals;
mod names;
mod numbers;
mod parts;
mod pictures;
