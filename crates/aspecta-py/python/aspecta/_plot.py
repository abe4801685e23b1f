"""Pictures with matplotlib, which is needed here only."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from aspecta import _native

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from aspecta.analysis import Analysis
    from aspecta.results import PathCheck

#: Undecided cells.
_GREY = "0.8"
#: Cells whose images are drawn in joint space, at most.
_MOST_IMAGES = 20_000


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("pictures need matplotlib: pip install 'aspecta[plot]'") from None
    return plt.subplots()[1]


def _colour(number: int) -> str:
    return f"C{(number - 1) % 10}"


def aspects(analysis: Analysis, ax: Axes | None, mode: str | None, space: str, at: Mapping[str, float]) -> Axes:
    """Draw the aspects of an analysis."""
    ax = _axes(ax)
    names = [analysis.robot.pose_names[k] for k in analysis._boxes().axes]
    unknown = set(at) - set(names)
    if unknown:
        raise _native.Error(f"at: `{min(unknown)}` does not vary here; {', '.join(names)} do")
    drawn: set[int] = set()
    for c in analysis.classes:
        if mode not in (None, c["mode"]):
            continue
        lo, hi, aspect = analysis.cells(c["mode"], c["det_a"])
        for name, value in at.items():
            k = names.index(name)
            kept = (lo[:, k] <= value) & (value < hi[:, k])
            lo, hi, aspect = lo[kept], hi[kept], aspect[kept]
        free = [k for k, name in enumerate(names) if name not in at]
        for number in sorted(set(aspect.tolist())):
            some = aspect == number
            label = None if number in drawn or number == 0 else f"{number}: {c['mode']} det A {c['det_a']}"
            if space == "joint":
                _images(ax, analysis, c["mode"], lo[some], hi[some], number, label, at)
            else:
                _cells(ax, lo[some][:, free], hi[some][:, free], number, label)
            drawn.add(number)
    shown = analysis.robot.joint_names if space == "joint" else [n for n in names if n not in at]
    ax.set_xlabel(shown[0])
    if len(shown) > 1:
        ax.set_ylabel(shown[1])
    ax.autoscale_view()
    if space == "pose" and len(shown) == 2 and {"x", "y", "z"}.issuperset(shown):
        ax.set_aspect("equal")
    if drawn - {0}:
        ax.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1, 1))
    return ax


def _cells(ax: Axes, lo: Any, hi: Any, number: int, label: str | None) -> None:
    """Cells as rectangles; of one coordinate, bars at the height of the aspect."""
    from matplotlib.collections import PolyCollection

    if lo.shape[1] > 2:
        raise _native.Error("three coordinates vary: cut at one of them, such as at={\"phi\": 0}")
    if lo.shape[1] == 1:
        one = np.ones(len(lo))
        lo, hi = np.column_stack([lo, (number - 0.4) * one]), np.column_stack([hi, (number + 0.4) * one])
    corners = np.stack(
        [lo, np.column_stack([hi[:, 0], lo[:, 1]]), hi, np.column_stack([lo[:, 0], hi[:, 1]])], axis=1
    )
    colour = _colour(number) if number else _GREY
    ax.add_collection(PolyCollection(list(corners), facecolor=colour, edgecolor="none", alpha=0.6 if number else 1, label=label))


def _images(ax: Axes, analysis: Analysis, mode: str, lo: Any, hi: Any, number: int, label: str | None, at: Mapping[str, float]) -> None:
    """The middles of cells in joint space (q1, q2)."""
    if number == 0:
        return
    step = -(-len(lo) // _MOST_IMAGES)
    free, held = analysis._boxes().axes, analysis.to_dict()["fixed"]
    poses = np.zeros((len(lo[::step]), analysis.robot.dof))
    poses[:, free] = 0.5 * (lo + hi)[::step]
    for coordinate in held:
        poses[:, analysis.robot.pose_names.index(coordinate["coordinate"])] = coordinate["value"]
    for name, value in at.items():
        poses[:, analysis.robot.pose_names.index(name)] = value
    q = analysis.robot.ik(poses, mode=mode).q
    ax.plot(q[:, 0], q[:, 1], ".", markersize=1, color=_colour(number), label=label)


def profile(check: PathCheck, ax: Axes | None) -> Axes:
    """Draw det A and the B_jj along a path (figure 11)."""
    ax = _axes(ax)
    points = check.profile
    if not points:
        raise _native.Error("there is no path to draw: its start is out of reach")
    along = [p["segment"] - 1 + p["t"] for p in points]
    ax.plot(along, [p["relative_det_a"] for p in points], label="det A")
    for j in range(len(points[0]["relative_b"])):
        ax.plot(along, [p["relative_b"][j] for p in points], "--", label=f"B_{j + 1}{j + 1}")
    ax.axhline(0, color="0.6", linewidth=0.8)
    ax.set_xlabel("segment")
    ax.set_ylabel("relative to the largest")
    ax.legend(fontsize="small")
    return ax
