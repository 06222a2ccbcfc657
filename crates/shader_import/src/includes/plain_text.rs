//! Text of a shader without comments and without lines that continue.

/// Makes the text that a compiler gets, and in which its includes are sought: lines that end with `\`
/// are joined, comments are removed, and lines keep their numbers. So both see the same includes.
pub fn make_plain(text: &str) -> String {
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let text = text.replace(['\u{b}', '\u{c}'], " ");
    let plain = remove_comments(&join_lines(&text.replace('\r', "\n")));
    let lines = plain.split('\n').map(drop_file_name);
    lines.collect::<Vec<_>>().join("\n")
}

/// Shortens `#line 3 "file"` to `#line 3`, so that no compiler looks for files next to that one.
fn drop_file_name(line: &str) -> &str {
    let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
    let is_number =
        |rest: &str| rest.starts_with("line") || rest.starts_with(|c: char| c.is_ascii_digit());
    match (directive.is_some_and(is_number), line.find('"')) {
        (true, Some(at)) => &line[..at],
        _ => line,
    }
}

/// Joins lines that end with `\`. Empty lines follow, so that the others keep their numbers.
fn join_lines(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    let mut pending = 0;
    for line in text.split_inclusive('\n') {
        match line.strip_suffix("\\\n") {
            Some(start) => {
                joined.push_str(start);
                pending += 1;
            }
            None => {
                joined.push_str(line);
                joined.extend(std::iter::repeat_n('\n', pending));
                pending = 0;
            }
        }
    }
    joined
}

/// Removes the comments of a text of joined lines, and keeps its lines. A directive continues after
/// a comment of several lines, and the comment's empty lines follow it.
fn remove_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut pending = 0;
    let mut rest = text.chars().peekable();
    let mut in_quotes = false;
    while let Some(c) = rest.next() {
        match (c, rest.peek().copied()) {
            ('/', Some('/')) if !in_quotes => while rest.next_if(|c| *c != '\n').is_some() {},
            ('/', Some('*')) if !in_quotes => {
                rest.next();
                plain.push(' ');
                let line = plain.rsplit('\n').next().unwrap_or_default();
                let is_directive = line.trim_start().starts_with(['#', '%']);
                let mut last = ' ';
                for c in rest.by_ref() {
                    match (c, is_directive) {
                        ('\n', true) => pending += 1,
                        ('\n', false) => plain.push(c),
                        _ => {}
                    }
                    if (last, c) == ('*', '/') {
                        break;
                    }
                    last = c;
                }
            }
            ('\\', Some(escaped)) if in_quotes && escaped != '\n' => {
                rest.next();
                plain.extend([c, escaped]);
            }
            _ => {
                in_quotes = c != '\n' && in_quotes ^ (c == '"');
                plain.push(c);
                if c == '\n' {
                    plain.extend(std::iter::repeat_n('\n', std::mem::take(&mut pending)));
                }
            }
        }
    }
    plain.extend(std::iter::repeat_n('\n', pending));
    plain
}
