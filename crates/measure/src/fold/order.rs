//! The order of scenes and filters in one process's run.

use frame::Alignment;
use scene::SceneId;

use crate::identity::FilterId;
use crate::run::Run;

/// Scenes and filters in the order in which runs name them.
pub(super) struct Order {
    /// Scenes that are rendered, then those that engines drew.
    scenes: Vec<(bool, SceneId)>,
    filters: Vec<FilterId>,
}

impl Order {
    /// Orders scenes and filters by their first mention in the runs.
    pub fn new<'a>(runs: impl Iterator<Item = &'a Run> + Clone) -> Self {
        let cases = runs.clone().map(|run| &run.cases);
        let all_scenes = cases.clone().map(|cases| {
            let scenes = cases
                .iter()
                .map(|case| (case.drawn.is_some(), case.scene.clone()));
            scenes.collect()
        });
        let mut scenes = merge_order(all_scenes);
        scenes.sort_by_key(|(is_drawn, _)| *is_drawn);
        let of_scenes = cases.flat_map(|cases| cases.chunk_by(|one, next| one.scene == next.scene));
        let measured =
            of_scenes.map(|scene_cases| scene_cases.iter().map(|case| case.filter_id()).collect());
        let failed = runs.flat_map(|run| &run.failures);
        let failed = failed.map(|failure| vec![failure.filter_id()]);
        Self {
            filters: merge_order(measured.chain(failed)),
            scenes,
        }
    }

    /// Returns the position of a frame: scenes in order, and each scene's frames in order.
    pub fn scene(&self, scene: &SceneId) -> (usize, u32) {
        let first = scene.at_frame(0);
        let place = self.scenes.iter().position(|(_, id)| *id == first);
        (place.unwrap_or(self.scenes.len()), scene.frame)
    }

    /// Returns the position of a filter in its scene: references, grouped by shutter, then filters.
    pub fn filter(&self, filter: &FilterId) -> (bool, Option<Alignment>, Option<usize>) {
        let shutter = filter.is_reference.then_some(filter.alignment);
        let place = self.filters.iter().position(|id| id == filter);
        (!filter.is_reference, shutter, place)
    }
}

/// Merges lists of names. Names of one list keep their order: a new name comes after its
/// predecessor, or before its successor; one with neither comes last.
fn merge_order<T: PartialEq + Clone>(lists: impl IntoIterator<Item = Vec<T>>) -> Vec<T> {
    let mut order: Vec<T> = Vec::new();
    for list in lists {
        let place = |name: &T, order: &[T]| order.iter().position(|other| other == name);
        let mut before: Option<usize> = None;
        for (index, name) in list.iter().enumerate() {
            let at = place(name, &order).unwrap_or_else(|| {
                let after = || list[index..].iter().find_map(|next| place(next, &order));
                let at = (before.map(|before| before + 1)).or_else(after);
                let at = at.unwrap_or(order.len());
                order.insert(at, name.clone());
                at
            });
            before = Some(at);
        }
    }
    order
}

#[test]
fn names_of_each_list_keep_their_order() {
    let merge = |lists: &[&str]| -> String {
        let lists = lists.iter().map(|list| list.chars().collect());
        merge_order(lists).into_iter().collect()
    };
    assert_eq!(merge(&["a", "b", "c"]), "abc");
    assert_eq!(merge(&["ac", "abc"]), "abc");
    assert_eq!(merge(&["bc", "abd"]), "abdc");
    assert_eq!(merge(&["abc", "c", "a"]), "abc");
}
