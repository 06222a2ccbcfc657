//! Filter folders that no device could run, that fail within their own ranges, or that attack their reader.

mod device;
mod text;

use std::process::Output;

use filters::Filter;

use crate::hostile::terminal::assert_tame;
use crate::sandbox::{Sandbox, assert_refused, divide, rows};

/// Makes a sandbox with the filter `mine`, after these replacements in its files.
fn write_mine(changes: &[(&str, &str)]) -> Sandbox {
    let sandbox = Sandbox::new();
    change(&sandbox, changes);
    sandbox
}

fn change(sandbox: &Sandbox, changes: &[(&str, &str)]) {
    let mut manifest = include_str!("mine/filter.toml").to_owned();
    let mut kernels = include_str!("mine/mine.wgsl").to_owned();
    for (from, to) in changes {
        assert!(manifest.contains(from) || kernels.contains(from), "{from}");
        manifest = manifest.replacen(from, to, 1);
        kernels = kernels.replacen(from, to, 1);
    }
    sandbox.write_filter("mine", &manifest, &kernels);
}

/// Lists the filter after the changes of each row of a table, which must be refused. The message must be printable, and no line of it may
/// be a log command. Returns the sandboxes.
fn refuse_rows(table: &str) -> Vec<(Sandbox, Vec<&'static str>)> {
    let rows = rows(include_str!("refusals.toml"), table).into_iter();
    let refused = rows.map(|row| {
        let (changes, parts) = divide(&row);
        println!("{changes:?}");
        let sandbox = write_mine(&changes);
        let output = list(&sandbox);
        assert_refused(&output, 2, &parts);
        assert_tame(&output);
        (sandbox, parts)
    });
    refused.collect()
}

fn list(sandbox: &Sandbox) -> Output {
    sandbox.shuttertruth(&["list", "--filter", "mine"])
}

fn load(sandbox: &Sandbox) -> Result<Filter, String> {
    Filter::load(&sandbox.path("mine")).map_err(|error| error.to_string())
}
