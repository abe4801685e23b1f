"""Maps of a robot: basic regions (Def. 10) and uniqueness domains (Theorem 3)."""

from __future__ import annotations

import copy
import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native
from aspecta._result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from aspecta.analysis import Aspect

Array = NDArray[np.float64]

#: Aspects whose regions a notebook shows with a map.
_PICTURES = 2
_NO_SURFACES = "the surfaces were not computed: ask for them with analysis.domains(…, surfaces=True)"


class Location(NamedTuple):
    """Where a pose is, in a working mode.

    Attributes:
        det_a: the sign of det A: 1, -1, or 0 where the pose is in no aspect.
        aspect: the aspect; ``None`` if it is not known.
        region: the basic region; ``None`` if it is not known.
        domains: the uniqueness domains that hold the region, by number.
        nowhere: why the pose is in no aspect; ``None`` if it is in one.
    """

    det_a: int
    aspect: int | None
    region: int | None
    domains: tuple[int, ...]
    nowhere: str | None


@dataclass(frozen=True, eq=False)
class Surface:
    """What bounds an aspect, or cuts it into regions: curves of segments (k = 2), or surfaces of triangles (k = 3).

    Attributes:
        name: ``"boundary"`` or ``"characteristic"`` (Def. 9).
        vertices: (n, k): poses, the k coordinates that vary. Where an angle closes up on itself, triangles across its
            ends have copies of vertices a full turn further.
        simplices: (m, k): the vertices of each segment or triangle.
        faces: the names of the faces, such as ``"det A = 0"``.
        face: (m,): which of ``faces`` each simplex is, or comes from.
        q: (n, dof): joint vectors.
        source: (n, k): of a characteristic surface, the pose on the boundary with the same joint vector; ``None`` of
            a boundary.
    """

    name: str
    vertices: Array
    simplices: NDArray[np.uint32]
    faces: list[str]
    face: NDArray[np.uint8]
    q: Array
    source: Array | None

    def to_trimesh(self) -> Any:
        """Return a ``trimesh.Trimesh`` (trimesh must be installed); joint vectors are its vertex attribute ``q``.

        Raises:
            Error: it is a curve.
        """
        if self.simplices.shape[1] != 3:
            raise _native.Error("a curve is no mesh of triangles: two coordinates vary")
        import trimesh

        return trimesh.Trimesh(self.vertices, self.simplices, vertex_attributes={"q": self.q}, process=False)


@dataclass(frozen=True, eq=False)
class Regions:
    """The basic regions of an aspect on a grid.

    Attributes:
        coordinates: the names of the k coordinates that vary.
        edges: (c_j + 1,) for each of them: the ends of the cells.
        labels: (c_1, …, c_k): the region of each cell, from 1; 0 outside the aspect, -1 where it is too thin to tell.
    """

    coordinates: list[str]
    edges: list[Array]
    labels: NDArray[np.int64]


class Domains(Result):
    """The basic regions and uniqueness domains of one aspect. Numerical, true to a cell of the grid.

    Attributes:
        aspect: the aspect.
        regions: the basic regions, the largest first.
        uniqueness: the uniqueness domains: each a list of regions in which a joint vector means one pose.
        complete: whether nothing about it is unresolved.
        cell: the width of a cell, per coordinate that varies.
    """

    __slots__ = ("_map",)

    _map: _native.Map | None
    aspect: int
    regions: list[dict[str, Any]]
    uniqueness: list[dict[str, Any]]
    complete: bool
    cell: list[float]

    def __init__(self, data: str | dict[str, Any], text: str = "", native: _native.Map | None = None) -> None:
        super().__init__(data, text)
        self._map = native

    def __copy__(self) -> Domains:
        return Domains(self._data, self._text, self._map)

    def __deepcopy__(self, memo: dict[int, Any]) -> Domains:
        # The grid never changes: copies share it.
        return Domains(copy.deepcopy(self._data, memo), self._text, self._map)

    def _mapped(self) -> _native.Map:
        if self._map is None:
            raise _native.Error("pickled domains hold their answers, not the grid behind them: pickle their map")
        return self._map

    def _repr_html_(self) -> str:
        picture = None if self._map is None else self._map.picture(self.aspect)
        return f"{super()._repr_html_()}{picture or ''}"

    @property
    def grid(self) -> Regions:
        """The regions, cell by cell."""
        native = self._mapped()
        found = native.grid(self.aspect)
        assert found is not None
        axes, low, step, count, labels = found
        edges = [lo + width * np.arange(n + 1, dtype=float) for lo, width, n in zip(low, step, count, strict=True)]
        return Regions([native.coordinates[k] for k in axes], edges, labels.reshape(count, order="F"))

    @property
    def surfaces(self) -> tuple[Surface, Surface]:
        """The boundary of the aspect, and its characteristic surfaces (Def. 9).

        Raises:
            Error: they were not asked for: ``analysis.domains(…, surfaces=True)``.
        """
        known = self._known_surfaces()
        if known is None:
            raise _native.Error(_NO_SURFACES)
        return known

    def _known_surfaces(self) -> tuple[Surface, Surface] | None:
        """The surfaces, if they were asked for."""
        native = self._mapped()
        found = native.surfaces(self.aspect)
        if found is None:
            return None
        k = len(self.cell)
        boundary, characteristic = (
            Surface(
                name,
                vertices.reshape(-1, k),
                corners.reshape(-1, k),
                faces,
                face,
                q.reshape(-1, native.dof),
                source.reshape(-1, k) if len(source) else None,
            )
            for name, vertices, corners, face, faces, q, source in found
        )
        return boundary, characteristic

    def plot(self, ax: Axes | None = None, *, at: Mapping[str, float] | None = None, domain: int | None = None) -> Axes:
        """Draw the regions in the workspace, a colour each; ``at`` names the coordinate to cut at where three vary.

        ``domain`` draws the regions of that uniqueness domain, from 1, and leaves the others pale.
        """
        from aspecta._plot import regions

        grid = self.grid
        bounds = {name: (edges[0], edges[-1]) for name, edges in zip(grid.coordinates, grid.edges, strict=True)}
        return regions(self, ax, _input.cut(at, bounds, {}), _input.whole("domain", domain, 1))


