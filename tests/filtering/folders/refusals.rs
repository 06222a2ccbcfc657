//! Wrong folders, and their error messages.

use std::path::Path;

use filters::{Filter, FilterError};
use tests::text::assert_contains;

use super::documented;
use crate::filter_files::ready;

#[test]
fn a_wrong_folder_is_refused_with_place_and_reason() {
    documented().assert_refused("folder");
}

#[test]
fn a_missing_folder_names_the_file_it_looked_for() {
    let error = Filter::load(Path::new("no/such/folder")).unwrap_err();
    let parts = ["no/such/folder/filter.toml: cannot be read"];
    assert_contains(&error.to_string(), &parts);
}

#[test]
fn an_error_of_the_gpu_names_file_and_pass() {
    let large = documented().changed(
        "centre_blur.wgsl",
        "@workgroup_size(8, 8)\nfn gather",
        "@workgroup_size(999, 999)\nfn gather",
    );
    // Only the adapter knows the largest workgroup.
    let error = ready(&large.load().unwrap(), (8, 8)).unwrap_err();
    assert!(matches!(error, FilterError::Folder { .. }), "{error}");
    let parts = ["centre_blur.wgsl:33: pass \"gather\": @workgroup_size(999, 999, 1)"];
    assert_contains(&error.to_string(), &parts);
}
