//! Lines that a service cannot answer.

use std::io::{Read, Write};
use std::process::{Child, Stdio};

use serde_json::Value;
use tests::text::assert_contains;

use crate::child::assert_ends_at_ctrl_c;
use crate::sandbox::{Sandbox, split};
use crate::serve::SERVE;

fn start(sandbox: &Sandbox) -> Child {
    let mut command = sandbox.command(&split(SERVE));
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    command.spawn().unwrap()
}

#[test]
fn a_bad_line_gets_an_error_and_the_next_line_an_answer() {
    let sandbox = Sandbox::new();
    let mut child = start(&sandbox);
    let said = [
        b"{\"id\": 1, \"params\": {}, \"scenes\": [\"plate\", \"plate\"]}\n".as_slice(),
        b"{\"id\": \xff}\n",
        &[b'['; 3 << 20],
        b"\n",
        &[b'x'; 5000],
        b"\n{\"id\": 2, \"params\": {}}\n",
    ]
    .concat();
    let mut input = child.stdin.take().unwrap();
    let speaker = std::thread::spawn(move || input.write_all(&said));
    let mut heard = String::new();
    let mut output = child.stdout.take().unwrap();
    output.read_to_string(&mut heard).unwrap();
    speaker.join().unwrap().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{heard}");
    let heard: Vec<Value> = (heard.lines())
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let errors = heard.iter().filter_map(|line| line["error"].as_str());
    let errors: Vec<&str> = errors.collect();
    let parts = "not UTF-8 from its byte 8 | more than 1048576 bytes | xxx..: allowed are | \"plate\" is named twice";
    assert_contains(&errors.join("\n"), parts);
    assert_eq!(errors.len(), 4, "{errors:?}");
    assert!(errors.iter().all(|error| error.len() < 1000));
    let done = heard.last().unwrap();
    assert_eq!(done["id"], 2);
    assert!(done["done"].is_object(), "{done}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_an_idle_service() {
    let sandbox = Sandbox::new();
    let mut child = start(&sandbox);
    let _silence = child.stdin.take().unwrap();
    let output = child.stdout.as_mut().unwrap();
    output.read_exact(&mut [0; 1]).unwrap();
    assert_ends_at_ctrl_c(child);
}
