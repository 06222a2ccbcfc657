//! One order of names from several lists of them.

/// Orders all names of some lists. Names of one list keep their order: a name that is new stands behind the name before it, or
/// before the one behind it; one with neither comes last.
pub(super) fn merge_order<T: PartialEq + Clone>(lists: impl IntoIterator<Item = Vec<T>>) -> Vec<T> {
    let mut order: Vec<T> = Vec::new();
    for list in lists {
        let place = |name: &T, order: &[T]| order.iter().position(|other| other == name);
        for (index, name) in list.iter().enumerate() {
            if place(name, &order).is_some() {
                continue;
            }
            let behind = index
                .checked_sub(1)
                .and_then(|before| place(&list[before], &order));
            let before = list[index + 1..]
                .iter()
                .find_map(|next| place(next, &order));
            let at = match (behind, before) {
                (Some(behind), _) => behind + 1,
                (None, Some(before)) => before,
                (None, None) => order.len(),
            };
            order.insert(at, name.clone());
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
