"""Progress of long work, as people like to see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

from aspecta._native import Partial

Native = TypeVar("Native")
Made = TypeVar("Made")

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


def kept(work: Callable[[], Native], made: Callable[[Native], Made]) -> Made:
    """Return what is made of the result of some work.

    An exception that interrupts it, such as ``KeyboardInterrupt``, comes at once; its ``partial()`` returns what is made of
    the result so far (``None`` if there is none), and waits for the step that was under way.
    """
    try:
        return made(work())
    except BaseException as interruption:
        later = getattr(interruption, "partial", None)
        if isinstance(later, Partial):

            def partial() -> Made | None:
                found = later.wait()
                return None if found is None else made(found)

            interruption.partial = partial  # type: ignore[attr-defined]
        raise
