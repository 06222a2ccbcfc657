//! The command `people preferences`.

use std::path::PathBuf;

use clap::Args;
use glob::Pattern;
use study::{Study, StudyChoice, find_preferences, make_study, read_sessions, refuse_other_run};
use suite::{Error, Run, StoredRun};

use crate::output::{print, print_json};
use crate::tables::preferences_table;

#[derive(Debug, Args)]
pub struct PreferencesArgs {
    /// Files of answers that the page of `people ask` saved, one per session.
    #[arg(value_name = "ANSWERS", required = true)]
    pub answers: Vec<PathBuf>,
    /// run.json of the run that the page shows, or its folder, with the pictures. Its scores are compared with the answers.
    #[arg(long, value_name = "RUN")]
    pub run: Option<PathBuf>,
    /// Print all numbers as JSON instead of the tables.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Reads people's answers, and prints a scale of filters and the run's scores.
pub fn execute(args: &PreferencesArgs) -> Result<(), Error> {
    let (study, sessions) = read_sessions(&args.answers)?;
    let run = args
        .run
        .as_ref()
        .map(|path| read_run(&StoredRun::read(path)?, &study));
    let run = run.transpose()?;
    let found = find_preferences(&study, &sessions, run.as_ref())?;
    match args.json {
        true => print_json(&found),
        false => print(&preferences_table(&found)),
    }
}

/// Returns a run if its pictures are the study's.
fn read_run(side: &StoredRun, study: &Study) -> Result<Run, Error> {
    let exact = |name: &String| Pattern::new(&Pattern::escape(name)).expect("it is escaped");
    let filters = study.shutters.iter().flat_map(|own| &own.filters);
    let choice = StudyChoice {
        scenes: (study.scenes.iter())
            .map(|scene| exact(&scene.to_string()))
            .collect(),
        filters: filters.map(exact).collect(),
        most_pairs: study.most_pairs,
    };
    let (of_run, _) = make_study(&side.run, side.folder(), &choice).map_err(|error| {
        Error::Usage(format!(
            "{}: is not the run that the answers are about, or has lost its pictures: {error}",
            side.path.display()
        ))
    })?;
    refuse_other_run(study, &of_run, &side.path)?;
    Ok(side.run.clone())
}
