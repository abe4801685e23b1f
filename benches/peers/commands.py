"""How the comparisons run other programs."""

import os
import signal
import subprocess
import sys


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def output(command, what, given=None, **options):
    """Standard output of a command that has to succeed. Its descendants end with this program."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    child = subprocess.Popen(command, text=True, start_new_session=True, **pipes, **options)
    try:
        printed, complaints = child.communicate(given)
    except BaseException:
        os.killpg(child.pid, signal.SIGKILL)
        raise
    if child.returncode != 0:
        fail(f"{what} failed:\n{complaints.strip()[-2000:]}")
    return printed
