//! Start and choice of a tuning, by scene and by family.

use std::collections::BTreeMap;

use maud::{Markup, html};
use report::charts::strip::Strip;
use report::numbers::percent;
use report::table::Column::{Chart, Plain};
use report::table::scroll_table;

use crate::comparison::pair_scores;
use crate::held_out::HeldOutResult;
use crate::loss::log_ratio;
use crate::selection::Fold;
use crate::target::SceneScore;
use crate::tuning::Tuning;

/// Lists the scenes tuned on, those with the start's largest errors first.
pub fn tuned_on(tuning: &Tuning) -> Markup {
    let pairs = pair_scores(&tuning.start.scenes, &tuning.chosen.scenes);
    html! {
        section {
            h2 { "Choice against start on the scenes tuned on" }
            (table("Scenes tuned on, the worst of the start first", &pairs))
        }
    }
}

/// Lists the held-out scenes as last measured.
pub fn held_out(results: &[HeldOutResult]) -> Markup {
    let Some(last) = results.last() else {
        return html! {};
    };
    let [width, height, samples] = last.render;
    html! {
        section {
            h2 { "Choice against start on held-out scenes" }
            p {
                "No trial ran on these. They were measured " (results.len())
                @if results.len() == 1 { " time" } @else { " times" }
                "; a set that is measured often becomes one that is tuned on. " (width) "x" (height) ", " (samples) " samples per pixel."
            }
            (table("Held-out scenes, the worst of the start first", &last.paired.scenes))
        }
    }
}

fn table(caption: &str, pairs: &BTreeMap<String, [SceneScore; 2]>) -> Markup {
    let mut rows: Vec<(&String, [SceneScore; 2], f64)> = (pairs.iter())
        .map(|(scene, [start, chosen])| (scene, [*start, *chosen], log_ratio(chosen, start)))
        .collect();
    rows.sort_by(|(_, [a, _], _), (_, [b, _], _)| b.flip.total_cmp(&a.flip));
    let most = rows.iter().map(|(_, _, log)| log.abs()).fold(0.0, f64::max);
    let bleed = |score: &SceneScore| match score.bleed {
        Some(bleed) => format!("{bleed:.3}"),
        None => "n/a".to_owned(),
    };
    let rows = html! {
        @for (scene, [start, chosen], log) in &rows {
            tr {
                th scope="row" { (scene) }
                td { (format!("{:.4}", start.flip)) }
                td { (format!("{:.4}", chosen.flip)) }
                td { (percent(*log)) }
                td.chart { (change_bar(*log, most)) }
                td { (bleed(start)) }
                td { (bleed(chosen)) }
            }
        }
    };
    html! {
        (scroll_table(None, caption, Some(caption), &[
            Plain("scene"), Plain("FLIP, start"), Plain("FLIP, chosen"), Plain("change"),
            Chart("← better, worse →"), Plain("lateral bleed px, start"), Plain("lateral bleed px, chosen"),
        ], &rows))
    }
}

/// Cross-validation: lists the choices made without a family of scenes, scored on that family;
/// nothing unless there are two.
pub fn folds(folds: &[Fold]) -> Markup {
    if folds.is_empty() {
        return html! {};
    }
    let sizes = folds
        .iter()
        .flat_map(|fold| [fold.others.abs(), fold.held_out.abs()]);
    let most = sizes.fold(0.0, f64::max);
    let bar = |value: f64| change_bar(value, most);
    let rows = html! {
        @for fold in folds {
            tr {
                th scope="row" { (fold.family) }
                td { (fold.scenes) }
                td { (fold.trial) }
                td { (percent(fold.others)) }
                td { (percent(fold.held_out)) }
                td class=[(fold.gap > 0.0).then_some("worse")] { (format!("{:+.3}", fold.gap)) }
                td.chart { (bar(fold.others)) (bar(fold.held_out)) }
            }
        }
    };
    html! {
        section {
            h2 { "Cross-validation" }
            p {
                "Each family of scenes is left out of the choice in turn. A gap above 0 means that the choice is worse on the family that \
                 it was made without. The search itself saw every scene: only held-out scenes show how much it overfits."
            }
            (scroll_table(None, "Cross-validation", None, &[
                Plain("family left out"), Plain("scenes"), Plain("trial"), Plain("on the others"),
                Plain("on the family"), Plain("gap"), Chart("others above, family below"),
            ], &rows))
        }
    }
}

/// Draws a bar from the middle: to the left is better than the start, to the right worse.
fn change_bar(log: f64, most: f64) -> Markup {
    let strip = Strip::about_zero(most);
    let class = if log > 0.0 { "worse" } else { "" };
    strip.draw(&html! { (strip.bar(0.0, log, class)) (strip.tick(0.0)) })
}
