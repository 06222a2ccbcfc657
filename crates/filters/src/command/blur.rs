//! Run of a filter that is a program, once per image.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command as Process;
use std::time::Duration;

use frame::{ExrFile, Image, read_passes, write_exr};
use process::{End, Limits, OutputFile, collect_environment, half_of_memory};

use super::output_tail::OutputTail;
use crate::filter::fill_placeholders;
use crate::input::{FRAMES_PER_SECOND, find_broken};
use crate::{Command, Filter, FilterError, Input, Settings};

/// Upper limit on the bytes per pixel that a program may write: 64 channels of 32 bits.
pub const BYTES_PER_PIXEL: u64 = 256;

/// Upper limit on the bytes that it may write besides those of the pixels.
pub const BESIDE_PIXELS: u64 = 1 << 20;

/// A filter that is a program, ready to run on images of one size.
///
/// Programs run one at a time. On Linux, every process that this one starts while a program runs
/// ends with the program.
#[derive(Debug)]
pub struct CommandBlur {
    filter: Filter,
    settings: Settings,
    size: [u32; 2],
}

impl CommandBlur {
    /// Prepares a filter that is a command, with its settings and a size in pixels.
    pub fn new(
        filter: &Filter,
        settings: &Settings,
        width: u32,
        height: u32,
    ) -> Result<Self, FilterError> {
        settings.check(filter)?;
        Ok(Self {
            filter: filter.clone(),
            settings: settings.clone(),
            size: [width, height],
        })
    }

    /// Blurs every colour image of the input, in order: one run of the program each.
    pub fn run(&self, input: &Input) -> Result<Vec<Image>, FilterError> {
        let camera = self.filter.camera_use(&self.settings);
        input.check(&self.filter, camera, self.size)?;
        (input.color.iter())
            .map(|color| self.blur(color, input))
            .collect()
    }

    fn blur(&self, color: &Image, input: &Input) -> Result<Image, FilterError> {
        let folder = create_private_folder().map_err(|error| self.refuse_frame_file(error))?;
        let place =
            std::path::absolute(folder.path()).map_err(|error| self.refuse_frame_file(error))?;
        let [frame, out] = ["frame.exr", "out.exr"].map(|name| place.join(name));
        write_exr(&frame, &make_frame_file(color, input))
            .map_err(|error| self.refuse_frame_file(error))?;
        let mut process = Process::new(if self.is_in_folder() {
            self.command().folder.join(self.program())
        } else {
            PathBuf::from(self.program())
        });
        process
            .args(self.arguments(input, &frame, &out))
            .current_dir(&self.command().folder)
            .env_clear()
            .envs(collect_environment(&self.command().environment));
        let (end, output) = (self.run_program(process, &out))
            .map_err(|error| self.refuse(self.describe_start_failure(&error)))?;
        let outcome = match end {
            End::Stopped => return Err(FilterError::Interrupted),
            End::OutOfTime => Err(format!(
                "took longer than {} s and was stopped; raise time_limit in {}",
                self.filter.time_limit,
                self.command().folder.join("filter.toml").display()
            )),
            End::TooLarge => Err(self.describe_too_large()),
            End::Exited(status) if !status.success() => Err(format!("ended with {status}")),
            End::Exited(_) => self.read(&out),
        };
        outcome.map_err(|reason| {
            // Files by name only, as in a shell: a reader will try files of their own.
            let words = self.arguments(input, Path::new("frame.exr"), Path::new("out.exr"));
            let said = match output.as_str() {
                "" => "; it printed nothing".to_owned(),
                output => format!("; the last that it printed:\n{output}"),
            };
            self.refuse(format!(
                "`{} {}` {reason}{said}",
                self.program(),
                words.join(" ")
            ))
        })
    }

    /// Runs the program, and reads what it prints; returns how it ended, and the last lines that it
    /// printed.
    fn run_program(&self, mut process: Process, out: &Path) -> std::io::Result<(End, String)> {
        let limits = Limits {
            time: Duration::from_secs_f64(self.filter.time_limit),
            memory: half_of_memory(),
            output: Some(OutputFile {
                path: out.to_owned(),
                bytes: self.max_bytes(),
            }),
            whole_tree: true,
        };
        let (output, pipe) = OutputTail::new()?;
        process.stdout(pipe.try_clone()?).stderr(pipe);
        let end = process::run(process, &limits)?;
        Ok((end, output.into_lines()))
    }

    fn command(&self) -> &Command {
        let command = self.filter.command.as_ref();
        command.expect("a filter that is a command has one")
    }

    fn program(&self) -> &str {
        &self.command().words[0]
    }

    fn is_in_folder(&self) -> bool {
        self.program().contains(['/', '\\'])
    }

