//! Escapes for text that others wrote, so that Markdown shows it as text: GitHub's, and that of a
//! site's pages.

use crate::text::printable::printable;

/// Characters with a meaning within a line: of code, tables, emphasis, links, HTML, entities,
/// strikethrough and a site's includes.
const INLINE: &str = "\\`|*[]<>&~{}";
/// Characters that make a heading or a rule at the beginning of a line. Signs of numbers, which
/// make lists, are apart.
const LEADING: &str = "#=_";

/// Escapes text for a line, a cell or the words of a link: it stays on one line, and no part of it
/// makes a link, a picture, HTML or another block. Addresses stay as text.
pub fn escape_markdown(text: &str) -> String {
    let line = text.trim().replace('\n', " ");
    let line: Vec<char> = printable(&line).chars().collect();
    let digits = line
        .iter()
        .take_while(|letter| letter.is_ascii_digit())
        .count();
    let mut escaped = String::with_capacity(line.len());
    let mut before = ' ';
    for (at, &letter) in line.iter().enumerate() {
        let next = line.get(at + 1);
        let begins_block = at == 0
            && (LEADING.contains(letter)
                || "+-".contains(letter) && !next.is_some_and(char::is_ascii_digit));
        let begins_item = digits > 0
            && at == digits
            && matches!(letter, '.' | ')')
            && next.is_none_or(|next| *next == ' ');
        // What follows a bracket is no address, for simple readers too.
        let begins_address = before == ']' && letter == '(';
        if INLINE.contains(letter) || begins_block || begins_item || begins_address {
            escaped.push('\\');
        }
        escaped.push(letter);
        before = letter;
    }
    escaped
}

/// Formats a name as code, or as escaped text if it has a character that may end the code or its
/// cell.
pub fn markdown_code(name: &str) -> String {
    let escaped = escape_markdown(name);
    if escaped == name && !name.is_empty() {
        return format!("`{name}`");
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_others_makes_no_link_no_html_and_no_block() {
        for (text, expected) in [
            (
                "llvmpipe (LLVM 15.0.6, 256 bits)",
                "llvmpipe (LLVM 15.0.6, 256 bits)",
            ),
            ("two_spheres / kino:default", "two_spheres / kino:default"),
            (
                "![a](b)<img src=c> `d`\ne|f",
                "!\\[a\\]\\(b)\\<img src=c\\> \\`d\\` e\\|f",
            ),
            ("a](javascript:b)", "a\\]\\(javascript:b)"),
            ("<script>a&lt;</script>", "\\<script\\>a\\&lt;\\</script\\>"),
            ("{{#include x}}", "\\{\\{#include x\\}\\}"),
            ("\\`a\\|", "\\\\\\`a\\\\\\|"),
            ("# a", "\\# a"),
            ("- a", "\\- a"),
            ("12. a", "12\\. a"),
            ("1.5 m", "1.5 m"),
            ("-0.5 to 1", "-0.5 to 1"),
            ("---", "\\---"),
            ("C:\\new", "C:\\\\new"),
            ("a\r\u{1b}[2J", "a\\\\r\\\\u001b\\[2J"),
        ] {
            assert_eq!(escape_markdown(text), expected);
        }
    }

    #[test]
    fn a_name_that_would_end_its_code_is_text() {
        assert_eq!(markdown_code("kino:default"), "`kino:default`");
        assert_eq!(markdown_code("a`<b>|"), "a\\`\\<b\\>\\|");
        assert_eq!(markdown_code("a\nb"), "a b");
    }
}
