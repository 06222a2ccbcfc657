//! Cross-validation: the choice that was made without a family of scenes, on that family.

use maud::{Markup, html};
use tune::Fold;

use crate::charts::strip::Strip;
use crate::numbers::percent;
use crate::table::Column::{Chart, Plain};
use crate::table::scroll_table;

/// Lists the families; nothing where there were no two.
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
pub fn change_bar(log: f64, most: f64) -> Markup {
    let strip = Strip::about_zero(most);
    let class = if log > 0.0 { "worse" } else { "" };
    strip.draw(&html! { (strip.bar(0.0, log, class)) (strip.tick(0.0)) })
}
