//! The page that asks people.

use maud::{Markup, html};
use serde_json::json;
use study::{Question, SECONDS_PER_QUESTION, Study, draw_session};
use suite::PROGRAM;

use crate::document::{Document, Siblings, script_data};

/// Makes the page of a study with these questions. Its pictures are next to it, named by the numbers of their clips and frames.
pub fn ask_page(study: &Study, questions: &[Question]) -> String {
    let data = json!({
        "program": PROGRAM,
        "id": study.id(),
        "study": study,
        "clips_per_scene": study.clips_per_scene(),
        "truth_clips": study.truth_clips(),
        "questions": questions.iter().map(|own| (own.name(), own.text())).collect::<Vec<_>>(),
    });
    let count = draw_session(study, questions[0], 0).len();
    let document = Document {
        title: "Which looks better?",
        heading: html! { "Shuttertruth" },
        subtitle: "",
        body: html! {
            main #ask {
                noscript { p { "This page needs scripts." } }
                (start(study, questions, count))
                (asking(study))
                (end())
            }
            (script_data("data", &data.to_string()))
        },
        scripts: &[
            include_str!("../assets/ask_session.js"),
            include_str!("../assets/ask_clips.js"),
            include_str!("../assets/ask.js"),
        ],
        siblings: Siblings::Pictures,
    };
    document.render()
}

fn start(study: &Study, questions: &[Question], count: usize) -> Markup {
    let minutes = (count as f64 * SECONDS_PER_QUESTION / 60.0).ceil().max(1.0);
    let is_clip = study.frames.count > 1;
    let things = if is_clip { "clips" } else { "pictures" };
    html! {
        section #start {
            h2 { "Compare " (things) " of motion blur" }
            p.lead {
                "You see two " (things) " side by side, and say which one you choose. There are " (count) " questions. We guess that they take "
                "about " (minutes) (if minutes == 1.0 { " minute" } else { " minutes" }) ". You can stop at any time."
            }
            @if is_clip {
                p { strong { "The clips play over and over, and some flicker. Do not take part if flickering pictures can harm you." } }
            }
            fieldset.questions {
                legend { "Question" }
                @for (index, question) in questions.iter().enumerate() {
                    label {
                        input type="radio" name="question" value=(question.name()) checked[index == 0];
                        " " (question.text())
                        @if *question == Question::Truth { " The truth is shown above both." }
                    }
                }
            }
            (keys(is_clip))
            p {
                "There are no right answers, except for a few checks: sometimes both " (things) " are the same. Choose “no difference” if you see "
                "none. Sit as you usually do before this display, and do not change the size of the window."
            }
            p.note {
                "Your answers stay in this browser until you save them to a file. The file holds what you chose, how long it took, and the "
                "size and scale of the window. It holds nothing about you. No answers came with this page: nobody "
                "knows what people see until people say so."
            }
            p { button #begin type="button" { "Begin" } }
        }
    }
}

fn keys(is_clip: bool) -> Markup {
    let mut rows = vec![
        ("←", "the left one"),
        ("→", "the right one"),
        ("↓", "no difference"),
        ("R", "play again from the first frame"),
        ("Esc", "stop"),
    ];
    // A still picture cannot be played again.
    rows.retain(|(key, _)| is_clip || *key != "R");
    html! {
        dl.facts {
            @for (key, meaning) in rows { div { dt { kbd { (key) } } dd { (meaning) } } }
        }
    }
}

/// The pictures are drawn on canvases, all in one step. Labels name the sides and never the filter.
fn asking(study: &Study) -> Markup {
    html! {
        section #asking hidden {
            h2 #words tabindex="-1" {}
            p.misfit #misfit role="alert" hidden {}
            div #stage {
                figure #truth { canvas role="img" aria-label="Truth" {} figcaption { "truth" } }
                div.sides {
                    figure { canvas #left role="img" aria-label="Left" {} figcaption { "left" } }
                    figure { canvas #right role="img" aria-label="Right" {} figcaption { "right" } }
                }
            }
            div.answers role="group" aria-label="Answer" {
                button type="button" data-choice="left" aria-keyshortcuts="ArrowLeft" { "← Left" }
                button type="button" data-choice="neither" aria-keyshortcuts="ArrowDown" { "↓ No difference" }
                button type="button" data-choice="right" aria-keyshortcuts="ArrowRight" { "Right →" }
            }
            div.answers {
                button #replay type="button" aria-keyshortcuts="R" hidden[study.frames.count == 1] { "R Play again" }
                button #stop type="button" aria-keyshortcuts="Escape" { "Esc Stop" }
                output #progress aria-live="polite" {}
            }
        }
    }
}

fn end() -> Markup {
    html! {
        section #end hidden {
            h2 #verdict tabindex="-1" {}
            p #given {}
            p.answers {
                button #save type="button" { "Save the answers" }
                button #resume type="button" { "Go on" }
                button #fresh type="button" { "Delete the answers" }
            }
            p { "Save the answers to a file, and send it to whoever gave you this page. Then delete them here, so that another person can begin." }
            p.note #kept {}
        }
    }
}
