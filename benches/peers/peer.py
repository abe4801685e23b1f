"""What the two Codac scripts share: read a request (JSON, standard input), check signs, time pavings, report.

A request holds the window, poses with the sign of det A, and per depth the undecided area to match.
"""

import json
import math
import sys
import time
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any, Callable

# A variant is timed again until it has had so many runs or so many seconds.
RUNS, SECONDS = 7, 10.0
# Bisections of eps in search of Aspecta's undecided area.
STEPS = 5


@dataclass
class Program:
    """One version of Codac on the set to pave."""

    det: Callable[[float, float], Any]
    """(x, y) → (lower, upper) bound of D, None where the mode does not exist."""
    variants: dict
    """Separators of the same set, by name."""
    pave: Callable
    """(window, separator, eps) → paving; this is what is timed."""
    areas: Callable
    """paving → (certified, undecided)."""
    boxes: Callable
    """(window, separator, eps, paving) → boxes the separator was applied to."""


def check_signs(program, samples):
    """Compares signs of D with Aspecta's signs of det A; returns how many were compared."""
    compared = 0
    for x, y, sign in samples:
        bounds = program.det(x, y)
        if bounds is None:
            proved = 0
        elif bounds[0] > 0 or bounds[1] < 0:
            proved = 1 if bounds[0] > 0 else -1
        else:
            continue
        if proved != sign:
            sys.exit(f"at ({x}, {y}) the formula has the sign {proved}, Aspecta's det A has {sign}")
        compared += 1
    return compared


def alone(task):
    """What `task` returns, in a process of its own: Codac 2 gets a third slower on a heap that has been used."""
    fork = get_context("fork")
    receiver, sender = fork.Pipe(duplex=False)
    child = fork.Process(target=lambda: sender.send(task()))
    child.start()
    sender.close()
    result = receiver.recv()
    child.join()
    return result


def timed(program, window, separator, eps):
    """The best of some runs, and what the paving is worth."""
    best, spent, runs = math.inf, 0.0, 0
    while runs < RUNS and spent < SECONDS:
        # Codac has one thread: on a quiet machine its processor time is the time on the clock, and on a busy one
        # it does not pay for the others.
        start = time.process_time()
        paving = program.pave(window, separator, eps)
        seconds = time.process_time() - start
        best, spent, runs = min(best, seconds), spent + seconds, runs + 1
    certified, undecided = program.areas(paving)
    boxes = program.boxes(window, separator, eps, paving)
    return {"seconds": best, "boxes": boxes, "certified": certified, "undecided": undecided, "eps": eps}


def matching_eps(program, window, separator, run, target):
    """The largest eps found that leaves no more undecided than `target`."""
    guess = run["eps"] * target / run["undecided"]
    fine, coarse = 0.7 * guess, 1.4 * guess
    for _ in range(STEPS):
        eps = math.sqrt(fine * coarse)
        if program.areas(program.pave(window, separator, eps))[1] <= target:
            fine = eps
        else:
            coarse = eps
    return fine


def serve(program):
    """Answers one request."""
    request = json.load(sys.stdin)
    window = request["window"]
    widest = max(hi - lo for lo, hi in window)

    def eps(depth):
        # Aspecta's finest cells; a trifle more, so that rounding does not ask for one bisection more.
        return widest / 2**depth * (1 + 1e-9)

    compared = check_signs(program, request["samples"])
    first = request["depths"][0]["depth"]
    trials = {name: alone(lambda: timed(program, window, program.variants[name], eps(first)))
              for name in program.variants}
    # Time grows as 1/eps and the undecided area as eps: their product is the price of precision.
    best = min(trials, key=lambda name: trials[name]["seconds"] * trials[name]["undecided"])
    separator, depths = program.variants[best], []
    for wanted in request["depths"]:
        cells = alone(lambda: timed(program, window, separator, eps(wanted["depth"])))
        matched = alone(lambda: matching_eps(program, window, separator, cells, wanted["undecided"]))
        depths.append({"same_cells": cells,
                       "same_undecided": alone(lambda: timed(program, window, separator, matched))})
    report = {"signs_compared": compared, "variants": trials, "best": best, "depths": depths}
    json.dump(report, sys.stdout)
