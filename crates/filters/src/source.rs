//! Source of a preset.

use serde::Serialize;

/// The work that a preset follows, and where it leaves it: `[preset.source]` of filter.toml.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Source {
    /// The source code; `None` where only a publication was followed.
    #[serde(flatten)]
    pub code: Option<Code>,
    /// The paper, article or slides.
    pub publication: Option<String>,
    /// What the preset does otherwise on purpose, a sentence each.
    pub differs: Vec<String>,
}

/// Files of a repository, as of one commit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Code {
    /// Its address, `https://...`.
    pub repository: String,
    /// 40 hexadecimal digits.
    pub commit: String,
    /// The files that were followed, from the top of the repository.
    pub paths: Vec<String>,
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            repository,
            commit,
            paths,
        } = self;
        write!(f, "{repository} at {commit}: {}", paths.join(", "))
    }
}
