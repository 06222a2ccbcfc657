//! Table of an audit.

use suite::CaptureAudit;

use super::columns::number_table;
use crate::output::wrap::push_wrapped;

/// Lists the error of velocity per object, then that of depth, then what is wrong.
pub fn audit_table(audit: &CaptureAudit) -> String {
    let [width, height] = audit.size;
    let mut table = number_table(&[
        "velocity, px per frame",
        "pixels",
        "speed",
        "error",
        "95 %",
        "worst",
        "at",
        "scale",
    ]);
    for object in &audit.velocity {
        table.push(vec![
            object.object.clone(),
            object.pixels.to_string(),
            format!("{:.2}", object.speed),
            format!("{:.3}", object.median),
            format!("{:.3}", object.p95),
            format!("{:.3}", object.worst),
            format!("{},{}", object.worst_at[0], object.worst_at[1]),
            object
                .scale
                .map_or("n/a".to_owned(), |scale| format!("{scale:.3}")),
        ]);
    }
    let mut text = format!(
        "{} drawn by {}, {width}x{height}: {:.1} % of the pixels show what the scene shows\n\n",
        audit.scene,
        audit.engine,
        100.0 * audit.alike
    );
    text += &table.text();
    let depth = &audit.depth;
    text += &format!(
        "depth: median error {:.4} %, 95 % of {} pixels below {:.3} %\n\n",
        100.0 * depth.median,
        depth.pixels,
        100.0 * depth.p95
    );
    for finding in &audit.findings {
        push_wrapped(&mut text, 2, &format!("- {}", finding.text));
    }
    text += match audit.findings.is_empty() {
        true => "PASS: velocity and depth are right\n",
        false => "FAIL\n",
    };
    text
}
