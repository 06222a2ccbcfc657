//! Table of the jobs of a plan.

use super::Table;

/// Lists jobs with their CPU time in seconds and their memory in bytes, and the sum of the times.
pub fn jobs_table<'a>(jobs: impl IntoIterator<Item = (&'a str, f64, u64)>) -> String {
    let mut table = Table::new("job", ["CPU seconds", "memory in MB"]);
    let (mut count, mut sum) = (0, 0.0);
    for (name, seconds, memory) in jobs {
        let memory = format!("{:.0}", memory as f64 / 1e6);
        table.push(name, [format!("{seconds:.1}"), memory]);
        count += 1;
        sum += seconds;
    }
    table.text()
        + &format!(
            "\n{count} jobs, about {sum:.0} CPU seconds; --json prints their command lines\n"
        )
}
