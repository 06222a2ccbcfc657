//! The command `people ask`.

use std::path::PathBuf;

use clap::Args;
use glob::Pattern;
use report::write_ask_folder;
use store::printable_path;
use study::{Question, SECONDS_PER_QUESTION, Study, StudyChoice, draw_session, make_study};
use suite::{Error, StoredRun};

use crate::arguments::{parse_glob, parse_named};
use crate::output::{count_text, print, print_json, push_wrapped};

#[derive(Debug, Args)]
pub struct AskArgs {
    /// run.json of a finished run, or its folder, with the pictures. Clips need a run with --frames.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// New or empty folder for the page and its pictures.
    #[arg(short, long, value_name = "DIR", default_value = "out/ask")]
    pub out: PathBuf,
    /// Questions that the page offers; each session asks one; repeatable, or separated by commas.
    #[arg(
        long,
        value_name = "QUESTION",
        value_delimiter = ',',
        value_parser = parse_named(Question::ALL, Question::name, Question::help),
        default_value = "truth,better"
    )]
    pub question: Vec<Question>,
    /// Scenes of the run, by name or pattern such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(long, visible_alias = "scene", value_name = "SCENES", value_delimiter = ',', value_parser = parse_glob)]
    pub scenes: Vec<Pattern>,
    /// Filters of the run, by name or pattern such as 'kino' or 'mcguire:*'; repeatable, or separated by commas [default: all].
    #[arg(long, visible_alias = "filter", value_name = "FILTERS", value_delimiter = ',', value_parser = parse_glob)]
    pub filters: Vec<Pattern>,
    /// Largest number of pairs in a session; a few checks come on top.
    #[arg(long, value_name = "N", default_value_t = 60)]
    pub pairs: usize,
    /// Print what was written as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Reads a finished run, and writes a page that asks people about its pictures.
pub fn execute(args: &AskArgs) -> Result<(), Error> {
    let side = StoredRun::read(&args.run)?;
    let choice = StudyChoice {
        scenes: args.scenes.clone(),
        filters: args.filters.clone(),
        most_pairs: args.pairs,
    };
    let (study, clips) = make_study(&side.run, side.folder(), &choice)?;
    let asked = Question::ALL.iter().copied();
    let asked: Vec<Question> = asked.filter(|own| args.question.contains(own)).collect();
    let page = write_ask_folder(&study, &clips, &asked, &args.out)?;
    let session = draw_session(&study, asked[0], 0);
    let pairs = session.iter().filter(|pair| !pair.is_check()).count();
    if args.json {
        return print_json(&serde_json::json!({
            "page": page,
            "pairs": pairs,
            "questions": session.len(),
            "study": study,
        }));
    }
    let mut text = String::new();
    push_wrapped(&mut text, 0, &describe(&study, pairs, session.len()));
    text += &format!("written: {}\n", printable_path(&page));
    let next = format!(
        "Nobody has answered yet. Give the folder to people: each opens {} in a browser, answers, and sends back the file that the page saves. \
         Then: shuttertruth people preferences answers_*.json --run {}",
        report::ASK_PAGE,
        printable_path(&args.run)
    );
    push_wrapped(&mut text, 0, &next);
    print(&text)
}

fn describe(study: &Study, pairs: usize, questions: usize) -> String {
    let minutes = (questions as f64 * SECONDS_PER_QUESTION / 60.0).ceil();
    let scenes = count_text(study.scenes.len(), "scene", "scenes");
    let shutters = study.shutters.iter().map(|own| {
        format!(
            "{} filters of the {} shutter",
            own.filters.len(),
            own.alignment
        )
    });
    let part = match study.all_pairs() {
        all if all == pairs => "every pair once".to_owned(),
        all => format!("{pairs} of {all} pairs, every filter equally often within its shutter"),
    };
    format!(
        "{} on {scenes}. A session has {questions} questions: {part}, and {} checks. At a guess of {SECONDS_PER_QUESTION} seconds per question \
         it takes {minutes} min. Two pictures need {} pixels of a display beside each other.",
        shutters.collect::<Vec<_>>().join(", "),
        questions - pairs,
        2 * study.width
    )
}
