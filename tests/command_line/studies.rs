//! The tables of results/studies, against what their commands printed, which is kept next to each
//! page.

use std::fs;
use std::path::Path;

use tests::root;
use tests::text::squeeze;

/// Returns the names between backticks.
fn list_names(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}

/// Returns true for a score with three digits after the point, with or without a sign.
fn is_score(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['+', '-']);
    digits.len() == 5 && &digits[1..2] == "." && digits.parse::<f64>().is_ok()
}

/// Splits text into words.
fn split(text: &str) -> Vec<&str> {
    let is_gap = |c: char| c.is_whitespace() || c == ',';
    text.split(is_gap).filter(|word| !word.is_empty()).collect()
}

/// Returns true if a row of a printed table has a score. Of the names of the row and of its column,
/// each is in the row's label or in the table's head; the label names no other form of the input.
fn is_printed(printed: &str, column: &[&str], row: &[&str], score: &str) -> bool {
    let (mut head, mut label) = (Vec::new(), Vec::new());
    for line in printed.lines() {
        let words = split(line);
        let numbers = (words.iter().rev())
            .take_while(|word| {
                !word.contains(':') && word.parse::<f64>().is_ok() || **word == "n/a"
            })
            .count();
        if line.is_empty() || !line.starts_with(' ') {
            (head, label) = (words, Vec::new());
            continue;
        }
        label.extend(&words[..words.len() - numbers]);
        let scores = &words[words.len() - numbers..];
        let mut names = column.iter().chain(row);
        let has_names = names.all(|name| label.contains(name) || head.contains(name));
        let mut forms = label.iter().filter(|word| word.contains('='));
        let has_form = forms.all(|form| row.contains(form));
        // Columns are counted from the right. Without the column's name in its head, a table begins
        // with FLIP.
        let place = head.iter().rev().position(|word| column.contains(word));
        let cell = match place {
            Some(place) => scores.iter().rev().nth(place),
            None => words.iter().find(|word| is_score(word)),
        };
        if has_names && has_form && cell.is_some_and(|text| text.trim_start_matches('+') == score) {
            return true;
        }
        if numbers > 0 || words.iter().any(|word| is_score(word)) {
            label.clear();
        }
    }
    false
}

/// Checks every score in the tables of a page; returns their count.
fn check_page(page: &Path, printed: &str) -> usize {
    let text = fs::read_to_string(page).unwrap();
    let tables = text.split("\n\n").filter(|block| block.starts_with("| "));
    let mut count = 0;
    for table in tables {
        let rows = table.lines().map(|line| line.trim_matches('|').split('|'));
        let mut rows = rows.map(|cells| cells.map(str::trim).collect::<Vec<_>>());
        let head = rows.next().unwrap();
        for cells in rows.skip(1) {
            let scores = cells.iter().enumerate().filter(|(_, cell)| is_score(cell));
            for (column, score) in scores {
                let others = cells.iter().filter(|cell| !is_score(cell));
                let row: Vec<&str> = others.flat_map(|cell| list_names(cell)).collect();
                let number = score.trim_start_matches('+');
                let name = page.display();
                assert!(
                    is_printed(printed, &list_names(head[column]), &row, number),
                    "{name}: no command printed {score} for {row:?} in column {}",
                    head[column]
                );
                count += 1;
            }
        }
    }
    count
}

#[test]
fn the_tables_of_studies_are_what_their_commands_printed() {
    let mut pages = 0;
    for entry in fs::read_dir(root().join("results/studies")).unwrap() {
        let kept = entry.unwrap().path();
        if kept.extension().is_some_and(|extension| extension == "txt")
            && !["mutation.txt", "intervals.txt"]
                .iter()
                .any(|other| kept.ends_with(other))
        {
            let printed = fs::read_to_string(&kept).unwrap();
            let count = check_page(&kept.with_extension("md"), &printed);
            assert!(count > 3, "{}: {count} scores", kept.display());
            pages += 1;
        }
    }
    assert!(pages >= 2, "only {pages} pages");
}

#[test]
fn the_counts_of_intervals_are_what_their_command_printed() {
    let folder = root().join("results/studies");
    let [page, printed] = ["intervals.md", "intervals.txt"]
        .map(|name| fs::read_to_string(folder.join(name)).unwrap());
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).collect();
    assert!(rows.len() > 8, "{rows:?}");
    for row in rows {
        let is_printed = printed.lines().any(|line| line == row);
        assert!(is_printed, "no command printed {row}");
    }
    let all = printed.lines().find(|line| line.starts_with("| all"));
    let all = all.unwrap().split('|').map(str::trim);
    let [count, below, over] = [2, 4, 5].map(|at| all.clone().nth(at).unwrap());
    let by_chance = chance_of_few() * count.parse::<f64>().unwrap();
    let words = squeeze(&page);
    for said in [
        format!("{count} score series have noise. {below} of them have fewer than 90 %"),
        format!("{by_chance:.0} would by chance"),
        format!("{over} have over 97 %"),
    ] {
        assert!(words.contains(&said), "{said}");
    }
}

/// Returns the probability that fewer than 90 % of 48 intervals hold their score, if each holds it
/// in 95 %.
fn chance_of_few() -> f64 {
    let few = (0..=43).map(|held| {
        let ways: f64 = (1..=held)
            .map(|k| f64::from(49 - k) / f64::from(k))
            .product();
        ways * 0.95_f64.powi(held) * 0.05_f64.powi(48 - held)
    });
    few.sum()
}

#[test]
fn the_mutation_score_is_what_its_command_printed() {
    let folder = root().join("results/studies");
    let [page, printed] =
        ["mutation.md", "mutation.txt"].map(|name| fs::read_to_string(folder.join(name)).unwrap());
    let lines: Vec<String> = printed.lines().map(squeeze).collect();
    let rows = page.lines().filter(|line| line.starts_with("| "));
    let mut counts = [0, 0];
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        match cells[..] {
            [filter, killed, share] if killed.contains(" of ") => {
                let score = format!("{}: {killed} killed, {share}", list_names(filter)[0]);
                assert!(lines.contains(&score), "{row}");
                counts[0] += 1;
            }
            [_, total, ..] if total.parse::<u32>().is_ok() => {
                assert!(lines.contains(&cells.join(" ")), "{row}");
                counts[1] += 1;
            }
            _ => {}
        }
    }
    assert_eq!(counts, [3, 6]);
}

#[test]
fn a_score_that_no_command_printed_is_noticed() {
    let printed = "form of the input   a:one   b:two
  buffers=half          0.101  -0.202
  a_long=label
                       +0.303   0.304

scene / filter   FLIP skill
fan, centred shutter
  b:two         0.505  0.60 <1
  b:two a=b
                0.506  0.61 <1
  c:three       0.507";
    let is = |column, row: &[&str], score| is_printed(printed, &[column], row, score);
    assert!(is("b:two", &["buffers=half"], "-0.202") && is("a:one", &["a_long=label"], "0.303"));
    assert!(is("b:two", &["fan"], "0.505") && is("b:two", &["fan", "a=b"], "0.506"));
    assert!(!is("a:one", &["buffers=half"], "-0.202"), "another column");
    assert!(!is("a:one", &["buffers=half"], "0.303"), "another row");
    assert!(!is("b:two", &["fan"], "0.506"), "another form");
    assert!(!is("b:two", &["fan"], "0.507"), "another filter");
    assert!(!is("b:two", &["roll"], "0.505"), "another scene");
}
