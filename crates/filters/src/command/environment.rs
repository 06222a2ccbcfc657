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

/// Languages and formats: `LC_ALL` and its like.
const LOCALE: &str = "LC_";

/// Collects the variables of this process that a program gets: those above, and those that are `named`.
pub(crate) fn collect_environment(named: &[String]) -> Vec<(OsString, OsString)> {
    std::env::vars_os()
        .filter(|(name, _)| name.to_str().is_some_and(|name| is_passed(name, named)))
        .collect()
}

fn is_passed(name: &str, named: &[String]) -> bool {
    let on_windows = PASSED_ON_WINDOWS.into_iter().filter(|_| cfg!(windows));
    let known = PASSED.into_iter().chain(on_windows);
    let mut known = known.chain(named.iter().map(String::as_str));
    let is_locale = name.starts_with(LOCALE);
    is_locale || known.any(|known| is_same(known, name))
}

/// Compares two names; Windows ignores case.
fn is_same(one: &str, other: &str) -> bool {
    match cfg!(windows) {
        true => one.eq_ignore_ascii_case(other),
        false => one == other,
    }
}

#[cfg(test)]
mod tests {
    use super::is_passed;

    #[test]
    fn secrets_are_not_passed_unless_they_are_named() {
        let named = ["CUDA_VISIBLE_DEVICES".to_owned()];
        for name in ["PATH", "HOME", "LC_ALL", "CUDA_VISIBLE_DEVICES"] {
            assert!(is_passed(name, &named), "{name}");
        }
        for name in [
            "GITHUB_TOKEN",
            "ACTIONS_RUNTIME_TOKEN",
            "AWS_SECRET_ACCESS_KEY",
            "SSH_AUTH_SOCK",
            "LD_PRELOAD",
            "CUDA",
            "",
        ] {
            assert!(!is_passed(name, &named), "{name}");
        }
    }
}
