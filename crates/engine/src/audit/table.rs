//! Table of an audit.

use measure::{engine_name, printable};
use terminal::output::{Text, push_wrapped};
use terminal::table::{Table, cell};

use super::capture_audit::CaptureAudit;
use super::velocity_audit::ObjectAudit;

/// Lists, per object, its visibility in the engine's picture and its velocity error; then the depth
/// error, then what is wrong.
pub fn audit_table(audit: &CaptureAudit) -> Text {
    let size = audit.size;
    let columns = [
        "pixels", "shown", "compared", "speed", "error", "95 %", "worst", "at", "scale",
    ];
    let mut table = Table::new("object", columns);
    let mut compared = 0;
    for object in &audit.objects {
        let velocity = audit
            .velocity
            .iter()
            .find(|velocity| velocity.object == object.object);
        compared += velocity.map_or(0, |velocity| velocity.pixels);
        let none = || ["0", "n/a", "n/a", "n/a", "n/a", "n/a", "n/a"].map(str::to_owned);
        let errors = velocity.map_or_else(none, list_errors);
        let shown = [
            object.pixels.to_string(),
            format!("{:.1} %", 100.0 * object.shown),
        ];
        table.push(&object.object, shown.into_iter().chain(errors));
    }
    let pixels = size.pixels() as f64;
    let basis = if audit.has_ids {
        "their ids"
    } else {
        "their depth"
    };
    let mut text = Text::from(format!(
        "{} drawn by {}, {size}: {:.1} % of the pixels show what the scene shows, by {}\nvelocity in pixels per frame, compared at {:.1} % of them\n\n",
        audit.scene,
        printable(engine_name(&audit.engine)),
        100.0 * audit.alike,
        basis,
        100.0 * compared as f64 / pixels,
    ));
    text += table.text();
    let depth = &audit.depth;
    text += format!(
        "depth: median error {:.4} %, 95 % of {} pixels below {:.3} %\n\n",
        100.0 * depth.median,
        depth.pixels,
        100.0 * depth.p95
    );
    for finding in &audit.findings {
        push_wrapped(&mut text, 2, format!("- {}", finding.text));
    }
    text += match (audit.findings.is_empty(), audit.shows_scene) {
        (true, _) if audit.compares_color => "PASS: velocity, depth and colour are right\n",
        (true, _) => "PASS: velocity and depth are right\n",
        (false, true) => "FAIL\n",
        (false, false) => {
            "UNDECIDED: the capture does not show the scene as it is at the instant\n"
        }
    };
    text
}

fn list_errors(object: &ObjectAudit) -> [String; 7] {
    [
        object.pixels.to_string(),
        format!("{:.2}", object.speed),
        format!("{:.3}", object.median),
        format!("{:.3}", object.p95),
        format!("{:.3}", object.worst),
        format!("{},{}", object.worst_at[0], object.worst_at[1]),
        cell(object.scale, |scale| format!("{scale:.3}")),
    ]
}
