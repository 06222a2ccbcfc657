//! The folder of finished work: who writes there, names of rendered files, records of results with
//! their inputs, and files from other folders.

pub mod channels;
pub mod clear;
pub mod folder;
pub mod folder_lock;
pub mod json;
pub mod json_lines;
pub mod place;
pub mod record;
pub mod render_file;
pub mod tracked;
