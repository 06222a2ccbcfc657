//! Shaders that name other files: a file outside of the filter's folder is never read.

use filters::Filter;

use crate::place::CANARY;
use crate::seeds::Seed;
use crate::target::{Shape, Target};

/// GLSL of a pass, whose compiler's words an error shows. A line `//// NAME` begins another one of its files.
pub static TARGET: Target = Target {
    name: "includes",
    share: 200,
    batch: 50,
    shape: Shape::Text,
    tokens: TOKENS,
    seeds: |_| {
        SEEDS
            .map(|text| Seed::Bytes(text.as_bytes().to_vec()))
            .into()
    },
    run: |place, input| {
        place.write("filter/filter.toml", MANIFEST);
        // Compilers work on copies, from where a path that begins at the root leads there.
        let canary = place.folder.with_file_name("canary.txt");
        let outside = format!("{}{}", "../".repeat(12), canary.display());
        let text = String::from_utf8_lossy(input).replace("@canary@", &outside);
        let mut parts = text.split("//// ");
        place.write("filter/blur.comp", parts.next().unwrap_or_default());
        for name in FILES {
            place.write(&format!("filter/{name}"), "float other;\n");
        }
        for (name, text) in parts.filter_map(|part| part.split_once('\n')) {
            if FILES.contains(&name) {
                place.write(&format!("filter/{name}"), text);
            }
        }
        if let Err(error) = Filter::load(&place.folder.join("filter")) {
            let said = error.to_string();
            // A compiler quotes the word that it stumbles over.
            for word in CANARY.split(' ') {
                let is_said =
                    said.contains(&format!("'{word}'")) || (word.len() > 5 && said.contains(word));
                assert!(!is_said, "a file outside was read: {said}");
            }
        }
    },
};

/// Files beside the shader.
const FILES: [&str; 3] = ["top.h", "p/near.h", "p/q/deep.h"];

const MANIFEST: &str = "name = \"filter\"\nsummary = \"It includes.\"\nalignment = \"centred\"\n\n[[pass]]\nshader = \"blur.comp\"\n";

/// Ways to name a file, and to hide that.
const TOKENS: &[&str] = &[
    "#include",
    "#define U \"\\\"/*\"",
    "#define U \"//\"",
    "\"@canary@\"",
    "\"../../canary.txt\"",
    "\"/@canary@\"",
    "<@canary@>",
    "\"p/near.h\"",
    "\"p/q/deep.h\"",
    "\"top.h\"",
    "/*",
    "*/",
    "//",
    "\\",
    "'\"'",
    "%:include",
    "??=include",
    "#line 1 \"@canary@\"",
    "#extension GL_GOOGLE_include_directive : require",
    "//// top.h",
    "//// p/near.h",
    "//// p/q/deep.h",
];

const SEEDS: [&str; 6] = [
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"top.h\"\nvoid main() {}\n",
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n#define U \"\\\"/*\"\n#include \"@canary@\"\nvoid main() {}\n",
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n#define U '\"'\n#include \"@canary@\"\n#define V '\"'\n",
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n/* \" */ #include \"@canary@\" // \"\nvoid main() {}\n",
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n#inc\\\nlude \"@canary@\"\nvoid main() {}\n",
    "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"p/q/deep.h\"\nvoid main() {}\n//// top.h\n#include \"@canary@\"\n//// p/q/deep.h\n#include \"../../top.h\"\n#include \"@canary@\"\n",
];
