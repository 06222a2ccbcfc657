//! Environment of a program: a short list of variables, and those that its filter.toml names.

use std::ffi::OsString;

/// Variables that every program gets. None of them is a secret.
const PASSED: [&str; 7] = [
    "PATH",
    "HOME",
    "TMPDIR",
    "LANG",
    "TZ",
    // Places of Vulkan drivers.
    "VK_DRIVER_FILES",
    "VK_ICD_FILENAMES",
];

/// Variables that programs get on Windows as well.
const PASSED_ON_WINDOWS: [&str; 8] = [
    "PATHEXT",
    "USERPROFILE",
    "TEMP",
    "TMP",
    "ComSpec",
    "SystemDrive",
    "SystemRoot",
    "windir",
];

/// Collects the variables of this process that a program gets: those above, languages and formats
/// such as `LC_ALL`, and those that are `named`.
pub fn collect_environment(named: &[String]) -> Vec<(OsString, OsString)> {
    let on_windows = PASSED_ON_WINDOWS.into_iter().filter(|_| cfg!(windows));
    let known = PASSED.into_iter().chain(on_windows);
    let known: Vec<&str> = known.chain(named.iter().map(String::as_str)).collect();
    let is_passed = |name: &str| {
        name.starts_with("LC_")
            || known.iter().any(|known| {
                if cfg!(windows) {
                    known.eq_ignore_ascii_case(name)
                } else {
                    *known == name
                }
            })
    };
    std::env::vars_os()
        .filter(|(name, _)| name.to_str().is_some_and(is_passed))
        .collect()
}
