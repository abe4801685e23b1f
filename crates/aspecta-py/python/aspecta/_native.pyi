"""The compiled part of the package: what computes. Private; its names change without notice."""

from collections.abc import Callable, Sequence
from typing import Any, Self, final

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Solution = tuple[_Array, _Array, str, float, float, bool, bool, tuple[int, ...]]
_Progress = Callable[[str, int, int], Any] | None
_Piece = tuple[list[str], list[list[float]], list[list[float]]]
_Planned = tuple[str, str, list[_Piece]]
_Wanted = tuple[float, float, float]
_Asked = tuple[str, float, float]
_Effort = tuple[int, float | None]
_Surface = tuple[str, _Array, NDArray[np.uint32], NDArray[np.uint8], list[str], _Array, _Array]

__all__ = [
    "Analysis",
    "Error",
    "Follower",
    "InverseFollower",
    "Map",
    "NoPlan",
    "Partial",
    "Robot",
    "MAX_DEPTH",
    "VERSION",
    "catalogue",
    "coarse_depth",
    "check_joints",
    "check_poses",
    "cusps",
    "explore",
    "join_solutions",
    "plan_over_roadmap",
    "run_command",
    "schema",
    "set_threads",
    "trajectory",
    "verify",
    "write",
]

MAX_DEPTH: int
VERSION: str

class Error(ValueError): ...

class NoPlan(Error):
    #: Whether it is proved that there is no motion.
    proved: bool
    #: Whether finer boxes may find one.
    finer: bool

@final
class Partial:
    def wait(self) -> Any: ...

@final
class Robot:
    text: str
    name: str
    title: str
    length_unit: str
    platform: str
    dof: int
    coordinates: list[tuple[str, bool]]
    joint_angles: list[bool]
    modes: list[str]
    @staticmethod
    def from_toml(text: str, file: str) -> Robot: ...
    @staticmethod
    def resolve(name_or_path: str) -> Robot: ...
    def signs(self, mode: str) -> str: ...
    def words(self, mode: str) -> str | None: ...
    def beyond(self, pose: list[float], mode: str) -> list[str]: ...
    @staticmethod
    def load(path: str) -> Robot: ...
    def json(self) -> str: ...
    def mixed_units(self) -> tuple[str, float, str, float] | None: ...
    def inverse_one(self, pose: _Array) -> list[_Solution]: ...
    def direct_one(self, q: _Array) -> tuple[list[_Solution], bool]: ...
    def inverse(self, poses: _Array) -> dict[str, Any]: ...
    def direct(self, joints: _Array) -> dict[str, Any]: ...
    def state(self, pose: list[float], q: list[float]) -> str: ...
    def analyze(
        self,
        fix: list[tuple[int, float]],
        modes: list[str],
        seconds: float | None,
        boxes: int | None,
        depth: int | None,
        resolution: float | None,
        certificate: bool,
        numbers_only: bool,
        progress: _Progress,
    ) -> Analysis: ...
    def plan_without_aspects(self, ends: list[list[float]], mode: str, wanted: _Wanted) -> _Planned | None: ...
    def mjcf(self, pose: list[float] | None, mode: str | None) -> tuple[str, list[str]]: ...

@final
class Analysis:
    axes: list[int]
    def json(self) -> str: ...
    def text(self, degrees: bool) -> str: ...
    def class_of(self, mode: str, det_a: float) -> int | None: ...
    def aspect_at(self, pose: list[float], class_: int) -> int | None: ...
    def cells(self, class_: int) -> tuple[list[list[float]], list[list[float]], list[int]]: ...
    def certificate(self) -> str | None: ...
    def report(self, directory: str) -> list[str]: ...
    def picture(self) -> str | None: ...
    def domains(
        self,
        aspects: list[int],
        cells: int | None,
        samples: int | None,
        surfaces: bool | None,
        seconds: float | None,
        progress: _Progress,
    ) -> Map: ...
    def modes(self, seconds: float | None, progress: _Progress) -> tuple[str, str]: ...
    def traverse(
        self,
        kind: str,
        ranges: list[tuple[float, float]],
        round: list[int],
        radius: float,
        lists: list[list[list[float]]],
        through_modes: bool,
        progress: _Progress,
    ) -> str: ...
    def assembly(self, q: list[float]) -> str: ...
    def plan(
        self,
        ends: list[list[float]],
        modes: list[str],
        through: bool,
        wanted: _Wanted,
        seconds: float | None,
        progress: _Progress,
    ) -> _Planned: ...

@final
class Map:
    robot: tuple[str, str]
    dof: int
    aspects: list[int]
    @staticmethod
    def load(path: str) -> Map: ...
    @staticmethod
    def from_bytes(file: bytes) -> Map: ...
    def to_bytes(self) -> bytes: ...
    coordinates: list[str]
    #: The pose coordinates with their units, by name.
    labels: dict[str, str]
    def domains(self, aspect: int) -> tuple[str, str] | None: ...
    def grid(self, aspect: int) -> tuple[list[int], list[float], list[float], list[int], NDArray[np.int64]] | None: ...
    def surfaces(self, aspect: int) -> list[_Surface] | None: ...
    def picture(self, aspect: int) -> str | None: ...
    def draw(self, aspect: int, directory: str, meshes: list[str], held: int) -> list[str] | None: ...
    def locate(self, poses: _Array, mode: str) -> list[tuple[int, int, int, list[int], str | None]]: ...

@final
class Follower:
    pose: list[float]
    q: list[float]
    mode: str
    def __new__(cls, robot: Robot, pose: list[float], q: list[float]) -> Self: ...
    def step(self, q: _Array) -> tuple[_Array, str, bool, bool, float, float, int]: ...

@final
class InverseFollower:
    pose: list[float]
    q: list[float]
    mode: str
    def __new__(cls, robot: Robot, pose: list[float], mode: str) -> Self: ...
    def step(self, pose: _Array) -> tuple[_Array, bool, bool, int]: ...

def catalogue() -> list[tuple[str, str]]: ...
def coarse_depth(free: int) -> int: ...
def write(path: str, content: bytes) -> None: ...
def schema() -> str: ...
def set_threads(count: int) -> None: ...
def run_command(arguments: Sequence[str]) -> int: ...
def check_poses(robot: Robot, poses: list[list[float]], mode: str, asked: _Asked) -> tuple[str, str]: ...
def check_joints(
    robot: Robot, joints: list[list[float]], start: list[float] | None, asked: _Asked
) -> tuple[str, str]: ...
def trajectory(pieces: list[_Piece], speed: list[float], acceleration: list[float], rate: float) -> str: ...
def explore(robot: Robot, modes: list[str], effort: _Effort, progress: _Progress) -> str: ...
def join_solutions(robot: Robot, q: list[float], effort: _Effort, progress: _Progress) -> str: ...
def plan_over_roadmap(
    robot: Robot, ends: list[list[float]], mode: str, wanted: _Wanted, effort: _Effort, progress: _Progress
) -> _Planned: ...
def cusps(
    robot: Robot,
    fix: list[tuple[int, float]],
    mode: str | None,
    boxes: int | None,
    seconds: float | None,
    progress: _Progress,
) -> str: ...
def verify(certificate: bytes, seconds: float | None, progress: _Progress) -> tuple[str, str]: ...
