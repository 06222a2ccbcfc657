//! Hostile and broken input: an error names each, and none ends the program in another way.

mod kernels;
mod limits_page;
mod programs;
mod records;
mod scene_files;
mod terminal;
mod trees;
