"""Times commands of this tree beside those of an earlier commit, one after the other; see README.md."""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SLICE = ["3-rrr", "--fix", "phi=0"]
TABLE_4 = ["--from", "-15.468,0.781,0.073", "--to", "-9.902,-7.091,1.081", "--mode=+++"]
FIXTURE = "crates/aspecta/tests/fixtures/{}.toml"
# Name, arguments, and whether it takes minutes. {out} is a folder of the run's own.
COMMANDS = [
    ("analyze five-bar", ["analyze", "five-bar", "--json"], False),
    ("analyze 3-rrr, slice", ["analyze", *SLICE, "--json", "--certificate", "{out}/slice.json"], False),
    ("verify of it", ["verify", "{out}/slice.json"], False),
    ("analyze irb-360", ["analyze", "irb-360", "--json"], False),
    ("analyze 3-rpr", ["analyze", "3-rpr", "--json"], False),
    ("analyze linear-delta", ["analyze", "linear-delta", "--json"], False),
    ("analyze 3-prr", ["analyze", "3-prr", "--json"], False),
    ("plan 3-rrr, Table 4", ["plan", "3-rrr", *TABLE_4], False),
    ("fk gough-stewart", ["fk", "gough-stewart", "--q", "1,0.645275,1.086284,1.503439,1.281933,0.771071"], False),
    ("analyze 3-rrr", ["analyze", "3-rrr", "--json"], True),
    ("domains 3-rrr", ["domains", "3-rrr", "--mode", "+++", "--det", "+", "--cells", "200", "--json"], True),
    ("analyze limited_sphere", ["analyze", FIXTURE.format("limited_sphere"), "--json"], True),
    ("analyze folding_sphere", ["analyze", FIXTURE.format("folding_sphere"), "--json"], True),
]


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def build(tree, target):
    """The program of a tree."""
    command = ["cargo", "build", "--release", "--quiet", "--locked", "--target-dir", str(target)]
    if subprocess.run(command, cwd=tree).returncode != 0:
        fail(f"{tree} does not build")
    return target / "release" / "aspecta"


def timed(program, arguments):
    """Processor time and time on the clock of one run, and what it printed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([program, *arguments], cwd=ROOT, capture_output=True, text=True)
    clock, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        return None
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, clock, done.stdout


def answer(printed):
    """The count and the undecided share of an analysis."""
    try:
        found = json.loads(printed)
        classes = found["classes"]
    except (ValueError, KeyError, TypeError):
        return ""
    undecided = sum(c["undecided"] for c in classes)
    whole = undecided + sum(c["measure"] for c in classes)
    aspects = found["aspects"]
    count = f"exactly {aspects['low']}" if aspects["certified"] else f"at least {aspects['low']}"
    return f"{count}, {100 * undecided / whole:.2f} % undecided" if whole else count


def best(runs):
    """The least processor time and the least time on the clock."""
    return None if None in runs else (min(r[0] for r in runs), min(r[1] for r in runs))


def main():
    parser = argparse.ArgumentParser(prog="benches/earlier/run", description=__doc__)
    parser.add_argument("commit", nargs="?", default="4f09ce2", help="the earlier commit (default: 4f09ce2)")
    parser.add_argument("--long", action="store_true", help="what takes minutes, too")
    parser.add_argument("--times", type=int, default=3, help="runs of each command (default: 3)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="aspecta-earlier-") as folder:
        folder = Path(folder)
        tree = folder / "tree"
        if subprocess.run(["git", "worktree", "add", "--quiet", "--detach", tree, arguments.commit], cwd=ROOT).returncode:
            fail(f"{arguments.commit} is no commit")
        try:
            programs = [build(tree, folder / "target"), build(ROOT, ROOT / "target")]
            print(f"| command | {arguments.commit}: processor, clock (s) | now | ratio | answers |\n|---|---|---|---|---|")
            for name, words, is_long in COMMANDS:
                if is_long and not arguments.long:
                    continue
                runs = [[], []]
                for _ in range(1 if is_long else arguments.times):
                    for k, program in enumerate(programs):
                        out = folder / f"out{k}"
                        os.makedirs(out, exist_ok=True)
                        runs[k].append(timed(program, [word.format(out=out) for word in words]))
                print(row(name, runs), flush=True)
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", tree], cwd=ROOT)


def row(name, runs):
    figures = [best(of) for of in runs]
    shown = ["-" if f is None else f"{f[0]:.2f}, {f[1]:.2f}" for f in figures]
    ratio = "-" if None in figures else f"{figures[0][0] / max(figures[1][0], 1e-3):.1f}"
    answers = [answer(of[-1][2]) if of[-1] else "" for of in runs]
    said = answers[1] if answers[0] == answers[1] else " → ".join(answers)
    return f"| {name} | {shown[0]} | {shown[1]} | {ratio} | {said} |"


if __name__ == "__main__":
    main()
