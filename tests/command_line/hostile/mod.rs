//! Hostile and broken input. Every case must end with an error that names the input.

mod claims;
mod kernels;
mod limits_page;
mod programs;
mod records;
mod scene_files;
mod terminal;
mod trees;
