"""Certificates: the proof of a number of aspects, written down, and its check by independent code."""

from __future__ import annotations

import json
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from aspecta import _input, _native
from aspecta._progress import Progress, kept, reporter
from aspecta.results import Verdict


class Certificate:
    """The proof of a count of aspects, as text. Made by ``robot.analyze(certificate=True).certificate``.

    Attributes:
        text: the certificate as JSON; ``docs/certificate.md`` describes it.
    """

    __slots__ = ("text",)

    text: str

    def __init__(self, text: str) -> None:
        self.text = text

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Certificate:
        """Return the certificate in a file."""
        return cls(Path(path).read_text(encoding="utf-8"))

    def save(self, path: str | PathLike[str]) -> None:
        """Write the certificate into a file, for ``aspecta verify``.

        Raises:
            Error: it cannot be written there.
        """
        _native.write(fspath(path), self.text.encode())

    def to_dict(self) -> Any:
        """Return the certificate as plain data."""
        return json.loads(self.text)

    def verify(self, *, seconds: float | None = None, progress: Progress = None) -> Verdict:
        """Check the certificate by code that shares next to nothing with what wrote it.

        The verdict is true if all that is claimed is verified. After ``seconds`` it is of what was checked until then, and
        not true.

        Raises:
            Error: the text is no certificate.
        """
        limit = _input.positive("seconds", seconds)
        return kept(
            lambda: _native.verify(self.text.encode(), limit, reporter(progress)), lambda found: Verdict(*found)
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Certificate) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"<certificate of {len(self.text):,} characters>"


def verify(
    certificate: Certificate | str | PathLike[str], *, seconds: float | None = None, progress: Progress = None
) -> Verdict:
    """Check a certificate, or the one in a file: see :meth:`Certificate.verify`."""
    if not isinstance(certificate, Certificate):
        certificate = Certificate.load(certificate)
    return certificate.verify(seconds=seconds, progress=progress)
