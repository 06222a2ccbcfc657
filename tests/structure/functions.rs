//! No function is longer than a screen.

use std::fs;

use crate::{rust_files, sources};

/// Most lines of a function, from its name to its last bracket.
const MAX_LINES: usize = 60;

/// Longer functions that read better whole.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("crates/cli/src/arguments/refusal.rs", "refusal_text"),
    (
        "crates/cli/src/arguments/refusal.rs",
        "every_error_names_place_finding_allowed_values_and_way_out",
    ),
    ("crates/cli/src/commands/check.rs", "execute"),
    ("crates/cli/src/commands/ingest.rs", "describe"),
    ("crates/cli/src/commands/mod.rs", "execute"),
    ("crates/cli/src/commands/run.rs", "execute"),
    ("crates/cli/src/tables/tuning.rs", "tuning_table"),
    ("crates/export/src/material.rs", "push_material"),
    ("crates/filters/src/filter/convention.rs", "check"),
    (
        "crates/filters/src/filter/conversion.rs",
        "each_form_of_velocity_has_the_number_that_it_should_have",
    ),
    ("crates/filters/src/gpu/binding.rs", "create_layout"),
    ("crates/filters/src/gpu/bound_passes.rs", "new"),
    ("crates/filters/src/gpu/limits.rs", "find_broken"),
    ("crates/filters/src/input.rs", "check"),
    ("crates/filters/src/manifest/parse.rs", "parse"),
    ("crates/filters/src/manifest/pass_shader.rs", "read_shader"),
    ("crates/filters/src/manifest/passes.rs", "read_passes"),
    ("crates/filters/src/manifest/presets.rs", "read_presets"),
    ("crates/filters/src/translate/bind.rs", "bind"),
    (
        "crates/filters/src/translate/combined.rs",
        "split_combined_samplers",
    ),
    ("crates/filters/src/translate/compile.rs", "run"),
    ("crates/filters/src/translate/formats.rs", "give_formats"),
    ("crates/filters/src/translate/members.rs", "fill_block"),
    ("crates/filters/src/translate/storage.rs", "split_images"),
    ("crates/filters/src/translate/storage.rs", "sample_read"),
    ("crates/metrics/src/reference/mod.rs", "measure"),
    ("crates/metrics/src/sequence/reference.rs", "measure"),
    ("crates/report/src/case/viewer.rs", "viewer"),
    ("crates/report/src/overview/pareto.rs", "pareto_chart"),
    ("crates/report/src/overview/score_table.rs", "score_table"),
    ("crates/report/src/sequence/page.rs", "sequences_page"),
    ("crates/suite/src/audit/capture_audit.rs", "audit_capture"),
    ("crates/suite/src/audit/depth_audit.rs", "explain"),
    ("crates/suite/src/import/document.rs", "scene_toml"),
    ("crates/suite/src/ingest/convert.rs", "ingest"),
    ("crates/suite/src/judge/bounds/file.rs", "bounds"),
    ("crates/suite/src/measure/case.rs", "write"),
    ("crates/suite/src/measure/due_cases.rs", "measure"),
    ("crates/suite/src/people/clips.rs", "make_study"),
    (
        "crates/suite/src/tune/sensitivity.rs",
        "analyze_sensitivity",
    ),
    ("crates/tracer/src/accel/bvh.rs", "traverse"),
    ("crates/tracer/src/instant.rs", "trace_part"),
    ("crates/tracer/src/light/integrator.rs", "follow_path"),
    ("crates/tracer/src/load/camera.rs", "read_camera"),
    ("crates/tracer/src/load/mod.rs", "load_scene_and_files"),
    ("crates/tracer/src/load/mtl.rs", "check"),
    ("crates/tracer/src/load/obj_check.rs", "check_obj"),
];

#[test]
fn no_function_is_longer_than_a_screen() {
    let mut wrong = Vec::new();
    let mut unused = EXCEPTIONS.to_vec();
    for path in sources().iter().flat_map(|folder| rust_files(folder)) {
        let text = fs::read_to_string(&path).expect("sources are text");
        let path = path.display().to_string();
        let (_, file) = path.split_once("../").expect("it is below the repository");
        let long = find_functions(&text)
            .into_iter()
            .filter(|it| it.2 > MAX_LINES);
        for (line, name, lines) in long {
            match unused.iter().position(|known| *known == (file, name)) {
                Some(at) => drop(unused.remove(at)),
                None => wrong.push(format!("{file}:{line}: {name} has {lines} lines\n")),
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "functions of more than {MAX_LINES} lines; split them, or name them in EXCEPTIONS if they read better whole:\n{}",
        wrong.concat()
    );
    assert!(
        unused.is_empty(),
        "these are short: {unused:?}; take them from EXCEPTIONS"
    );
}

/// Finds the line, name and length of each function with a body; rustfmt puts its last bracket below its beginning.
fn find_functions(text: &str) -> Vec<(usize, &str, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let indent = &line[..line.len() - code.len()];
        let Some((before, after)) = code.split_once("fn ") else {
            continue;
        };
        let words = [
            "pub",
            "pub(crate)",
            "pub(super)",
            "async",
            "const",
            "unsafe",
            "extern",
            "\"C\"",
        ];
        if !before.split_whitespace().all(|word| words.contains(&word)) {
            continue;
        }
        let is_end = |line: &&str| {
            let code = line.strip_prefix(indent).unwrap_or_default();
            code == "}"
                || code.starts_with(|c: char| !c.is_whitespace()) && code.ends_with([';', '}'])
        };
        let end = lines[at..].iter().position(is_end);
        let name = after.split(['(', '<']).next().unwrap_or_default();
        found.extend(end.map(|end| (at + 1, name, end + 1)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_found_with_their_lengths() {
        let text = "\
trait Shape {
    fn area(
        &self,
    ) -> f32;
}

pub(crate) fn long<T>(value: T)
where
    T: Copy,
{
    if value.is_some() {
        inner();
    }
}

fn short() {}
";
        let found = [(2, "area", 3), (7, "long", 8), (16, "short", 1)];
        assert_eq!(find_functions(text), found);
    }
}
