//! Cross-validation: how a choice that was made without a family of scenes does on it.

use maud::{Markup, html};

use super::percent;
use suite::Fold;

/// Nothing where there were no two families.
pub fn folds(folds: &[Fold]) -> Markup {
    if folds.is_empty() {
        return html! {};
    }
    let sizes = folds
        .iter()
        .flat_map(|fold| [fold.others.abs(), fold.held_out.abs()]);
    let most = sizes.fold(0.0, f64::max);
    let bar = |value: f64| bar(value, most);
    html! {
        section {
            h2 { "Cross-validation" }
            p {
                "Each family of scenes is left out of the choice in turn. A gap above 0 means: worse where it was not chosen for. The \
                 trials themselves were searched for on all scenes; only held-out scenes tell the overfit of the search."
            }
            div.scroll tabindex="0" role="region" aria-label="Cross-validation" {
                table {
                    thead {
                        tr {
                            th scope="col" { "family left out" }
                            th scope="col" { "scenes" }
                            th scope="col" { "trial" }
                            th scope="col" { "on the others" }
                            th scope="col" { "on the family" }
                            th scope="col" { "gap" }
                            th.chart scope="col" { "others above, family below" }
                        }
                    }
                    tbody {
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
                    }
                }
            }
        }
    }
}

/// A bar from the middle: to the left is better than the start, to the right worse.
pub fn bar(log: f64, most: f64) -> Markup {
    const WIDTH: f64 = 200.0;
    let length = match most > 0.0 {
        true => (log.abs() / most).min(1.0) * WIDTH / 2.0,
        false => 0.0,
    };
    let (left, class) = match log > 0.0 {
        true => (WIDTH / 2.0, "bar worse"),
        false => (WIDTH / 2.0 - length, "bar"),
    };
    html! {
        svg.drawing viewBox=(format!("0 0 {WIDTH} 10")) aria-hidden="true" focusable="false" {
            rect class=(class) x=(format!("{left:.1}")) width=(format!("{length:.1}")) y="1" height="8" {}
            line.zero x1=(WIDTH / 2.0) x2=(WIDTH / 2.0) y1="0" y2="10" {}
        }
    }
}
