"""Progress of long work, as people like to see it."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeAlias, TypeVar

from aspecta._native import Partial

Native = TypeVar("Native")
Made = TypeVar("Made")
Given = ParamSpec("Given")

#: Seconds that are no time at all.
_AT_ONCE = 1e-9

#: ``progress(stage, done, total)``, called now and then; or ``True`` for a bar (with tqdm installed).
Progress: TypeAlias = Callable[[str, int, int], Any] | bool | None


def reporter(progress: Progress) -> Callable[[str, int, int], Any] | None:
    """Return what is to be called with the progress, if anything."""
    if progress is None or progress is False:
        return None
    if progress is not True:
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ImportError("progress=True draws a bar with tqdm, which is not installed: pip install tqdm") from None
    bar: Any = tqdm(total=1, leave=False)

    def report(stage: str, done: int, total: int) -> None:
        bar.total = total
        bar.n = done
        bar.set_description(stage)

    return report


class TimeLeft:
    """What is left of the seconds that several steps of some work have together; without any, no step is limited."""

    def __init__(self, seconds: float | None) -> None:
        self._end = None if seconds is None else time.monotonic() + seconds

    def __call__(self) -> float | None:
        """Return what the next step may take: a positive number, since it stops at once where nothing is left."""
        return None if self._end is None else max(self._end - time.monotonic(), _AT_ONCE)

    @property
    def is_over(self) -> bool:
        """Whether nothing is left."""
        return self() == _AT_ONCE


def kept(work: Callable[[], Native], made: Callable[[Native], Made]) -> Made:
    """Return what is made of the result of some work.

    An exception that interrupts it, such as ``KeyboardInterrupt``, comes at once; its ``partial()`` returns what is made of
    the result so far (``None`` if there is none), and waits for the step that was under way.
    """
    try:
        return made(work())
    except BaseException as interruption:
        later = getattr(interruption, "partial", None)
        if isinstance(later, Partial) or isinstance(interruption, KeyboardInterrupt):

            def partial() -> Made | None:
                found = later.wait() if isinstance(later, Partial) else None
                return None if found is None else made(found)

            interruption.partial = partial  # type: ignore[attr-defined]
        raise


def all_or_nothing(work: Callable[Given, Made]) -> Callable[Given, Made]:
    """Let ``partial()`` of a ``KeyboardInterrupt`` return ``None``: work of which nothing is kept until it is done."""

    @wraps(work)
    def watched(*args: Given.args, **kwargs: Given.kwargs) -> Made:
        try:
            return work(*args, **kwargs)
        except KeyboardInterrupt as interruption:
            interruption.partial = lambda: None  # type: ignore[attr-defined]
            raise

    return watched
