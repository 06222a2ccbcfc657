"""The program `shuttertruth`: `python -m shuttertruth --help`."""

import signal
import sys

from . import _native


def main() -> None:
    """Runs the command line, and exits with its code."""
    # The program handles Ctrl-C itself: finished files are kept.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_native.run_program(["shuttertruth", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
