"""What the tests share."""

import json
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import aspecta

CATALOGUE = list(aspecta.catalogue())
#: A pose of each within its limits.
POSES = {
    "five-bar": [4, 7],
    "symmetric-five-bar": [0, 100],
    "2-prr": [0, 200],
    "3-rrr": [-15.468, 0.781, 0.073],
    "3-prr": [0, 0, 0.8],
    "3-rpr": [-8, 9, 0],
    "delta": [10, 20, -900],
    "irb-360": [10, 20, -1000],
    "linear-delta": [0, 0, 50],
    "orthoglide": [1, 2, 3],
    "spherical-3-rrr": [0.1, 0, 0.2],
    "hexa": [10, 0, -700, 0.1, 0, 0],
    "gough-stewart": [0.2, 0.1, 0.9, 0.5, 1.4, 0.2],
}


def text(numbers: Any) -> str:
    """Numbers as the command takes them."""
    return ",".join(map(repr, np.asarray(numbers, dtype=float).tolist()))


def command(*arguments: str, stdin: str | None = None) -> subprocess.CompletedProcess[str]:
    """Run the command ``aspecta`` that the package carries."""
    line = [sys.executable, "-m", "aspecta", *arguments]
    return subprocess.run(line, input=stdin, capture_output=True, text=True, check=False)


def answer(*arguments: str, stdin: str | None = None) -> Any:
    """Return what the command says as JSON."""
    return json.loads(command(*arguments, "--json", stdin=stdin).stdout)


@pytest.fixture(scope="session")
def five_bar() -> aspecta.Robot:
    return aspecta.Robot("five-bar")


@pytest.fixture(scope="session")
def analysis(five_bar: aspecta.Robot) -> aspecta.Analysis:
    return five_bar.analyze()
