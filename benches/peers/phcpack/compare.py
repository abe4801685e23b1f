"""Aspecta and PHCpack solve the direct problem of Gough-Stewart platforms side by side; see README.md."""

import argparse
import itertools
import json
import math
import os
import platform as machine
import signal
import statistics
import sys
import tempfile
from pathlib import Path

import phcpack
from commands import output
from platforms import Posed, from_robot_file, product, random_platform, rotation

ROOT = Path(__file__).resolve().parents[3]
ASPECTA = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release" / "aspecta"
DIETMAIER = [1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071]
METHODS = {"blackbox": "phc -b", "homotopy": "phc -p"}
# Complex poses of a generic platform (Ronga & Vust, Mourrain).
GENERIC = 40
# How many rows more one run of Aspecta has than the other; the difference in time is theirs.
REPETITIONS = 200
# PHCpack draws at random, and now and then loses a path: then it is asked again. From seeds near zero it draws numbers
# that are nearly real, which are bad for homotopies.
SEEDS = range(11111, 66666, 11111)
# Entries of R and p; PHCpack's lists end with Newton's method in double precision.
AGREEMENT = 1e-6


def disagree(message):
    print(message, file=sys.stderr)
    sys.exit(1)


def from_angles(roll, pitch, yaw):
    """R_z(yaw) R_y(pitch) R_x(roll)."""
    half = lambda angle, axis: [math.cos(angle / 2)] + [math.sin(angle / 2) * (k == axis) for k in range(3)]
    return rotation(product(product(half(yaw, 2), half(pitch, 1)), half(roll, 0)))


def apart(a, b):
    """The largest difference of two poses' entries."""
    (r, p), (s, q) = a, b
    return max(abs(x - y) for one, other in zip([*r, p], [*s, q]) for x, y in zip(one, other))


def aspecta(platform):
    """The real poses that Aspecta proves, and processor time for one joint vector."""
    with tempfile.TemporaryDirectory(prefix="aspecta-phcpack-") as folder:
        robot = Path(folder) / "robot.toml"
        robot.write_text(platform.robot_file())
        row = ",".join(map(repr, map(float, platform.lengths))) + "\n"

        def ask(times):
            """Answer and time for so many rows."""
            (Path(folder) / "q.csv").write_text(row * times)
            before = phcpack.processor_seconds()
            answer = output([ASPECTA, "fk", robot, "--file", "q.csv", "--json"], "Aspecta", cwd=folder)
            return json.loads(answer), phcpack.processor_seconds() - before

        answers, once = ask(1)
        _, often = ask(1 + REPETITIONS)
    answer = answers["results"][0]
    if not (answer["complete"] and all(s["certified"] for s in answer["solutions"])):
        disagree(f"{platform.name}: Aspecta leaves poses unproved")
    poses = [(from_angles(*s["pose"][3:]), s["pose"][:3]) for s in answer["solutions"]]
    return poses, (often - once) / REPETITIONS


def residual(posed, solutions):
    """The largest error of a leg equation at PHCpack's solutions, for poses of order one."""
    poses = [posed.pose(solution) for solution in solutions]
    return max(posed.platform.residual(r, p) / (1.0 + max(map(abs, p))) ** 2 for r, p in poses)


def conjugates(name, solutions):
    """For each solution the index of its conjugate. The equations are real; so conjugation permutes the solutions."""
    off = lambda a, b: max(abs(u - v) for u, v in zip(a, b))
    if any(off(a, b) < AGREEMENT for a, b in itertools.combinations(solutions, 2)):
        disagree(f"{name}: two solutions of PHCpack cannot be told apart")
    mates = []
    for solution in solutions:
        mirrored = [value.conjugate() for value in solution]
        mates.append(min(range(len(solutions)), key=lambda k: off(mirrored, solutions[k])))
    if any(mates[mate] != k for k, mate in enumerate(mates)):
        disagree(f"{name}: PHCpack's solutions are not closed under conjugation")
    return mates


def real_poses(posed, name, solutions):
    """Of a complete list the real ones are those that conjugation leaves where they are: no tolerance tells them."""
    mates = conjugates(name, solutions)
    real = [[value.real for value in solution] for k, solution in enumerate(solutions) if mates[k] == k]
    return [posed.pose(solution) for solution in real]


