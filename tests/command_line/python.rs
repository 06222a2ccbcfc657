//! The Python that drives the program.

use std::process::Command;

/// Returns the Python that has a package. `make test` installs them and names it in PYTHON.
pub fn python_with(package: &str) -> String {
    let python = std::env::var("PYTHON").unwrap_or("python3".to_owned());
    let import = format!("import {package}");
    let found = Command::new(&python).args(["-c", &import]).output();
    assert!(
        found.is_ok_and(|output| output.status.success()),
        "{python} has no {package}: `make test` installs it; or pip install {package}, and set PYTHON to the Python that has it"
    );
    python
}
