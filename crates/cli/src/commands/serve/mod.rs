//! The command `tune serve`.

mod inbox;
mod line_reader;

use std::collections::BTreeSet;

use clap::Args;
use serde_json::json;
use store::Sharing;
use suite::Error;
use tune::{Evaluator, Objective, SceneScore, evaluate_candidate};

use self::inbox::{Inbox, ScoreRequest, print_reply};
use super::candidate::{
    claim_and_render, load_candidate_scenes, open_candidate_gpu, select_candidate,
};
use super::evaluate::change_settings;
use crate::arguments::CandidateArgs;
use crate::output::make_monitor;

#[derive(Debug, Args)]
pub struct ServeArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
}

/// Answers until standard input ends and all is answered.
pub fn execute(args: &ServeArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    let scenes = load_candidate_scenes(candidate)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    // The claim on the folder ends here: all is read.
    let (_, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Together)?;
    let bleed = candidate.objective.contains(&Objective::Bleed);
    let mut service = Service {
        evaluator: Evaluator::new(gpu.as_ref(), &choice, &rendered, bleed, make_monitor())?,
        cost: candidate.objective.contains(&Objective::Cost),
        inbox: Inbox::open(),
    };
    let names: Vec<&String> = rendered.iter().map(|scene| &scene.name).collect();
    print_reply(json!({"ready": true, "filter": choice.filter.name, "scenes": names}))?;
    while let Some(request) = service.inbox.next()? {
        service.answer_request(request)?;
    }
    Ok(())
}

/// A service that answers requests about one filter.
struct Service<'a> {
    evaluator: Evaluator<'a>,
    cost: bool,
    inbox: Inbox,
}

impl Service<'_> {
    /// Scores one candidate scene by scene, and sums up. A request that cannot be answered gets an error and ends nothing.
    fn answer_request(&mut self, request: ScoreRequest) -> Result<(), Error> {
        let id = request.id;
        if self.inbox.cancelled.remove(&id) {
            return print_reply(json!({"id": id, "cancelled": true}));
        }
        let known: Vec<String> = (self.evaluator.targets.iter())
            .map(|target| target.scene.name.clone())
            .collect();
        let found = scene_indices(&known, request.scenes).and_then(|scenes| {
            let settings = change_settings(&self.evaluator.choice, request.params)?;
            let inbox = &mut self.inbox;
            evaluate_candidate(
                &mut self.evaluator,
                &settings,
                &scenes,
                self.cost,
                |scene, score| report_scene(inbox, id, &known[scene], score),
            )
        });
        match found {
            Ok(answer) => print_reply(json!({"id": id, "done": answer})),
            Err(_) if self.inbox.cancelled.remove(&id) => {
                print_reply(json!({"id": id, "cancelled": true}))
            }
            Err(error) if error.is_interruption() => Err(error),
            Err(error) => print_reply(json!({"id": id, "error": error.to_string()})),
        }
    }
}

/// Reports the scores of one scene; false where the request was cancelled or nobody reads.
fn report_scene(inbox: &mut Inbox, id: u64, scene: &str, score: &SceneScore) -> bool {
    let printed =
        print_reply(json!({"id": id, "scene": scene, "flip": score.flip, "bleed": score.bleed}));
    printed.is_ok() && inbox.read().is_ok() && !inbox.cancelled.contains(&id)
}

fn scene_indices(known: &[String], names: Option<Vec<String>>) -> Result<Vec<usize>, Error> {
    let Some(names) = names else {
        return Ok((0..known.len()).collect());
    };
    let mut seen = BTreeSet::new();
    if let Some(twin) = names.iter().find(|name| !seen.insert(*name)) {
        refuse!("scenes: \"{twin}\" is named twice; allowed: each once");
    }
    (names.iter())
        .map(|name| {
            let index = known.iter().position(|it| it == name);
            index.ok_or_else(|| {
                Error::Usage(format!(
                    "scenes: \"{name}\" was not loaded; allowed: {}",
                    known.join(", ")
                ))
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn a_request_under_way_ends_when_it_is_cancelled_and_no_other_does() {
        let (sender, lines) = channel();
        let mut inbox = Inbox::new(lines);
        let score = SceneScore {
            flip: 0.1,
            bleed: None,
        };
        assert!(report_scene(&mut inbox, 7, "fan", &score));
        sender.send(Ok("{\"cancel\": 8}".to_owned())).unwrap();
        assert!(report_scene(&mut inbox, 7, "fan", &score));
        sender.send(Ok("{\"cancel\": 7}".to_owned())).unwrap();
        assert!(!report_scene(&mut inbox, 7, "fan", &score));
    }
}
