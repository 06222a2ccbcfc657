//! Smallest changes that searches recommend.

use std::fs;

use tests::root;

use crate::results::engines::list_engines;

/// Returns the verdict of a preset's search in results/changes, if there is one.
fn verdict(shape: &str) -> Option<String> {
    let path = format!("results/changes/{}.md", shape.replace(':', "_"));
    let page = fs::read_to_string(root().join(path)).ok()?;
    let lines = page.lines();
    let mut verdicts = lines.filter_map(|line| line.strip_prefix("smallest change: "));
    Some(verdicts.next().unwrap().to_owned())
}

#[test]
fn an_engine_has_the_change_of_its_search_and_no_defect_only_if_there_is_none() {
    let mut searched = 0;
    for engine in list_engines() {
        let verdict = verdict(&engine.shape);
        let is_none = verdict
            .as_ref()
            .is_some_and(|text| text.starts_with("none"));
        let change = engine
            .change
            .as_ref()
            .map(|change| format!("`{}`", change.set));
        assert_eq!(
            change,
            verdict.filter(|_| !is_none),
            "{}: its search found another change",
            engine.name
        );
        if engine.wrong == "No defect was found that can be measured." {
            assert!(is_none, "{}: a search found a change", engine.name);
        }
        searched += 1;
    }
    let pages = fs::read_dir(root().join("results/changes")).unwrap();
    assert!(searched >= pages.count());
}
