//! The guide's filter, and the error messages that the guide quotes.

use crate::sandbox::{Sandbox, stderr};

const GUIDE: &str = include_str!("../../docs/add-a-filter.md");

/// Returns the guide's section about writing a filter.
fn section() -> &'static str {
    let start = GUIDE.split_once("\n## 1. Write it\n").unwrap().1;
    start.split_once("\n## ").unwrap().0
}

/// Files of the guide's filter, which `new --from wgsl` writes.
const FILES: [(&str, &str); 2] = [
    (
        "filter.toml",
        include_str!("../../examples/first_blur/wgsl/filter.toml"),
    ),
    (
        "my_blur.wgsl",
        include_str!("../../examples/first_blur/wgsl/my_blur.wgsl"),
    ),
];

/// Writes the guide's filter, with one of its mistakes if asked.
fn write(sandbox: &Sandbox, change: Option<&Mistake>) {
    let [manifest, kernels] = FILES.map(|(name, text)| match change {
        Some(change) if change.file == name => {
            assert!(text.contains(change.from), "{name} holds {}", change.from);
            text.replace(change.from, change.to)
        }
        _ => text.to_owned(),
    });
    sandbox.write_filter("my_blur", &manifest, &kernels);
}

/// Mistake from the guide: a file, a text and its replacement, and the program's message.
struct Mistake {
    from: &'static str,
    to: &'static str,
    file: &'static str,
    says: String,
}

/// Reads the items ``- .., `from` written `to` in file:``, each with a block of code.
fn read_mistakes() -> Vec<Mistake> {
    (section().split("\n- ").skip(1))
        .map(|item| {
            let (head, code) = item.split_once(":\n\n").unwrap();
            let words: Vec<&str> = head.split('`').collect();
            let [_, from, " written ", to, file] = words[..] else {
                panic!("\"{head}\" shows no mistake");
            };
            // The block ends at the first line without indentation.
            let lines = code.lines().map_while(|line| line.strip_prefix("      "));
            let lines: Vec<&str> = lines.collect();
            Mistake {
                from,
                to,
                file: file.strip_prefix(" in ").unwrap(),
                says: lines.join("\n") + "\n",
            }
        })
        .collect()
}

#[test]
fn the_guide_s_filter_runs_and_beats_the_identity() {
    let sandbox = Sandbox::new();
    write(&sandbox, None);
    assert!(FILES[1].1.lines().count() <= 20);
    sandbox.measure("--filters identity --filter my_blur");
    let cases = sandbox.read_filter_cases();
    let flip = |case: usize| cases[case].scores.moving.flip.value().unwrap();
    assert_eq!(cases[1].filter, "my_blur");
    // A gather along the pixel's own velocity blurs the inside of the plate correctly, but not the
    // smear outside it: about half.
    assert!(flip(1) < 0.8 * flip(0), "{} of {}", flip(1), flip(0));
}

#[test]
fn each_mistake_prints_the_message_in_the_guide() {
    let sandbox = Sandbox::new();
    // An entry point, a parameter, a texture, a line that does not compile.
    let mistakes = read_mistakes();
    assert_eq!(mistakes.len(), 4);
    for mistake in &mistakes {
        write(&sandbox, Some(mistake));
        let output = sandbox.run(&["--filter", "my_blur"]);
        assert_eq!(stderr(&output), mistake.says);
        assert_eq!(output.status.code(), Some(2));
        assert!(!sandbox.path("out").exists());
    }
}
