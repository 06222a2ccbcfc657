//! Lines that a service cannot answer.

use std::io::{Read, Write};
use std::process::Stdio;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::sandbox::{Sandbox, press_ctrl_c, split};
use crate::serve::SERVE;

/// Sends bytes, reads answers until the service ends, and checks that it ends well.
fn converse(sandbox: &Sandbox, said: &[u8]) -> Vec<Value> {
    let mut command = sandbox.command(&split(SERVE));
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let said = said.to_vec();
    let speaker = std::thread::spawn(move || input.write_all(&said));
    let mut heard = String::new();
    let mut output = child.stdout.take().unwrap();
    output.read_to_string(&mut heard).unwrap();
    speaker.join().unwrap().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{heard}");
    heard
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

#[test]
fn a_bad_line_gets_an_error_and_the_next_line_an_answer() {
    let sandbox = Sandbox::new();
    let request = b"{\"id\": 1, \"params\": {}, \"scenes\": [\"plate\", \"plate\"]}\n";
    let long = vec![b'['; 3 << 20];
    let wrong = vec![b'x'; 5000];
    let last = b"\n{\"id\": 2, \"params\": {}}\n";
    let said = [
        request.as_slice(),
        b"{\"id\": \xff}\n",
        &long,
        b"\n",
        &wrong,
        last,
    ];
    let heard = converse(&sandbox, &said.concat());
    let errors: Vec<&str> = heard
        .iter()
        .filter_map(|line| line["error"].as_str())
        .collect();
    let parts = [
        "not UTF-8 from its byte 8",
        "more than 1048576 bytes",
        "xxx..: allowed are",
        "\"plate\" is named twice",
    ];
    for part in parts {
        assert!(
            errors.iter().any(|error| error.contains(part)),
            "{part}: {errors:?}"
        );
    }
    assert_eq!(errors.len(), parts.len(), "{errors:?}");
    assert!(errors.iter().all(|error| error.len() < 1000));
    let done = heard.last().unwrap();
    assert_eq!(done["id"], json!(2));
    assert!(done["done"].is_object(), "{done}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_an_idle_service() {
    let sandbox = Sandbox::new();
    let mut command = sandbox.command(&split(SERVE));
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let _silence = child.stdin.take().unwrap();
    let mut ready = [0; 1];
    child
        .stdout
        .as_mut()
        .unwrap()
        .read_exact(&mut ready)
        .unwrap();
    let pressed = Instant::now();
    press_ctrl_c(&child);
    let status = child.wait().unwrap();
    assert!(
        pressed.elapsed() < Duration::from_secs(2),
        "{:?}",
        pressed.elapsed()
    );
    assert_eq!(status.code(), Some(130));
}
