//! Errors as Python sees them.

use pyo3::PyErr;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};

pyo3::create_exception!(
    shuttertruth,
    Error,
    PyValueError,
    "What was found, what is allowed, and the way out, as one sentence."
);

/// Options of the program that messages name, and what they are called here.
const NAMES: [(&str, &str); 6] = [
    ("--scenes-dir", "scenes_dir"),
    ("--scenes", "scene"),
    ("--filter", "filter"),
    ("--samples-per-pixel", "samples"),
    ("--no-cache", "no_cache"),
    ("--out", "out"),
];

/// Makes the exception of an error; an interruption becomes `KeyboardInterrupt`.
pub fn to_exception(error: impl Into<measure::Error>) -> PyErr {
    let error = error.into();
    if error.is_interruption() {
        return PyKeyboardInterrupt::new_err(());
    }
    let named = NAMES
        .iter()
        .fold(error.to_string(), |text, (option, name)| {
            text.replace(option, name)
        });
    Error::new_err(named)
}
