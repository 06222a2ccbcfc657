//! The cases of a run as a table.

use std::collections::HashMap;

use suite::{Bench, Case, FilterId, Run};
use tracer::SceneId;

/// A run's cases with a row per filter and a column per scene: it finds a case without a walk over all.
pub struct CaseTable<'a> {
    /// Run that holds the cases.
    pub run: &'a Run,
    /// Costs of the filters; none where nothing was timed.
    pub bench: Option<Bench>,
    /// Filters and references in the order they ran.
    pub filters: Vec<FilterId>,
    /// Scenes in the order they ran.
    pub scenes: Vec<&'a SceneId>,
    /// Numbers of the cases of each filter, one per scene.
    rows: HashMap<FilterId, Vec<usize>>,
    /// Numbers of the cases of each scene.
    columns: HashMap<&'a SceneId, Vec<usize>>,
    places: HashMap<(FilterId, &'a SceneId), usize>,
}

impl<'a> CaseTable<'a> {
    /// Sorts the cases of a run into a table.
    pub fn new(run: &'a Run, bench: Option<Bench>) -> Self {
        let mut table = Self {
            run,
            bench,
            filters: Vec::new(),
            scenes: Vec::new(),
            rows: HashMap::new(),
            columns: HashMap::new(),
            places: HashMap::new(),
        };
        for (index, case) in run.cases.iter().enumerate() {
            let filter = case.filter_id();
            let row = table.rows.entry(filter.clone()).or_default();
            if row.is_empty() {
                table.filters.push(filter.clone());
            }
            row.push(index);
            let column = table.columns.entry(&case.scene).or_default();
            if column.is_empty() {
                table.scenes.push(&case.scene);
            }
            column.push(index);
            table.places.entry((filter, &case.scene)).or_insert(index);
        }
        table
    }

    /// Lists the cases of a filter with their numbers, one per scene.
    pub fn cases_of(
        &self,
        filter: &FilterId,
    ) -> impl Iterator<Item = (usize, &'a Case)> + use<'a, '_> {
        self.numbered(self.rows.get(filter))
    }

    /// Lists the cases of a scene with their numbers.
    pub fn cases_on(
        &self,
        scene: &SceneId,
    ) -> impl Iterator<Item = (usize, &'a Case)> + use<'a, '_> {
        self.numbered(self.columns.get(scene))
    }

    /// Finds the number of a filter's case of one scene.
    pub fn case_on(&self, filter: &FilterId, scene: &SceneId) -> Option<usize> {
        self.places.get(&(filter.clone(), scene)).copied()
    }

    fn numbered<'t>(
        &'t self,
        numbers: Option<&'t Vec<usize>>,
    ) -> impl Iterator<Item = (usize, &'a Case)> + use<'a, 't> {
        let run = self.run;
        let numbers = numbers.into_iter().flatten();
        numbers.map(move |index| (*index, &run.cases[*index]))
    }
}
