"""Progress of long work, as people like to see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

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


def outcome(result: Any, interruption: BaseException | None) -> Any:
    """Return a result; or raise what interrupted it, with ``partial``, the result so far (``None`` if there is none)."""
    if interruption is not None:
        interruption.partial = result  # type: ignore[attr-defined]
        raise interruption
    return result
