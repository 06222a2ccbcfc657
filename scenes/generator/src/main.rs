//! The program `generator`, which writes the meshes and textures of the built-in scenes: `cargo run
//! -p generator`.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for file in generator::generate_files() {
        let path = scenes.join(&file.path);
        std::fs::create_dir_all(path.parent().expect("it lies in a scene's folder"))?;
        std::fs::write(&path, &file.bytes)?;
        println!("{} ({} bytes)", file.path, file.bytes.len());
    }
    Ok(())
}
