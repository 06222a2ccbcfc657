//! The folder of finished work: who writes there, names of rendered files, records of results with
//! their inputs, and files from other folders and from archives.

mod clear;
mod error;
mod folder;
mod folder_lock;
mod gather;
mod json;
mod json_lines;
mod markdown;
mod printable;
mod record;
mod render_file;
mod tracked;

pub use clear::clear_scene;
pub use error::Error;
pub use folder::{is_below, refuse_long_names, refuse_scene, scene_folder};
pub use folder_lock::{FolderLock, Sharing, lock_folder};
pub use gather::{Files, MAX_TAKEN_BYTES, gather, place_files};
pub use json::{MAX_JSON_BYTES, MAX_RUN_BYTES, read_text, read_text_within};
pub use json_lines::to_lines;
pub use markdown::{escape_markdown, markdown_code};
pub use printable::{printable, printable_lines, printable_path};
pub use record::{
    CASE_RECORD, hash_inputs, hash_program, look_up, look_up_alone, put, remove_altered_files,
};
pub use render_file::{
    LADDER, MAX_REPLICATES, RenderFile, RenderPath, Wanted, ladder_folder, list_files,
    list_renders, take,
};
pub use tracked::refuse_tracked;
