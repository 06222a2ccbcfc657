//! Table of the jobs of a plan.

use super::layout::{Align, Table};

/// Lists jobs with their CPU time in seconds and their memory in bytes, and the sum of the times.
pub fn jobs_table<'a>(jobs: impl IntoIterator<Item = (&'a str, f64, u64)>) -> String {
    let mut table = Table::new(
        &["job", "CPU seconds", "memory in MB"],
        &[Align::Left, Align::Right, Align::Right],
    );
    let (mut count, mut sum) = (0, 0.0);
    for (name, seconds, memory) in jobs {
        table.push(vec![
            name.to_owned(),
            format!("{seconds:.1}"),
            format!("{:.0}", memory as f64 / 1e6),
        ]);
        count += 1;
        sum += seconds;
    }
    table.text()
        + &format!(
            "\n{count} jobs, about {sum:.0} CPU seconds; --json prints their command lines\n"
        )
}
