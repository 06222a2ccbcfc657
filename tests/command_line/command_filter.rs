//! Filters that are programs.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use frame::{ExrFile, Frame, Raster, Reprojection, read_exr, write_exr};
use tests::filter_folder::{write_manifest, write_script};
use tests::text::assert_contains;

use crate::child::{send, wait_until};
use crate::sandbox::*;

fn write_lines(sandbox: &Sandbox, name: &str, more: &str) {
    write_manifest(&sandbox.path(name), name, more);
}

fn render(sandbox: &Sandbox) {
    sandbox.done("truths render --quiet --out r --samples-per-pixel 16");
}

/// Words that blur the rendered frame.
fn blur(filter: &str) -> Vec<&str> {
    let words = "engine blur --allow-commands --frame r/plate/frame.exr --out b.exr --filter";
    [split(words), vec![filter]].concat()
}

#[test]
fn a_program_that_blurs_like_a_kernel_gets_its_scores() {
    let sandbox = Sandbox::new();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let command = format!(
        "command = ['{program}', 'engine', 'blur', '--filter', 'velocity_gather', '--frame', '{{frame}}', '--out', '{{out}}', \
         '--set', 'velocity_gather.samples={{samples}}', '--exposure', '{{exposure}}']\n\
         [[parameter]]\nname = 'samples'\nkind = 'integer'\nrange = [1, 64]\ndefault = 10\ndoc = 'Taps.'\n\
         [[preset]]\nname = 'coarse'\ndoc = 'Few.'\nvalues = {{ samples = 8 }}\n"
    );
    write_lines(&sandbox, "outside", &command);
    let filters = "velocity_gather:coarse,./outside:coarse";
    sandbox.measure(&format!("--filters {filters} --allow-commands"));
    let cases = sandbox.read_filter_cases();
    let [kernels, program] = &cases[..] else {
        panic!("two filters on one scene");
    };
    // Colours and mattes are passed as 32-bit floats, so nothing is lost.
    assert_eq!(kernels.scores, program.scores);
    assert_eq!(program.parameters["samples"], filters::Value::Integer(8));
    assert_eq!(kernels.command, None);
    assert!((program.command.as_ref().unwrap()).contains(&"{frame}".to_owned()));
}

#[test]
fn a_program_needs_no_adapter_and_runs_again_when_it_is_edited() {
    let sandbox = Sandbox::new();
    sandbox.write_program("copy", "cp $1 $2", "");
    let words =
        "run --quiet --out out --filter copy --allow-commands --size 64x32 --samples-per-pixel 16";
    let printed = sandbox.without_adapter(&split(words));
    assert_done(&printed);
    assert_contains(&stdout(&printed), &["adapter: none"]);
    assert_eq!(sandbox.read_run().adapter, None);
    // An adapter requested by the user must still exist.
    let asked = format!("{words} --adapter 0");
    let refused = sandbox.without_adapter(&split(&asked));
    assert_refused(&refused, 3, &["mesa-vulkan-drivers"]);

    // An edited program runs again.
    write_script(&sandbox.path("copy/blur.sh"), "exit 3");
    let failed = sandbox.without_adapter(&split(words));
    assert_eq!(failed.status.code(), Some(1));
    let parts = ["filter copy on plate: ", "ended with exit status: 3"];
    assert_contains(&sandbox.read_run().failures[0].reason, &parts);
}

#[test]
fn the_program_of_the_guide_runs() {
    let guide = include_str!("../../docs/add-a-filter.md");
    let start = guide.split("```toml\nname = \"my_engine\"").nth(1).unwrap();
    let manifest = format!("name = \"my_engine\"{}", start.split("```").next().unwrap());
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("bin")).unwrap();
    sandbox.put("my_engine/filter.toml", manifest);
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let line = "engine blur --filter velocity_gather --frame $1 --out $2 --exposure $4";
    let script = format!("[ $3 = --shutter ] && {program} {line}");
    write_script(&sandbox.path("bin/my_blur"), &script);
    let bin = sandbox.path("bin").display().to_string();
    let path = format!("{bin}:{}", std::env::var("PATH").unwrap());
    render(&sandbox);
    let mut command = sandbox.command(&blur("./my_engine"));
    assert_done(&command.env("PATH", path).output().unwrap());
    let outside = sandbox.read_color("b.exr");
    sandbox.execute(&blur("velocity_gather"));
    assert_eq!(outside, sandbox.read_color("b.exr"));
}

