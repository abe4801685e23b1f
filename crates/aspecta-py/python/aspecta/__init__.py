"""Working modes, generalized aspects and uniqueness domains of parallel robots, proved with interval arithmetic.

>>> import aspecta
>>> robot = aspecta.Robot("five-bar")
>>> [s.mode for s in robot.ik([4, 7])]
['++', '+-', '--', '-+']

Lengths are in the robot's unit, angles in radians, legs count from 1. A working mode is written as the signs of B_jj, such
as ``"+-+"``. Answers that can stay undecided are ``True``, ``False`` or ``None``. Everything raised for bad input is an
:class:`Error`, which is a ``ValueError``.

The theory is Chablat & Wenger, *Mechanism and Machine Theory* 36(6), 2001.
"""

import json
from typing import Any

from aspecta import _input, _native
from aspecta._input import UnitWarning
from aspecta._native import Error, NoPlan
from aspecta.analysis import Analysis, Aspect
from aspecta.certificates import Certificate, verify
from aspecta.follow import Follower, InverseFollower, JointStep, Step
from aspecta.maps import Domains, Location, Map, Regions, Surface
from aspecta.paths import Motion, PathCheck, Plan
from aspecta.results import (
    AssemblyModes,
    Cusps,
    Exploration,
    JoinedSolutions,
    ModeGraph,
    State,
    Traversability,
    Verdict,
)
from aspecta.robot import Robot
from aspecta.solutions import Solution, SolutionList, Solutions

__version__ = _native.VERSION

__all__ = [
    "Analysis",
    "Aspect",
    "AssemblyModes",
    "Certificate",
    "Cusps",
    "Domains",
    "Error",
    "Exploration",
    "Follower",
    "InverseFollower",
    "JoinedSolutions",
    "JointStep",
    "Location",
    "Map",
    "ModeGraph",
    "Motion",
    "NoPlan",
    "PathCheck",
    "Plan",
    "Regions",
    "Robot",
    "Solution",
    "SolutionList",
    "Solutions",
    "State",
    "Step",
    "Surface",
    "Traversability",
    "UnitWarning",
    "Verdict",
    "catalogue",
    "schema",
    "set_threads",
    "verify",
]


def catalogue() -> dict[str, str]:
    """Return the robots that Aspecta knows: their names and titles.

    >>> catalogue()["five-bar"]
    'Five-bar RR-RRR of Chablat & Wenger'
    """
    return dict(_native.catalogue())


def schema() -> dict[str, Any]:
    """Return the JSON Schema of robot files, by which editors complete and check them.

    >>> schema()["title"]
    'Aspecta robot file'
    """
    return json.loads(_native.schema())  # type: ignore[no-any-return]


def set_threads(count: int | None) -> None:
    """Let work that begins from now on, in this process, have so many threads, at most 1024; ``None``: one a core. No result depends on it.

    >>> set_threads(1)
    >>> set_threads(None)
    """
    _native.set_threads(_input.whole("count", count, 1, 1024) or 0)