def agreement(posed, ours, found, method):
    """Compares a complete list of PHCpack's with Aspecta's; returns its figures."""
    name = f"{posed.platform.name}, {method}"
    error = residual(posed, found.solutions)
    if error > AGREEMENT:
        disagree(f"{name}: a solution of PHCpack fails the leg equations by {error:.1e}")
    theirs = real_poses(posed, name, found.solutions)
    if len(theirs) != len(ours):
        disagree(f"{name}: {len(theirs)} real poses, Aspecta proves {len(ours)}")
    mates = [min(range(len(theirs)), key=lambda k: apart(pose, theirs[k])) for pose in ours]
    if len(set(mates)) != len(ours):
        disagree(f"{name}: two of Aspecta's poses are nearest to the same of PHCpack's")
    difference = max((apart(pose, theirs[k]) for pose, k in zip(ours, mates)), default=0.0)
    if difference > AGREEMENT:
        disagree(f"{name}: a pose differs by {difference:.1e}")
    return {"seconds": found.seconds, "paths": found.paths, "complex": len(found.solutions),
            "residual": error, "difference": difference}


def complete(name, solve):
    """The first list of PHCpack's with all solutions, and how many the runs before it found."""
    short = []
    for seed in SEEDS:
        found = solve(seed)
        if len(found.solutions) == GENERIC:
            return found, short
        short.append(len(found.solutions))
    disagree(f"{name}: PHCpack finds {short} complex solutions, not {GENERIC}")


def compare(platform, start):
    """The figures of one platform."""
    posed = Posed(platform)
    equations = posed.equations()
    methods = {"blackbox": lambda seed: phcpack.blackbox(equations, seed),
               "homotopy": lambda seed: phcpack.homotopy(equations, *start, seed)}
    ours, seconds = aspecta(platform)
    figures = {"platform": platform.name, "real": len(ours), "aspecta": seconds}
    for method, solve in methods.items():
        found, short = complete(f"{platform.name}, {method}", solve)
        figures[method] = agreement(posed, ours, found, method) | {"short": short}
    print(f"{platform.name}: {len(ours)} real poses, agreed", file=sys.stderr)
    return figures


def start_system():
    """A random platform solved by the blackbox, from which the parameter homotopy starts."""
    equations = Posed(random_platform("start")).equations()
    found, _ = complete("start", lambda seed: phcpack.blackbox(equations, seed))
    return equations, found.solutions


def measure(count):
    """All figures, as written to the JSON file."""
    output(["cargo", "build", "--quiet", "--release", "-p", "aspecta-cli"], "cargo", cwd=ROOT)
    start = start_system()
    platforms = [from_robot_file(ROOT / "robots" / "gough-stewart.toml", DIETMAIER)]
    platforms += [random_platform(f"random-{k}") for k in range(1, count + 1)]
    return {"phcpack": phcpack.version(), "rustc": output(["rustc", "--version"], "rustc").strip(),
            "python": machine.python_version(), "cores": os.cpu_count(),
            "platforms": [compare(platform, start) for platform in platforms]}


def table(report):
    """The figures as Markdown."""
    lines = ["| platform | real poses | Aspecta, ms | `phc -b`, ms | ratio | `phc -p`, ms | ratio | largest difference "
             "| lost before |",
             "|---|---|---|---|---|---|---|---|---|"]
    for row in report["platforms"]:
        cells = [row["platform"], row["real"], f"{row['aspecta'] * 1e3:.2f}"]
        for method in METHODS:
            seconds = row[method]["seconds"]
            cells += [f"{seconds * 1e3:.0f}", f"{seconds / row['aspecta']:.0f}"]
        cells.append(f"{max(row[method]['difference'] for method in METHODS):.0e}")
        cells.append(", ".join(lost(row)))
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines) + "\n\n" + summary(report)


def lost(row):
    """The runs of PHCpack that were repeated."""
    return [f"`{name}`: {GENERIC - found}" for method, name in METHODS.items() for found in row[method]["short"]]


def summary(report):
    rows = report["platforms"]
    parts = [f"Aspecta {statistics.median(row['aspecta'] for row in rows) * 1e3:.2f} ms"]
    for method, name in METHODS.items():
        ratios = [row[method]["seconds"] / row["aspecta"] for row in rows]
        seconds = statistics.median(row[method]["seconds"] for row in rows)
        parts.append(f"`{name}` {seconds:.2f} s, {statistics.median(ratios):.0f} times as long "
                     f"({min(ratios):.0f} to {max(ratios):.0f})")
    return "Medians: " + "; ".join(parts) + "."


def main():
    # A stop leaves by the usual way out, so that temporary folders are removed.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    parser = argparse.ArgumentParser(prog="benches/peers/phcpack/run", description=__doc__)
    parser.add_argument("--platforms", type=int, default=20, metavar="N",
                        help="random platforms beside Dietmaier's (default: 20)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures to FILE")
    arguments = parser.parse_args()
    report = measure(arguments.platforms)
    if arguments.json:
        arguments.json.write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n")
    versions = f"{report['phcpack']}; {report['rustc']}; Python {report['python']}; {report['cores']} cores"
    print(f"{versions}\n\n{table(report)}")


if __name__ == "__main__":
    main()