#[test]
fn a_program_gets_the_same_inputs_as_a_kernel() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    let lines = "command = ['./blur.sh', '{frame}', '{out}', '{exposure},{frame_index},{gain},{{}}']\n\
                 [[parameter]]\nname = 'gain'\nkind = 'real'\nrange = [0, 2]\ndefault = 0.25\ndoc = ''";
    write_lines(&sandbox, "told", lines);
    let script = "pwd > where; echo $3 > words; cp $1 given.exr; cp $1 $2; echo chatter";
    write_script(&sandbox.path("told/blur.sh"), script);
    let printed = sandbox.execute(&[&blur("./told")[..], &["--frame-index", "7"]].concat());
    // The program's output is kept apart, and it runs in its folder.
    assert_eq!(printed, "b.exr\n");
    let read = |name: &str| fs::read_to_string(sandbox.path("told").join(name)).unwrap();
    assert_eq!(read("words"), "0.5,7,0.25,{}\n");
    let [here, told] = [read("where").trim_end().into(), sandbox.path("told")]
        .map(|path: PathBuf| fs::canonicalize(path).unwrap());
    assert_eq!(here, told);
    let given = read_exr(&sandbox.path("told/given.exr")).unwrap();
    let names: Vec<&str> = given.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["B", "G", "R", "Z", "velocity.X", "velocity.Y"]);
    let attributes: Vec<&str> = given.attributes.keys().map(String::as_str).collect();
    let due = "exposure frame_index frames_per_second reprojection";
    assert_eq!(attributes, split(due));
    assert_eq!(given.get::<f64>("frames_per_second").unwrap(), 60.0);
    let frame = Frame::read(&sandbox.path("r/plate/frame.exr")).unwrap();
    let reprojection = Reprojection::from_exr(&given).unwrap();
    assert_eq!(reprojection, frame.reprojection);
    assert_eq!(given.get::<u32>("frame_index").unwrap(), 7);
    assert_eq!(given.color("").unwrap(), frame.color);
    assert_eq!(given.plane("Z").unwrap(), frame.depth);
    let x = given.plane("velocity.X").unwrap();
    assert_eq!(x, frame.velocity.map(|velocity| velocity[0]));
    assert_eq!(sandbox.read_color("b.exr"), frame.color);
}

/// Lines of shell scripts that end without a picture, and parts of the message.
const BROKEN_PROGRAMS: [(&str, &[&str]); 5] = [
    (
        "kill -9 $$",
        &["ended with signal: 9", "it printed nothing"],
    ),
    (
        "cp $0 $2",
        &["wrote an {out} that cannot be used: not a complete OpenEXR file"],
    ),
    (
        "cp ../odd.exr $2",
        &["wrote 5x4 pixels; the frame has 64x32"],
    ),
    (
        "cp ../nan.exr $2",
        &["wrote [NaN, NaN, NaN] at pixel (9, 3)", "finite"],
    ),
    (
        "cp ../no_green.exr $2",
        &[r#"wrote an {out} that cannot be used: lacks the channel "G""#],
    ),
];

/// Programs that cannot be started, and parts of the message.
const MISSING_PROGRAMS: [(&str, &[&str]); 3] = [
    (
        "no_such_program",
        &["`no_such_program` is not on the PATH", "./no_such_program"],
    ),
    ("./no_such_program", &["cannot be run in", "No such file"]),
    ("./filter.toml", &["cannot be run in", "Permission denied"]),
];

#[test]
fn failing_programs_name_their_error_and_leave_no_picture() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    let mut odd = ExrFile::new(5, 4);
    odd.push_color("", &Raster::filled(5, 4, [0.5; 3]));
    write_exr(&sandbox.path("odd.exr"), &odd).unwrap();
    let mut broken = ExrFile::new(64, 32);
    let pixels = Raster::from_fn(64, 32, |x, y| {
        [if (x, y) == (9, 3) { f32::NAN } else { 0.5 }; 3]
    });
    broken.push_color("", &pixels);
    write_exr(&sandbox.path("nan.exr"), &broken).unwrap();
    broken.channels.retain(|channel| channel.name != "G");
    write_exr(&sandbox.path("no_green.exr"), &broken).unwrap();
    let refuse = |lines: &str, parts: &[&str]| {
        sandbox.write_program("mine", lines, "");
        let output = sandbox.shuttertruth(&blur("./mine"));
        assert_refused(&output, 2, &["error: filter mine: "]);
        assert_refused(&output, 2, parts);
        assert!(!sandbox.path("b.exr").exists(), "{lines}");
        assert!(!stderr(&output).contains("line 2\n"), "ten lines are shown");
    };
    let lines = "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo line $i >&2; done; exit 7";
    let ended = "`./blur.sh frame.exr out.exr` ended with exit status: 7";
    let shown = "printed:\n  | line 3\n  | line 4\n";
    refuse(lines, &[ended, shown, "\n  | line 12\n"]);
    let parts = ["ended well, but wrote no {out}", "printed:\n  | done"];
    refuse("echo done", &parts);
    for (lines, parts) in BROKEN_PROGRAMS {
        refuse(lines, parts);
    }
    for (program, parts) in MISSING_PROGRAMS {
        let command = format!("command = [\"{program}\", \"{{frame}}\", \"{{out}}\"]");
        write_lines(&sandbox, "mine", &command);
        assert_refused(&sandbox.shuttertruth(&blur("./mine")), 2, parts);
    }
}

/// Shell lines that start two processes, which would run for minutes; `pid` names the second.
const SLEEPERS: &str = "sleep 300 & echo $! > pid.new; mv pid.new pid; sleep 300";

