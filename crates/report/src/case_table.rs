//! The cases of a run as a table.

use std::collections::HashMap;

use measure::{Case, FilterId, Run};
use scene::SceneId;

/// A run's cases with a row per filter and a column per scene.
pub struct CaseTable<'a> {
    /// The run.
    pub run: &'a Run,
    /// Filters and references in the order of their runs.
    pub filters: Vec<FilterId>,
    /// Scenes in the order of their runs.
    pub scenes: Vec<&'a SceneId>,
    /// Filter of each case.
    case_filters: Vec<FilterId>,
    places: HashMap<(FilterId, &'a SceneId), usize>,
}

impl<'a> CaseTable<'a> {
    /// Sorts the cases of a run into a table.
    pub fn new(run: &'a Run) -> Self {
        let case_filters: Vec<FilterId> = run.cases.iter().map(|case| case.filter_id()).collect();
        let (mut filters, mut scenes) = (Vec::new(), Vec::new());
        let mut places = HashMap::new();
        for (index, (case, filter)) in run.cases.iter().zip(&case_filters).enumerate() {
            if !filters.contains(filter) {
                filters.push(filter.clone());
            }
            if !scenes.contains(&&case.scene) {
                scenes.push(&case.scene);
            }
            places.entry((filter.clone(), &case.scene)).or_insert(index);
        }
        Self {
            run,
            filters,
            scenes,
            case_filters,
            places,
        }
    }

    /// Lists the cases of a filter with their numbers, one per scene.
    pub fn cases_of(&self, filter: &FilterId) -> impl Iterator<Item = (usize, &'a Case)> {
        let cases = self.run.cases.iter().enumerate();
        cases.filter(|(index, _)| self.case_filters[*index] == *filter)
    }

    /// Lists the cases of a scene with their numbers.
    pub fn cases_on(&self, scene: &SceneId) -> impl Iterator<Item = (usize, &'a Case)> {
        let cases = self.run.cases.iter().enumerate();
        cases.filter(|(_, case)| case.scene == *scene)
    }

    /// Finds the number of a filter's case on one scene.
    pub fn case_on(&self, filter: &FilterId, scene: &SceneId) -> Option<usize> {
        self.places.get(&(filter.clone(), scene)).copied()
    }
}
