//! Paths of Unreal from a root, such as `/Engine/Private/Common.ush`.

/// Folders that Unreal calls by such a path.
const ROOTS: [&str; 3] = ["Engine/", "Plugin/", "Project/"];

/// Removes the slash before a path of Unreal, so that it names a folder next to the shader, as
/// Unity's `Packages/` does.
pub fn strip_root(path: &str) -> &str {
    let below = path.strip_prefix('/');
    let known = below.filter(|below| ROOTS.iter().any(|root| below.starts_with(root)));
    known.unwrap_or(path)
}

/// Makes the line that takes the place of a missing file's `#include`: an error, unless a condition
/// leaves it out.
pub fn refuse_if_used(path: &str) -> String {
    let way_out = match strip_root(path) {
        below if below == path => String::new(),
        below => format!(
            "; copy it to \"{below}\" next to the shader, or write there what the shader uses of it"
        ),
    };
    format!("#error includes \"{path}\", which is no file of this filter{way_out}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_roots_of_unreal_lose_their_slash() {
        assert_eq!(
            strip_root("/Engine/Public/Platform.ush"),
            "Engine/Public/Platform.ush"
        );
        for path in [
            "/etc/passwd",
            "Engine/a.ush",
            "/Engine.ush",
            "//Engine/a.ush",
        ] {
            assert_eq!(strip_root(path), path);
        }
    }
}
