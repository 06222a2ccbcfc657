//! Commands and files of a page.

/// Programs that begin a page's commands.
const PROGRAMS: &str = "shuttertruth cargo cat for make cp pip python3";

/// A step that the reader of a page takes.
pub enum Step {
    /// Writes a file, which the page names before a block of code.
    Write { path: String, text: String },
    /// Runs a command.
    Run(String),
}

/// Lists the reader's steps from top to bottom.
pub fn find_steps(page: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut prose = String::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let block = lines.by_ref().take_while(|line| *line != "```");
            let text: String = block.map(|line| format!("{line}\n")).collect();
            // A workflow is a command of its own, recognised by its first line.
            if line == "```yaml" {
                let first = text.lines().next().unwrap_or_default();
                steps.push(Step::Run(first.to_owned()));
            }
            steps.extend(find_file_name(&prose).map(|path| Step::Write { path, text }));
        } else if let Some(code) = line.strip_prefix("    ") {
            let mut command = code.to_owned();
            while let Some(head) = command.strip_suffix('\\') {
                command = head.to_owned() + lines.next().unwrap_or_default().trim_start();
            }
            steps.extend(find_command(&command));
        } else if line.is_empty() {
            // The name of a file is in the paragraph above its block.
            continue;
        } else {
            prose = read_paragraph(line, &mut lines);
            // A bare command name is a mention, not an example.
            let quoted = prose.split('`').skip(1).step_by(2);
            let shown = quoted.filter(|text| !is_name(text));
            steps.extend(shown.filter_map(find_command));
        }
    }
    steps
}

/// Joins the lines up to the next empty one.
fn read_paragraph<'a>(first: &str, lines: &mut impl Iterator<Item = &'a str>) -> String {
    let rest = lines.take_while(|line| !line.is_empty());
    rest.fold(first.to_owned(), |text, line| text + " " + line.trim())
}

/// Returns whether a text is at most the name of a command: `shuttertruth run`, `shuttertruth tune
/// search`.
fn is_name(text: &str) -> bool {
    const GROUPS: [&str; 4] = ["tune", "engine", "truths", "limits"];
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_in_group = words.get(1).is_some_and(|word| GROUPS.contains(word));
    words.len() <= if is_in_group { 3 } else { 2 }
}

/// Reads a line as a command without its comment, if it is one.
fn find_command(line: &str) -> Option<Step> {
    let command = line.split(" #").next()?.trim_end();
    let program = command.split(' ').next()?;
    // Other languages have loops, too.
    if program == "for" && !command.contains("; do") {
        return None;
    }
    (PROGRAMS.split(' ').any(|name| name == program)).then(|| Step::Run(command.to_owned()))
}

/// Finds the path in a paragraph such as "`my_blur/filter.toml` says what it is:".
fn find_file_name(paragraph: &str) -> Option<String> {
    let path = paragraph.strip_prefix('`')?.split('`').next()?;
    let is_file = path.contains('/') && path.contains('.') && !path.contains(' ');
    (is_file && paragraph.ends_with(':')).then(|| path.to_owned())
}
