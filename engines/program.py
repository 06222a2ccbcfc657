"""Calls of `shuttertruth`, which is on the PATH."""

import re
import subprocess
import sys


def shuttertruth(*words, allowed=(0,)):
    """Runs the program; returns what it printed. Ends with its words if its exit code is another than the allowed ones."""
    done = subprocess.run(["shuttertruth", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in allowed:
        sys.exit(f"shuttertruth {' '.join(map(str, words))}: {done.stdout}")
    return done.stdout


def audit(capture, *options, allowed=(0, 1)):
    """Audits a capture; returns the verdict, PASS, FAIL or UNDECIDED, and the findings, none if it passes."""
    said = shuttertruth("engine", "audit", capture, *options, allowed=allowed)
    verdict = re.search(r"^(PASS|FAIL|UNDECIDED)", said, re.M)
    if not verdict:
        sys.exit(f"{capture}: {said}")
    return verdict[1], [" ".join(text.split()) for text in re.findall(r"^  - (.*?)(?=^  - |^[A-Z])", said, re.M | re.S)]
