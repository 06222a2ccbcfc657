//! Table of an audit without a scene.

use measure::{engine_name, printable};
use terminal::output::{Text, push_wrapped};
use terminal::table::Table;

use crate::audit_self::pair_audit::{PairAudit, RegionAudit};
use crate::audit_self::sequence_audit::SequenceAudit;
use crate::audit_self::verdict::Verdict;

/// Lists each region in its worst frame, then the findings, then the limits of the audit.
pub fn sequence_table(audit: &SequenceAudit) -> Text {
    let columns = [
        "frame",
        "seen",
        "detail",
        "speed",
        "error x, y",
        "95 %",
        "spread",
        "velocity",
    ];
    let mut table = Table::new("region", columns).with_words_in(columns.len());
    for (frame, region) in list_worst(&audit.pairs) {
        table.push(&region.region, list_cells(frame, region));
    }
    let mut text = Text::from(format!(
        "{} frames drawn by {}, {}: does velocity lead to the frame before?\nper region in its worst frame; vectors in pixels per frame\n\n",
        audit.frames,
        printable(engine_name(&audit.engine)),
        audit.size,
    ));
    text += table.text();
    for finding in &audit.findings {
        push_wrapped(&mut text, 2, format!("- {}", finding.text));
    }
    text += "Nobody can know from pictures alone:\n";
    for unknown in audit.unknown {
        push_wrapped(&mut text, 2, format!("- {unknown}"));
    }
    text += match (audit.findings.is_empty(), audit.carries) {
        (true, true) => "PASS: velocity leads to the frame before wherever the pictures tell\n",
        (false, _) => "FAIL\n",
        (true, false) => "UNDECIDED: the pictures tell nothing about velocity\n",
    };
    text
}

/// Picks each region's worst frame.
fn list_worst(pairs: &[PairAudit]) -> Vec<(usize, &RegionAudit)> {
    let mut worst: Vec<(usize, &RegionAudit)> = Vec::new();
    for pair in pairs {
        for region in &pair.regions {
            let known = worst
                .iter()
                .position(|(_, known)| known.region == region.region);
            match known {
                Some(at) if badness(region) > badness(worst[at].1) => {
                    worst[at] = (pair.frame, region);
                }
                Some(_) => {}
                None => worst.push((pair.frame, region)),
            }
        }
    }
    worst
}

/// Orders verdicts, and errors of one verdict.
fn badness(region: &RegionAudit) -> (u32, u64) {
    let rank = match region.verdict {
        Verdict::CannotTell(_) => 0,
        Verdict::Carries => 1,
        Verdict::IsOff => 2,
        Verdict::IsNotTheMotion => 3,
    };
    let error = region.error.map_or(0.0, |error| error.size());
    (rank, (1e6 * error) as u64)
}

fn list_cells(frame: usize, region: &RegionAudit) -> [String; 8] {
    let shares = &region.shares;
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let seen = shares.compared + shares.even + shares.unlike;
    let none = || "n/a".to_owned();
    let error = region.error;
    [
        frame.to_string(),
        percent(seen),
        percent(shares.compared),
        format!("{:.2}", region.speed),
        error.map_or_else(none, |error| {
            format!("{:+.2}, {:+.2}", error.bias[0], error.bias[1])
        }),
        error.map_or_else(none, |error| format!("{:.2}", error.half_width_along)),
        error.map_or_else(none, |error| format!("{:.2}", error.spread)),
        match region.verdict {
            Verdict::Carries if error.is_some_and(|error| error.only_along.is_some()) => {
                "carries (1 way)".to_owned()
            }
            Verdict::Carries => "carries".to_owned(),
            Verdict::IsOff => "is off".to_owned(),
            Verdict::IsNotTheMotion => "not the motion".to_owned(),
            Verdict::CannotTell(reason) => format!("? {}", reason.name()),
        },
    ]
}