#[track_caller]
fn assert_ended(sandbox: &Sandbox) {
    // The kill was sent, and the system may need a moment.
    for _ in 0..500 {
        if sandbox.has_ended("slow/pid") {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("what the program started is still there");
}

#[test]
fn a_program_past_its_time_limit_is_stopped_with_its_children() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    // Enough time for a shell to write a line on a busy machine.
    sandbox.write_program("slow", SLEEPERS, "time_limit = 2");
    let parts = [
        "took longer than 2 s and was stopped",
        "time_limit",
        "slow/filter.toml",
    ];
    assert_refused(&sandbox.shuttertruth(&blur("./slow")), 2, &parts);
    assert_ended(&sandbox);
}

#[test]
fn a_signal_that_ends_the_program_ends_the_filter_too() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    sandbox.write_program("slow", SLEEPERS, "");
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let _ = fs::remove_file(sandbox.path("slow/pid"));
        // The tests themselves may run under nohup.
        let mut child = start_through(&sandbox, "env", &["--default-signal=HUP"]);
        wait_until(&mut child, || sandbox.path("slow/pid").exists());
        send(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(code), "{signal}");
        assert_ended(&sandbox);
        assert!(!sandbox.path("b.exr").exists());
    }
}

#[cfg(target_os = "linux")] // Elsewhere no system says which signals a process ignores.
#[test]
fn a_closed_terminal_does_not_end_what_nohup_started() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    sandbox.write_program("slow", SLEEPERS, "");
    let mut child = start_through(&sandbox, "nohup", &[]);
    wait_until(&mut child, || sandbox.path("slow/pid").exists());
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let mut lines = status.lines();
    let ignored = lines.find_map(|line| line.strip_prefix("SigIgn:\t"));
    let ignored = u64::from_str_radix(ignored.unwrap(), 16).unwrap();
    assert_eq!(ignored & 1, 1, "SIGHUP, the first signal, is not ignored");
    send(&child, "HUP");
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
    assert_ended(&sandbox);
}

/// Starts the program with the filter `slow` through another program that becomes it.
fn start_through(sandbox: &Sandbox, program: &str, words: &[&str]) -> Child {
    let command = sandbox.command(&blur("./slow"));
    let mut through = Command::new(program);
    (through.args(words).arg(command.get_program())).args(command.get_args());
    through.current_dir(command.get_current_dir().unwrap());
    let given = command.get_envs();
    through.envs(given.filter_map(|(key, value)| Some((key, value?))));
    through.stdout(Stdio::null()).spawn().unwrap()
}

/// Lines of a filter.toml without a usable command, and parts of the message.
const BAD_COMMANDS: [(&str, &[&str]); 15] = [
    ("command = []", &["filter.toml:4: command: is empty"]),
    (
        r#"command = [""]"#,
        &["filter.toml:4:", "the program, is empty"],
    ),
    (r#"command = "cp""#, &["filter.toml:4:", "sequence"]),
    (
        r#"command = ["cp", "{out}"]"#,
        &["filter.toml:4:", "{frame} is missing"],
    ),
    (
        r#"command = ["cp", "{frame}"]"#,
        &["filter.toml:4:", "{out} is missing"],
    ),
    (
        r#"command = ["cp", "{frame}", "{out}", "-m{shutter}"]"#,
        &[
            r#""-m{shutter}" holds the unknown {shutter}"#,
            "allowed: {frame}, {out}, {exposure}, {frame_index}, {frames_per_second}, and",
        ],
    ),
    (
        r#"command = ["cp", "{frame}", "{out}", "{"]"#,
        &[r#""{" has a brace without the other"#],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\n\
         [[parameter]]\nname = \"taps\"\nkind = \"integer\"\nrange = [1, 3]\ndefault = 2\ndoc = \"\"",
        &["filter.toml:4:", "{taps} is missing"],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\n\
         [[parameter]]\nname = \"exposure\"\nkind = \"integer\"\nrange = [1, 3]\ndefault = 2\ndoc = \"\"",
        &["{exposure} is already a value"],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\n[[pass]]\nentry = \"blur\"",
        &["filter.toml:5:", "neither [[pass]] nor [[texture]]"],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\ntime_limit = 0",
        &["filter.toml:5: time_limit = 0;", "above 0"],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\ntime_limit = nan",
        &["filter.toml:5: time_limit = NaN;"],
    ),
    (
        "command = [\"cp\", \"{frame}\", \"{out}\"]\ntime_limit = 1e9",
        &["at most 86400"],
    ),
    (
        "time_limit = -3\n[[pass]]\nentry = \"blur\"",
        &["filter.toml:4: time_limit = -3;", "above 0"],
    ),
    ("", &["neither a [[pass]] nor a command"]),
];

#[test]
fn bad_folders_of_programs_are_refused_with_the_line() {
    let sandbox = Sandbox::new();
    for (lines, parts) in BAD_COMMANDS {
        write_lines(&sandbox, "mine", lines);
        assert_refused(&sandbox.run(&["--filter", "mine"]), 2, parts);
        assert!(!sandbox.path("out").exists(), "{lines}");
    }
}
