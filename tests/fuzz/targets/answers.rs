//! Files of people's answers, which the page of `ask` writes and `preferences` reads.

use cli::preferences_table;
use frame::Alignment;
use study::{
    ANSWERS_FORMAT, Answer, AnswerFile, Chosen, Clip, DisplayFacts, Question, SHARP_CLIP,
    ShownPair, Study, StudyShutter, TRUTH_CLIP, draw_session, find_preferences, read_sessions,
};
use suite::Frames;

use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// A file of answers, alone and beside one that is as it should be.
pub static TARGET: Target = Target {
    name: "answers",
    share: 450,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |_| {
        vec![
            Seed::Bytes(answers(Question::Truth, 1)),
            Seed::Bytes(answers(Question::Better, 2)),
            Seed::Made(huge::deep_json),
        ]
    },
    run: |place, input| {
        let path = place.write("answers.json", input);
        let beside = place.write("beside.json", answers(Question::Truth, 3));
        for paths in [vec![path.clone()], vec![beside, path]] {
            let Ok((study, sessions)) = read_sessions(&paths) else {
                continue;
            };
            if let Ok(found) = find_preferences(&study, &sessions, None) {
                drop(preferences_table(&found));
                drop(serde_json::to_string(&found));
            }
        }
    },
};

/// Makes the answers of somebody who always takes the left clip.
fn answers(question: Question, seed: u64) -> Vec<u8> {
    let study = study();
    let answers = draw_session(&study, question, seed)
        .into_iter()
        .map(|shown| answer(&study, shown));
    let file = AnswerFile {
        format: ANSWERS_FORMAT,
        program: "shuttertruth".to_owned(),
        answers: answers.collect(),
        study,
        question,
        seed,
        display: DisplayFacts {
            device_pixel_ratio: 1.0,
            viewport: [800.0, 600.0],
        },
    };
    serde_json::to_vec_pretty(&file).unwrap()
}

fn study() -> Study {
    let filters = ["kino:default", "mcguire:paper", "jimenez:hdrp"];
    Study {
        width: 16,
        height: 16,
        frames: Frames::default(),
        scenes: vec!["plate".to_owned(), "fan".to_owned()],
        shutters: vec![StudyShutter {
            alignment: Alignment::Centred,
            filters: filters.map(str::to_owned).to_vec(),
            truth_hashes: vec![vec!["0".repeat(64)], vec!["1".repeat(64)]],
            blurred_scenes: vec![0],
        }],
        most_pairs: 6,
        pictures: "2".repeat(64),
    }
}

fn answer(study: &Study, shown: ShownPair) -> Answer {
    let own = &study.shutters[shown.shutter];
    let name = |clip| match clip {
        Clip::Filter(number) => own.filters[number].clone(),
        Clip::Truth => TRUTH_CLIP.to_owned(),
        Clip::Sharp => SHARP_CLIP.to_owned(),
    };
    Answer {
        scene: study.scenes[shown.scene].clone(),
        alignment: own.alignment,
        left: name(shown.left),
        right: name(shown.right),
        choice: Chosen::Left,
        milliseconds: 1500.0,
        zoom: 2,
    }
}
