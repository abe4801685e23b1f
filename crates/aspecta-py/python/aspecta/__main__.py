"""``python -m aspecta``: the command."""

import sys

from aspecta._command import main

if __name__ == "__main__":
    sys.exit(main())