    fn arguments(&self, input: &Input, frame: &Path, out: &Path) -> Vec<String> {
        let value = |name: &str| {
            Some(match name {
                "frame" => frame.display().to_string(),
                "out" => out.display().to_string(),
                "exposure" => input.exposure.to_string(),
                "frame_index" => input.frame_index.to_string(),
                "frames_per_second" => frames_per_second(input).to_string(),
                parameter => self.settings.values.get(parameter)?.to_string(),
            })
        };
        (self.command().words[1..].iter())
            .map(|word| {
                fill_placeholders(word, value).expect("placeholders were checked with filter.toml")
            })
            .collect()
    }

    fn max_bytes(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        BESIDE_PIXELS + BYTES_PER_PIXEL * width * height
    }

    fn describe_too_large(&self) -> String {
        let [width, height] = self.size;
        format!(
            "wrote an {{out}} of more than {} bytes and was stopped; {width}x{height} pixels may take {BYTES_PER_PIXEL} \
             bytes each, and {BESIDE_PIXELS} beside",
            self.max_bytes()
        )
    }

    /// Refuses anything but a regular file of bounded size. The program has ended, so nothing can
    /// replace the file.
    fn check_file(&self, out: &Path) -> Result<(), String> {
        let Ok(metadata) = std::fs::symlink_metadata(out) else {
            return Err(
                "ended well, but wrote no {out}; it must write an OpenEXR file of that very name"
                    .into(),
            );
        };
        if !metadata.is_file() {
            return Err(format!(
                "left {} in the place of {{out}}; it must write a regular file there",
                kind_of(&metadata)
            ));
        }
        if metadata.len() <= self.max_bytes() {
            Ok(())
        } else {
            Err(self.describe_too_large())
        }
    }

    /// Reads the picture that the program wrote, or says what is wrong with it.
    fn read(&self, out: &Path) -> Result<Image, String> {
        self.check_file(out)?;
        let color = read_passes(out).and_then(|file| file.color(""));
        let color = color
            .map_err(|error| format!("wrote an {{out}} that cannot be used: {}", error.reason()))?;
        let [width, height] = self.size;
        if [color.width, color.height] != [width, height] {
            return Err(format!(
                "wrote {}x{} pixels; the frame has {width}x{height}, and so must {{out}}",
                color.width, color.height
            ));
        }
        match find_broken(&color) {
            None => Ok(color),
            Some([x, y]) => Err(format!(
                "wrote {:?} at pixel ({x}, {y}); every value must be finite",
                color.at(x, y)
            )),
        }
    }

    fn describe_start_failure(&self, error: &std::io::Error) -> String {
        let program = self.program();
        let folder = self.command().folder.display();
        match (self.is_in_folder(), error.kind()) {
            (false, ErrorKind::NotFound) => format!(
                "`{program}` is not on the PATH; a program in {folder} is called ./{program}"
            ),
            (true, _) => format!(
                "`{program}` cannot be run in {folder}: {error}; it must be a program there"
            ),
            (false, _) => format!("`{program}` cannot be run: {error}"),
        }
    }

    fn refuse_frame_file(&self, error: impl std::fmt::Display) -> FilterError {
        self.refuse(format!("its frame cannot be written for it: {error}"))
    }

    fn refuse(&self, reason: String) -> FilterError {
        FilterError::Command {
            filter: self.filter.name.clone(),
            reason,
        }
    }
}

/// Creates a folder that only this user, and programs that run as this user, can read.
fn create_private_folder() -> std::io::Result<tempfile::TempDir> {
    let mut builder = tempfile::Builder::new();
    builder.prefix("shuttertruth-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o700));
    }
    builder.tempdir()
}

/// Names the kind of a file that is not regular.
fn kind_of(metadata: &std::fs::Metadata) -> &'static str {
    if metadata.is_dir() {
        return "a folder";
    }
    if metadata.is_symlink() {
        return "a link";
    }
    "a pipe or a device"
}

/// Returns the rate that a program gets.
fn frames_per_second(input: &Input) -> f64 {
    input.frames_per_second.unwrap_or(FRAMES_PER_SECOND)
}

/// Makes the file of a frame, with everything that kernels may read.
fn make_frame_file(color: &Image, input: &Input) -> ExrFile {
    let mut file = ExrFile::new(color.width, color.height);
    file.push_color("", color);
    file.push_plane("Z", input.depth);
    file.push_plane("velocity.X", &input.velocity.map(|v| v[0]));
    file.push_plane("velocity.Y", &input.velocity.map(|v| v[1]));
    if let Some(reprojection) = input.reprojection {
        reprojection.set(&mut file);
    }
    file.set("exposure", input.exposure);
    file.set("frames_per_second", frames_per_second(input));
    file.set("frame_index", input.frame_index);
    file
}
