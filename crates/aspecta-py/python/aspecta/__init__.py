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

from aspecta import _native
from aspecta._input import UnitWarning
from aspecta._native import Error, NoPlan
from aspecta.analysis import Analysis, Aspect
from aspecta.certificates import Certificate, verify
from aspecta.follow import Follower, InverseFollower, JointStep, Step
from aspecta.maps import Domains, Location, Map
from aspecta.results import (
    AssemblyModes,
    Cusps,
    Exploration,
    JoinedSolutions,
    ModeGraph,
    Motion,
    PathCheck,
    Plan,
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
    "Robot",
    "Solution",
    "SolutionList",
    "Solutions",
    "State",
    "Step",
    "Traversability",
    "UnitWarning",
    "Verdict",
    "catalogue",
    "verify",
]


def catalogue() -> dict[str, str]:
    """Return the robots that Aspecta knows: their names and titles.

    >>> catalogue()["five-bar"]
    'Five-bar RR-RRR of Chablat & Wenger'
    """
    return dict(_native.catalogue())
