"""Tables: as HTML for notebooks, as frames for pipelines."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence, Sized
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: What is said of a list that is proved to be all, of one that is not, and where nothing is known.
_PROVED = {True: ", proved to be all", False: ", perhaps not all", None: ""}


def listed(found: Sized, noun: str, complete: bool | None) -> str:
    """Return how many there are in a list, and whether these are proved to be all."""
    return f"{counted(len(found), noun)}{_PROVED[complete]}"


def to_html(caption: str, heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a table; numbers with six digits."""

    def cell(value: Any) -> str:
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        return f"<td>{html.escape(text)}</td>"

    head = "".join(f"<th>{html.escape(name)}</th>" for name in heads)
    body = "".join(f"<tr>{''.join(map(cell, row))}</tr>" for row in rows)
    title = f'<caption style="text-align:left">{html.escape(caption)}</caption>'
    return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def counted(count: int, noun: str, nouns: str | None = None) -> str:
    """Return a number of things in words."""
    return f"{count} {noun if count == 1 else nouns or f'{noun}s'}"


def joint_names(coordinates: Sequence[str]) -> list[str]:
    """Return the names of as many joint coordinates as there are coordinates of a pose: q1, q2, …"""
    return [f"q{k + 1}" for k in range(len(coordinates))]


def columns(names: Sequence[str], values: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Return the columns of an array (n, dof) by name."""
    return {name: values[:, k] for k, name in enumerate(names)}


class Frame:
    """What can be had as a data frame: ``_columns`` names its columns."""

    __slots__ = ()

    def _columns(self) -> Mapping[str, Any]:
        raise NotImplementedError

    def to_pandas(self) -> Any:
        """Return a ``pandas.DataFrame`` (pandas must be installed)."""
        import pandas

        return pandas.DataFrame(dict(self._columns()))

    def to_polars(self) -> Any:
        """Return a ``polars.DataFrame`` (polars must be installed)."""
        import polars

        return polars.DataFrame(dict(self._columns()))
