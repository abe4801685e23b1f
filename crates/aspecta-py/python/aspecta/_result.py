"""What all results have in common: they print as a summary, and hand over their data."""

from __future__ import annotations

import copy
import html
import json
from collections.abc import Iterator
from typing import Any


class Result:
    """An answer of Aspecta: ``print`` shows its summary, attributes hold its parts.

    The parts have the names and the meaning of the command line's ``--json``; angles are in radians. A result pickles
    and copies as its data.
    """

    __slots__ = ("_data", "_text")

    _data: dict[str, Any]
    _text: str

    def __init__(self, data: str | dict[str, Any], text: str = "") -> None:
        self._data = json.loads(data) if isinstance(data, str) else data
        self._text = text

    def to_dict(self) -> dict[str, Any]:
        """Return the whole result as plain data of its own, ready for ``json.dump``."""
        return copy.deepcopy(self._data)

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._data:
            return self._data[name]
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __dir__(self) -> Iterator[str]:
        yield from object.__dir__(self)
        yield from self._data

    def __str__(self) -> str:
        return self._text.rstrip() or f"{type(self).__name__}({', '.join(self._data)})"

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._data == other._data

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text)


def undecided(result: Result, answer: str) -> TypeError:
    """Return the refusal to be true or false, of a result whose answer may be undecided."""
    return TypeError(f"a {type(result).__name__} is neither true nor false: ask its `.{answer}`")
