//! Filter folders that tests write.

use std::fs;
use std::path::{Path, PathBuf};

use filters::{Filter, FilterError};

/// Writes a filter with one kernel file: `filter.toml` and `<name>.wgsl` in `folder`, which is
/// created if needed.
pub fn write_filter(folder: &Path, name: &str, manifest: &str, kernels: &str) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("filter.toml"), manifest).unwrap();
    fs::write(folder.join(format!("{name}.wgsl")), kernels).unwrap();
}

/// Loads a filter with one kernel file from a temporary folder.
pub fn load_filter(name: &str, manifest: &str, kernels: &str) -> Result<Filter, FilterError> {
    let folder = tempfile::tempdir().unwrap();
    write_filter(folder.path(), name, manifest, kernels);
    Filter::load(folder.path())
}

/// Makes the kernels of a filter with one pass, `work`. `body` writes `pixel` of `output` from
/// `color`; `parameters` are the members of `Parameters`, one or more.
pub fn one_kernel(parameters: &str, body: &str) -> String {
    format!(
        "struct Parameters {{ {parameters} }}
@group(0) @binding(1) var<uniform> parameters: Parameters;
{}",
        one_kernel_without_parameters(body)
    )
}

/// Makes such kernels without parameters.
pub fn one_kernel_without_parameters(body: &str) -> String {
    format!(
        "@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn work(@builtin(global_invocation_id) id: vec3<u32>) {{
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {{ return; }}
    {body}
}}
"
    )
}

/// Writes a filter with one pass, `work`, which reads the colour and these textures. `more` is part
/// of filter.toml.
pub fn write_kernel(folder: &Path, more: &str, textures: &[&str], body: &str) {
    let name = folder.file_name().unwrap().to_str().unwrap();
    let manifest = format!(
        "name = \"{name}\"\nsummary = \"It serves a test.\"\nalignment = \"trailing\"\n{more}\n[[pass]]\nentry = \"work\"\n"
    );
    let bind =
        |(at, texture)| format!("@group(0) @binding({at}) var {texture}: texture_2d<f32>;\n");
    let textures: String = (4..).zip(textures).map(bind).collect();
    let kernels = textures + &one_kernel_without_parameters(body);
    write_filter(folder, name, &manifest, &kernels);
}

/// Returns the folder of a built-in filter.
pub fn shipped_filter(name: &str) -> PathBuf {
    let shaders = crate::root().join("shaders");
    shaders.join(name)
}

/// Copies a built-in filter.
pub fn copy_shipped_filter(name: &str, copy: &Path) {
    copy_folder(&shipped_filter(name), copy);
}

/// Copies the files of a folder.
pub fn copy_folder(folder: &Path, copy: &Path) {
    fs::create_dir_all(copy).unwrap();
    for entry in fs::read_dir(folder).unwrap() {
        let file = entry.unwrap();
        fs::copy(file.path(), copy.join(file.file_name())).unwrap();
    }
}

/// Copies a built-in filter, and changes the text of its kernels.
pub fn copy_changed_filter(name: &str, copy: &Path, change: impl FnOnce(&str) -> String) {
    copy_shipped_filter(name, copy);
    let kernels = copy.join(name).with_extension("wgsl");
    let text = fs::read_to_string(&kernels).unwrap();
    fs::write(&kernels, change(&text)).unwrap();
}

/// Writes a filter that is a shell script with the files as $1 and $2. `lines` is the script, and
/// `more` is appended to filter.toml.
pub fn write_program(folder: &Path, name: &str, lines: &str, more: &str) {
    let command = "command = [\"./blur.sh\", \"{frame}\", \"{out}\"]";
    write_manifest(folder, name, &format!("{command}\n{more}"));
    write_script(&folder.join("blur.sh"), lines);
}

/// Writes a filter folder with only a filter.toml: three lines, and `more`.
pub fn write_manifest(folder: &Path, name: &str, more: &str) {
    fs::create_dir_all(folder).unwrap();
    let text =
        format!("name = \"{name}\"\nsummary = \"A program.\"\nalignment = \"trailing\"\n{more}\n");
    fs::write(folder.join("filter.toml"), text).unwrap();
}

/// Writes an executable shell script.
pub fn write_script(path: &Path, lines: &str) {
    fs::write(path, format!("#!/bin/sh\n{lines}\n")).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
    }
}
