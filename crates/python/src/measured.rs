//! Runs of filters over scenes, as a table.

use clap::Parser;
use measure::{Case, Error, open_gpu};
use metrics::Metric;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::RunArgs;
use terminal::output::{OutputArgs, set_output};

use crate::work::{MONITOR, work};

/// The arguments of the command `run`.
#[derive(Parser)]
#[command(name = "run", no_binary_name = true)]
struct RunLine {
    #[command(flatten)]
    run: RunArgs,
}

/// Measures as the command `run` with these arguments does, and returns a row per case.
#[pyfunction]
pub fn measure_filters<'py>(
    py: Python<'py>,
    words: Vec<String>,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let cases = work(py, || measure_cases(&words))?;
    cases.iter().map(|case| make_row(py, case)).collect()
}

fn measure_cases(words: &[String]) -> Result<Vec<Case>, Error> {
    set_output(OutputArgs {
        quiet: true,
        verbose: false,
        color: clap::ColorChoice::Never,
    });
    let line = RunLine::try_parse_from(words);
    let args = line
        .map_err(|error| Error::Refused(one_sentence(&error)))?
        .run;
    let (mut plan, _) = run::make_plan(&args.measure, args.measure.scenes.out.clone())?;
    run::apply_options(&mut plan, &args.options)?;
    plan.monitor = MONITOR;
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), MONITOR)?;
    let measured = run::measure(&mut plan, gpu.as_ref())?;
    run::write_run(&measured.whole, &plan.out)?;
    measure::refuse_failures(&measured.run.failures)?;
    Ok(measured.run.cases)
}

/// Takes the sentence out of an error of the command line.
fn one_sentence(error: &clap::Error) -> String {
    let text = error.to_string();
    let line = text.lines().next().unwrap_or_default();
    line.trim_start_matches("error: ").to_owned()
}

/// Makes a row of plain values: who, where, and every score; NaN for one that does not apply.
fn make_row<'py>(py: Python<'py>, case: &Case) -> PyResult<Bound<'py, PyDict>> {
    let row = PyDict::new(py);
    row.set_item("scene", case.scene.to_string())?;
    row.set_item("filter", case.name())?;
    row.set_item("reference", case.is_reference)?;
    row.set_item("alignment", case.alignment.name())?;
    row.set_item("exposure", case.exposure)?;
    for metric in Metric::all().into_iter().chain([Metric::CommonFlip]) {
        let value = case.measured(metric).value();
        row.set_item(metric.name(), value.unwrap_or(f64::NAN))?;
    }
    Ok(row)
}
