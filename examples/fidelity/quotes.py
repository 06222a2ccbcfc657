"""Compares the lines of code that pages quote with the repositories themselves.

    python3 examples/fidelity/quotes.py --clones ~/clones results/findings/*.md

A page quotes lines in a table whose head names the repository and the commit:

    | line of `owner/name` at 0123456789abcdef0123456789abcdef01234567 | code |
    |---|---|
    | `path/to/file.c:12` | `int x = 1;` |

A quote must equal that line of that file, without the spaces around it. `--clones` holds the repositories as owner/name; quotes of those
that it lacks are listed and not compared. Ends with 1 if a quote differs, if a table has another form, or if nothing was compared.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

HEAD = re.compile(r"\| line of `([\w.-]+/[\w.-]+)` at ([0-9a-f]{40}) \| code \|")
ROW = re.compile(r"\| `([^`]+):([1-9]\d*)` \| (`+)(.+?)\3 \|")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clones", type=Path, required=True, help="folder that holds clones as owner/name")
    parser.add_argument("pages", type=Path, nargs="+", help="Markdown pages")
    arguments = parser.parse_args()
    quotes = [quote for page in arguments.pages for quote in read_quotes(page)]
    wrong, compared, missing = [], 0, set()
    for page, repository, commit, path, line, code in quotes:
        clone = arguments.clones / repository
        if not clone.exists():
            missing.add(repository)
            continue
        compared += 1
        text = read_line(clone, commit, path, line)
        if text != code:
            wrong.append(f"{page}: {repository} at {commit[:7]}, {path}:{line}: quoted `{code}`, found {text!r}")
    print(f"{compared} of {len(quotes)} quotes compared")
    if missing:
        print(f"not compared, for want of a clone: {', '.join(sorted(missing))}")
    if wrong:
        sys.exit("\n".join(wrong))
    if not compared:
        sys.exit(f"nothing was compared; clone a repository below {arguments.clones}, such as {next(iter(missing), 'owner/name')}")


def read_quotes(page):
    """Yields page, repository, commit, path, line and code of every quote."""
    source = None
    for number, text in enumerate(page.read_text().splitlines(), 1):
        if text.startswith("| line of"):
            source = HEAD.fullmatch(text)
            if not source:
                sys.exit(f"{page}:{number}: write | line of `owner/name` at 40 hexadecimal digits | code |")
        elif not text.startswith("|"):
            source = None
        elif source and not text.startswith("|---"):
            row = ROW.fullmatch(text)
            if not row:
                sys.exit(f"{page}:{number}: write | `path:line` | `code` |")
            yield page, *source.groups(), row[1], int(row[2]), row[4].strip().replace("\\|", "|")


def read_line(clone, commit, path, line):
    """Returns a line of a file without the spaces around it, or a sentence saying why there is none."""
    done = subprocess.run(["git", "-C", str(clone), "show", f"{commit}:{path}"], capture_output=True)
    if done.returncode != 0:
        return f"no file: {done.stderr.decode(errors='replace').strip()}"
    lines = done.stdout.decode(errors="replace").splitlines()
    return lines[line - 1].strip() if line <= len(lines) else f"no line: the file has {len(lines)}"


if __name__ == "__main__":
    main()
