//! Features of packages: the Python module and everything else ask for the same ones, so that both
//! share what is compiled.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// Features by package and version.
type Features = BTreeMap<String, BTreeSet<String>>;

#[test]
fn the_python_module_shares_what_everything_else_compiles() {
    let module = list_features(&["-p", "shuttertruth-python", "-e", "features,normal,build"]);
    // What `make run` compiles, and what the tests do.
    for kinds in ["features,normal,build", "features,normal,build,dev"] {
        let others = list_features(&["-e", kinds]);
        let shared: Vec<&String> = (module.keys())
            .filter(|package| others.contains_key(*package))
            .collect();
        assert!(shared.len() > 200, "few packages are compared");
        for package in shared {
            let difference: Vec<&String> = (module[package])
                .symmetric_difference(&others[package])
                .collect();
            assert!(
                difference.is_empty(),
                "{package} is compiled with {difference:?} and without; ask for it in tests/Cargo.toml or in \
                 crates/python/Cargo.toml, too"
            );
        }
    }
}

/// Lists the features of all packages below the default ones, or below the one that is named.
fn list_features(arguments: &[&str]) -> Features {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([
        "tree", "--locked", "--prefix", "none", "--format", "{p} {f}",
    ]);
    let output = (cargo
        .args(arguments)
        .arg("--manifest-path")
        .arg(root)
        .output())
    .expect("cargo");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).expect("text");
    let mut features = Features::new();
    for line in text.lines() {
        // `exr v1.74.2 rayon,default`, maybe with `(proc-macro)`, `(*)` or a path in between.
        let words: Vec<&str> = line.split(' ').collect();
        if let [name, version, rest @ ..] = &words[..]
            && version.starts_with('v')
        {
            let listed = rest.iter().filter(|word| !word.starts_with('('));
            let listed = listed.flat_map(|word| word.split(','));
            (features.entry(format!("{name} {version}")).or_default())
                .extend(listed.filter(|word| !word.is_empty()).map(str::to_owned));
        }
    }
    features
}
