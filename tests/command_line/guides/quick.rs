//! Quick forms of the pages' commands.

/// Beginnings of commands that build, or need something that a test lacks, and their replacements.
pub const REPLACED: [(&str, &str); 3] = [
    ("cargo run --bin shuttertruth -- ", "shuttertruth "),
    ("make ", "make --dry-run "),
    ("python3 ", "\"${PYTHON:-python3}\" -B "),
];

/// Options that make a command quick, replacing the page's values; each is added to the named
/// commands.
///
/// `check` and `calibrate` stay as on the page: bounds are for one size, and few samples decide
/// nothing.
const QUICK: [(&str, &str, &str); 5] = [
    (
        "--size",
        "96x54",
        "run, truths render, bench, tune search, tune compare",
    ),
    (
        "--samples-per-pixel",
        "16",
        "run, truths render, tune search, tune compare",
    ),
    ("--budget", "6", "tune search"),
    ("--rows", "2", ""),
    ("--noise", "0.05", ""),
];

/// Commands whose scenes, right after their name, are added if the page leaves them out, meaning
/// all.
const OF_SCENES: [&str; 3] = ["run", "check", "tune search"];

/// Makes a command of a page quick.
pub fn shorten(command: &str) -> String {
    let mut line = command.to_owned();
    for (beginning, other) in REPLACED {
        if let Some(rest) = line.strip_prefix(beginning) {
            line = format!("{other}{rest}");
        }
    }
    let Some(words) = line.strip_prefix("shuttertruth ") else {
        // `make growth` makes the large run.
        return line.replace("--scenes 100 --filters 94", "--scenes 4 --filters 10");
    };
    let mut words: Vec<String> = words.split(' ').map(str::to_owned).collect();
    let command = words[0].clone();
    let grouped = words.iter().take(2).cloned().collect::<Vec<_>>().join(" ");
    let named = |commands: &str| {
        let names = [command.as_str(), grouped.as_str()];
        commands.split(", ").any(|name| names.contains(&name))
    };
    // The noise decides how many samples are rendered.
    let has_noise = words.iter().any(|word| word == "--noise");
    for (option, value, commands) in QUICK {
        if has_noise && option == "--samples-per-pixel" {
            continue;
        }
        match words.iter().position(|word| word == option) {
            Some(at) if !named("check, limits calibrate") => words[at + 1] = value.to_owned(),
            None if named(commands) => words.extend([option, value].map(str::to_owned)),
            _ => {}
        }
    }
    // Held-out scenes have their own size.
    if words.iter().any(|word| word == "--held-out") {
        let few = "--held-out-size 96x54 --held-out-samples-per-pixel 16";
        words.extend(few.split(' ').map(str::to_owned));
    }
    if named("bench") && !words.iter().any(|word| word == "--filter") {
        words.extend(["--filter", "mcguire:paper"].map(str::to_owned));
    }
    let scenes = OF_SCENES.iter().find(|name| named(name));
    if let Some(at) = scenes.map(|name| name.split(' ').count()) {
        // A finished run determines its scenes.
        let has_scenes = (words.get(at)).is_some_and(|word| !word.starts_with("--"));
        if !has_scenes && !words.iter().any(|word| word == "--run") {
            words.insert(at, "fan".to_owned());
        }
    }
    format!("shuttertruth {}", words.join(" "))
}
