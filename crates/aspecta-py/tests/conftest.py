"""What the tests share."""

import json
import subprocess
import sys
from typing import Any

import pytest

import aspecta

CATALOGUE = list(aspecta.catalogue())


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