class Map:
    """The aspects of a robot, of which some are cut into basic regions. Made by :meth:`Analysis.domains`, or loaded."""

    __slots__ = ("_native",)

    def __init__(self, native: _native.Map) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Map:
        """Return the map in a file, as :meth:`save` or ``aspecta domains --save`` writes it.

        Raises:
            Error: there is no such file, or it is no map, or another version's. Its content is checked, never run.
        """
        return cls(_native.Map.load(fspath(path)))

    def save(self, path: str | PathLike[str]) -> None:
        """Write the map into a file, which is there only when it is complete; ``docs/map-file.md`` describes it.

        Raises:
            Error: it cannot be written there.
        """
        _native.write(fspath(path), self._native.to_bytes())

    @property
    def robot(self) -> str:
        """The robot's name."""
        return self._native.robot[0]

    @property
    def aspects(self) -> list[int]:
        """The numbers of the aspects that are cut into regions."""
        return self._native.aspects

    def domains(self, aspect: int | Aspect) -> Domains:
        """Return the regions and uniqueness domains of an aspect, which may be given by its number.

        Raises:
            KeyError: that aspect is not cut into regions here.
        """
        number = _input.aspect(aspect)
        found = self._native.domains(number) if number in self.aspects else None
        if found is None:
            raise KeyError(f"aspect {number} is not in this map, which has {self.aspects}")
        return Domains(*found, self._native)

    def draw(
        self,
        directory: str | PathLike[str],
        aspects: Sequence[int | Aspect] | NDArray[np.integer[Any]] | int | Aspect | None = None,
        *,
        meshes: Sequence[Literal["ply", "glb", "vtp"]] = ("ply", "glb"),
        hold: int = 3,
    ) -> list[Path]:
        """Write pictures of aspects (default: all that are cut into regions) into a directory: regions, the largest uniqueness
        domain, basic components and sheets over joint space; of three coordinates meshes too. Return the paths.

        ``hold`` is the joint, from 1, that is held in pictures of a joint space of three.

        Raises:
            Error: surfaces were not asked for: ``analysis.domains(…, surfaces=True)``; or files cannot be written there.
        """
        chosen = _input.aspects(aspects)
        wanted = self.aspects if chosen is None else chosen
        for aspect in wanted:
            self.domains(aspect)
        held = (_input.whole("hold", hold, 1, 3) or 1) - 1
        written: list[Path] = []
        for aspect in wanted:
            paths = self._native.draw(aspect, fspath(directory), list(meshes), held)
            if paths is None:
                raise _native.Error(_NO_SURFACES)
            written += map(Path, paths)
        return written

    @overload
    def locate(self, pose: list[float] | tuple[float, ...], mode: str) -> Location: ...
    @overload
    def locate(self, pose: ArrayLike, mode: str) -> Location | list[Location]: ...
    def locate(self, pose: ArrayLike, mode: str) -> Location | list[Location]:
        """Locate a pose (dof,), or each of several (n, dof), in a working mode.

        Numerical, true to a cell of the grid; where it is at a border it says so by ``None``.
        """
        poses = np.ascontiguousarray(_input.numbers("pose", pose))
        found = [
            Location(det_a, aspect or None, region or None, tuple(domains), nowhere)
            for det_a, aspect, region, domains, nowhere in self._native.locate(np.atleast_2d(poses), mode)
        ]
        return found if poses.ndim == 2 else found[0]

    def __str__(self) -> str:
        return f"a map of {self.robot}: aspects {', '.join(map(str, self.aspects)) or 'none'} cut into regions"

    __repr__ = __str__

    def _repr_html_(self) -> str:
        pictures = (self._native.picture(aspect) or "" for aspect in self.aspects[:_PICTURES])
        return f"<p>{html.escape(str(self))}</p>{''.join(pictures)}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _map_of, (self._native.to_bytes(),)


def _map_of(file: bytes) -> Map:
    """A map from a pickle, whose content is that of a map file and checked like one."""
    return Map(_native.Map.from_bytes(file))
