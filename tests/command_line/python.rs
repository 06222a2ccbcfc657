//! The Python for scripts that drive the program.

use std::process::Command;

/// Returns a Python with these packages. `make test` installs them and names it in PYTHON.
pub fn python_with(packages: &[&str]) -> String {
    let python = std::env::var("PYTHON").unwrap_or("python3".to_owned());
    // Finding them is faster than importing them.
    let find = "import sys; from importlib.util import find_spec; \
        sys.exit(any(not find_spec(own) for own in sys.argv[1:]))";
    let found = Command::new(&python)
        .args(["-c", find])
        .args(packages)
        .output();
    assert!(
        found.is_ok_and(|output| output.status.success()),
        "{python} lacks one of {packages:?}: `make test` installs them; or pip install them, and set \
         PYTHON to the Python that has them"
    );
    python
}
