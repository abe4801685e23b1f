"""Pictures with matplotlib, which is needed here only."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from aspecta import _native
from aspecta._table import counted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from aspecta.analysis import Analysis
    from aspecta.maps import Domains
    from aspecta.paths import PathCheck

#: Undecided cells.
_GREY = "0.8"
#: Squares across an aspect whose images are drawn in joint space.
_GRID = 150
#: Cells near its border whose middles are drawn there.
_MOST_MIDDLES = 30_000
#: Regions that a legend names.
_NAMED = 12


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
    drawn: set[int] = set()
    for c in analysis.classes:
        if mode not in (None, c["mode"]):
            continue
        lo, hi, aspect = analysis.cells(c["mode"], c["det_a"])
        for name, value in at.items():
            k = names.index(name)
            # At the upper end of all, the last ones.
            kept = (lo[:, k] <= value) & ((value < hi[:, k]) | (value == hi.max(axis=0, initial=value)[k]))
            lo, hi, aspect = lo[kept], hi[kept], aspect[kept]
        free = [k for k, name in enumerate(names) if name not in at]
        for number in sorted(set(aspect.tolist())):
            some = aspect == number
            known = f"{number}: {c['mode']} det A {c['det_a']}" if number else "undecided"
            label = None if number in drawn else known
            if space == "joint":
                _images(ax, analysis, c["mode"], lo[some], hi[some], number, label, at)
            else:
                _cells(ax, lo[some][:, free], hi[some][:, free], number, label)
            drawn.add(number)
    robot = analysis.robot
    shown = [robot.pose_names.index(name) for name in names if name not in at]
    labels = robot._joint_labels if space == "joint" else [robot._pose_labels[k] for k in shown]
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1] if len(labels) > 1 else "aspect")
    ax.autoscale_view()
    if space == "pose" and len(shown) == 2 and {"x", "y", "z"}.issuperset(robot.pose_names[k] for k in shown):
        ax.set_aspect("equal")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1, 1))
    return ax


def _cells(ax: Axes, lo: Any, hi: Any, number: int, label: str | None) -> None:
    """Cells as rectangles; of one coordinate, bars at the height of the aspect."""
    from matplotlib.collections import PolyCollection

    if lo.shape[1] > 2:
        raise _native.Error('three coordinates vary: cut at one of them, such as at={"phi": 0}')
    if lo.shape[1] == 1:
        one = np.ones(len(lo))
        lo, hi = np.column_stack([lo, (number - 0.4) * one]), np.column_stack([hi, (number + 0.4) * one])
    corners = np.stack([lo, np.column_stack([hi[:, 0], lo[:, 1]]), hi, np.column_stack([lo[:, 0], hi[:, 1]])], axis=1)
    colour = _colour(number) if number else _GREY
    ax.add_collection(
        # What is undecided in one class hides no aspect of another.
        PolyCollection(
            list(corners),
            facecolor=colour,
            edgecolor="none",
            alpha=0.6 if number else 1,
            zorder=1 if number else 0.5,
            label=label,
        )
    )


def _images(
    ax: Axes, analysis: Analysis, mode: str, lo: Any, hi: Any, number: int, label: str | None, at: Mapping[str, float]
) -> None:
    """The image of an aspect in joint space (q1, q2): that of a grid, square by square."""
    from matplotlib.collections import PolyCollection

    robot, names = analysis.robot, analysis.robot.pose_names
    free = [k for k in analysis._boxes().axes if names[k] not in at]
    if number == 0 or len(lo) == 0:
        return
    if len(free) != 2:
        raise _native.Error(f"{len(free)} coordinates vary: images in joint space are drawn where two do")
    columns = [analysis._boxes().axes.index(k) for k in free]
    lo, hi = lo[:, columns], hi[:, columns]

    def joints(pairs: Any) -> Any:
        """q1 and q2 at values (n, 2) of the free coordinates; nan where the legs do not reach, to rounding."""
        poses = np.zeros((len(pairs), robot.dof))
        for held in analysis.fixed:
            poses[:, names.index(held["coordinate"])] = held["value"]
        for name, value in at.items():
            poses[:, names.index(name)] = value
        poses[:, free] = pairs
        batch, q = robot.ik(poses, mode=mode), np.full((len(pairs), 2), np.nan)
        q[batch.row] = batch.q[:, :2]
        return q

    corners = joints(_squares(lo, hi).reshape(-1, 2)).reshape(-1, 4, 2)
    # Those that a full turn tears apart are left out.
    whole = (np.ptp(corners, axis=1) < np.pi).all(axis=1)
    style: dict[str, Any] = {"facecolor": _colour(number), "edgecolor": "face", "linewidth": 0.3}
    ax.add_collection(PolyCollection(list(corners[whole]), label=label, **style))
    # The cells are the finer the nearer they are to the border: their middles make it sharp.
    middles = 0.5 * (lo + hi)[:: -(-len(lo) // _MOST_MIDDLES)]
    ax.plot(*joints(middles).T, ".", markersize=1, color=_colour(number))


def _squares(lo: Any, hi: Any) -> Any:
    """The corners (n, 4, 2) of the squares of an even grid of which cells hold all four."""
    low, high = lo.min(axis=0), hi.max(axis=0)
    step = (high - low) / _GRID
    inside = np.zeros((_GRID + 1, _GRID + 1), dtype=bool)
    first, last = np.ceil((lo - low) / step - 1e-9).astype(int), np.floor((hi - low) / step + 1e-9).astype(int)
    for (i, j), (k, m) in zip(first[(first <= last).all(axis=1)], last[(first <= last).all(axis=1)], strict=True):
        inside[i : k + 1, j : m + 1] = True
    full = np.argwhere(inside[:-1, :-1] & inside[1:, :-1] & inside[1:, 1:] & inside[:-1, 1:])
    return low + step * (full[:, None] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]))


def regions(domains: Domains, ax: Axes | None, at: Mapping[str, float], number: int | None) -> Axes:
    """Draw the regions of an aspect, and what bounds them if it is known."""
    from matplotlib.colors import to_rgba_array

    grid = domains.grid
    names, labels = list(grid.coordinates), grid.labels
    cut: list[Any] = [slice(None)] * len(names)
    for name, value in at.items():
        edges = grid.edges[names.index(name)]
        cut[names.index(name)] = min(int(np.searchsorted(edges, value, side="right")) - 1, len(edges) - 2)
    free = [k for k, name in enumerate(names) if name not in at]
    if len(free) != 2:
        remedy = f"such as with at={{{names[-1]!r}: 0}}" if len(free) > 2 else "cut at fewer"
        raise _native.Error(
            f"{counted(len(free), 'coordinate')} left to vary: regions are drawn where two do, {remedy}"
        )
    labels = labels[tuple(cut)]
    shown = {region["number"] for region in domains.regions}
    if number is not None:
        if number > len(domains.uniqueness):
            raise _native.Error(
                f"there is no uniqueness domain {number}: there are {len(domains.uniqueness)}, numbered from 1"
            )
        shown = set(domains.uniqueness[number - 1]["regions"])
    ax = _axes(ax)
    # A colour for what is too thin to tell, for outside, and for each region.
    colours = [_GREY, "none", *(_colour(r["number"]) if r["number"] in shown else _GREY for r in domains.regions)]
    image = to_rgba_array(colours)[labels + 1]
    image[..., 3] *= 0.7
    x, y = (grid.edges[k] for k in free)
    ax.imshow(image.swapaxes(0, 1), origin="lower", extent=(x[0], x[-1], y[0], y[-1]), interpolation="nearest")
    for region in sorted(shown)[:_NAMED]:
        solutions = domains.regions[region - 1]["solutions"]
        ax.fill([], [], color=_colour(region), alpha=0.7, label=f"region {region}: n = {solutions}")
    if (np.isin(labels, list(shown), invert=True) & (labels != 0)).any():
        ax.fill([], [], color=_GREY, alpha=0.7, label="other regions, or too thin to tell")
    surfaces = domains._known_surfaces() if len(names) == 2 else None
    if surfaces is not None:
        from matplotlib.collections import LineCollection

        for surface, style in zip(surfaces, ("-", "--"), strict=True):
            lines = surface.vertices[surface.simplices]
            ax.add_collection(LineCollection(list(lines), color="black", linestyle=style, linewidth=0.8))
    axes = domains._mapped().labels
    ax.set_xlabel(axes[names[free[0]]])
    ax.set_ylabel(axes[names[free[1]]])
    ax.set_aspect("equal" if {"x", "y", "z"}.issuperset(names[k] for k in free) else "auto")
    ax.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1, 1))
    return ax


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
