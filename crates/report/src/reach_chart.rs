//! Cost against reach as a picture of one line.

use maud::{Markup, html};

use suite::{REACHES, ReachCost};

/// Sides of the picture, in its own units.
const WIDTH: f64 = 160.0;
const HEIGHT: f64 = 32.0;
/// Room for a mark at every side.
const MARGIN: f64 = 4.0;

/// The least and the largest time of all filters, in seconds: what the lower and the upper side of every picture stand for.
pub fn span(reaches: &[ReachCost]) -> [f64; 2] {
    let points = reaches.iter().flat_map(|cost| &cost.points);
    let times = points.filter_map(|point| Some(point.seconds.as_ref()?.median));
    times.fold([f64::INFINITY, 0.0], |[low, high], time| {
        [low.min(time), high.max(time)]
    })
}

/// Both ways logarithmic, so that cost that grows with the reach is a slope of one, whatever it begins at. The numbers stand
/// beside it.
pub fn reach_chart(cost: &ReachCost, [low, high]: [f64; 2]) -> Markup {
    let part = |value: f64, low: f64, high: f64| (value / low).ln() / (high / low).ln().max(1e-3);
    let points: Vec<[f64; 2]> = (cost.points.iter())
        .filter_map(|point| {
            let reach = [point.pixels, REACHES[0], REACHES[REACHES.len() - 1]].map(f64::from);
            let right = part(reach[0], reach[1], reach[2]);
            let up = part(point.seconds.as_ref()?.median, low, high);
            Some([
                MARGIN + right * (WIDTH - 2.0 * MARGIN),
                HEIGHT - MARGIN - up * (HEIGHT - 2.0 * MARGIN),
            ])
        })
        .collect();
    let line: Vec<String> = (points.iter())
        .map(|[x, y]| format!("{x:.1},{y:.1}"))
        .collect();
    html! {
        svg.reach viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) aria-hidden="true" focusable="false" {
            polyline points=(line.join(" ")) {}
            @for [x, y] in points { circle.full cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="2.2" {} }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use suite::{ReachPoint, Spread};

    #[test]
    fn cost_that_grows_with_the_reach_is_a_straight_line() {
        let points = REACHES.map(|pixels| ReachPoint {
            pixels,
            seconds: (pixels != 32).then(|| Spread::of([1e-5 * f64::from(pixels)])),
            value: None,
            passes: Vec::new(),
        });
        let cost = ReachCost {
            filter: String::new(),
            preset: String::new(),
            parameter: None,
            points: points.to_vec(),
            growth: None,
        };
        let span = span(std::slice::from_ref(&cost));
        assert_eq!(span, [8e-5, 256e-5]);
        let drawn = reach_chart(&cost, span).into_string();
        // From the lower left to the upper right corner, in even steps, without what was not timed.
        assert!(
            drawn.contains("points=\"4.0,28.0 34.4,23.2 95.2,13.6 125.6,8.8 156.0,4.0\""),
            "{drawn}"
        );
    }
}
