//! Order of the cases of a run that is joined of parts.

use tracer::SceneId;

use crate::merge::order::merge_order;
use crate::merge::run_part::RunPart;
use crate::run::Run;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::sequence::Sequence;

/// Order in which one process measures scenes and filters.
pub(super) struct CaseOrder {
    /// Scenes that are rendered, then those that engines drew.
    scenes: Vec<(bool, SceneId)>,
    /// Cases apart from their scenes.
    names: Vec<(bool, String)>,
}

impl CaseOrder {
    /// Orders scenes and filters as the parts name them first.
    pub(super) fn new(parts: &[RunPart]) -> Self {
        let scenes = |run: &Run| -> Vec<(bool, SceneId)> {
            let mut scenes: Vec<(bool, SceneId)> = (run.cases.iter())
                .map(|case| (case.drawn.is_some(), case.scene.clone()))
                .collect();
            scenes.dedup();
            scenes
        };
        let mut order = merge_order(parts.iter().map(|part| scenes(&part.run)));
        order.sort_by_key(|(is_drawn, _)| *is_drawn);
        let of_scene = |run: &Run, scene: &SceneId| -> Vec<(bool, String)> {
            let own = run.cases.iter().filter(|case| case.scene == *scene);
            own.map(|case| (case.is_reference, case.name())).collect()
        };
        let lists = parts.iter().flat_map(|part| {
            let scenes = scenes(&part.run).into_iter();
            scenes.map(|(_, scene)| of_scene(&part.run, &scene))
        });
        let failed = parts.iter().flat_map(|part| &part.run.failures);
        let failed = failed.map(|failure| vec![(false, failure.filter.clone())]);
        Self {
            names: merge_order(lists.chain(failed)),
            scenes: order,
        }
    }

    fn of_scene(&self, scene: &SceneId) -> usize {
        let found = self.scenes.iter().position(|(_, name)| name == scene);
        found.unwrap_or(self.scenes.len())
    }

    fn of_name(&self, is_reference: bool, name: &str) -> usize {
        let is_own = |own: &(bool, String)| own.0 == is_reference && own.1 == name;
        self.names
            .iter()
            .position(is_own)
            .unwrap_or(self.names.len())
    }

    /// References of one shutter after the other, then filters.
    pub(super) fn of_case(&self, case: &Case) -> impl Ord + use<> {
        let shutter = case.is_reference.then_some(case.alignment);
        let name = self.of_name(case.is_reference, &case.name());
        (
            self.of_scene(&case.scene),
            !case.is_reference,
            shutter,
            name,
        )
    }

    /// Frame after frame, and of each its filters.
    pub(super) fn of_failure(&self, failure: &Failure) -> impl Ord + use<> {
        let name = self.of_name(false, &failure.filter);
        let scene = self.of_scene(&failure.scene.at_frame(0));
        (scene, failure.scene.clone(), name)
    }

    /// Shutter after shutter, and of each the references first.
    pub(super) fn of_sequence(&self, sequence: &Sequence) -> impl Ord + use<> {
        let name = self.of_name(sequence.is_reference, &sequence.filter);
        (
            self.of_scene(&sequence.scene),
            sequence.alignment,
            !sequence.is_reference,
            name,
        )
    }
}
