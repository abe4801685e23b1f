"""The command ``aspecta``, as the wheel installs it: the compiled library is both."""

import signal
import sys

from aspecta import _native


def main() -> int:
    """Run the command line with the arguments of this process; return its exit status."""
    # Ctrl-C and closed pipes are the command's own affair.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.run_command(["aspecta", *sys.argv[1:]])
