"""Runs PHCpack's program `phc` and reads what it found."""

import re
import resource
import tempfile
from dataclasses import dataclass
from pathlib import Path

from commands import fail, output

UNKNOWNS = ["x1", "x2", "x3", "g0", "g1", "g2", "g3"]
# Answers to `phc -p`: target, output, no second output, start, then the default settings.
ANSWERS = "target\nfound\nn\nstart\n0\n0\n0\n"


@dataclass
class Found:
    seconds: float
    """Processor time of the whole process."""
    paths: int
    solutions: list
    """Those that PHCpack itself calls solutions: values of UNKNOWNS."""


def version():
    return re.match(r"PHCv\S+", output(["phc", "--version"], "phc"))[0]


def system(equations):
    return f"{len(equations)}\n" + "\n".join(f.written(UNKNOWNS) for f in equations) + "\n"


def blackbox(equations, seed):
    """`phc -b`. The seed fixes what PHCpack draws at random."""
    return run(["phc", f"-0{seed}", "-b", "target", "found"], None, {"target": system(equations)})


def homotopy(equations, start, start_solutions, seed):
    """`phc -p` from a solved system: one path a solution."""
    files = {"target": system(equations), "start": system(start) + listed(start_solutions)}
    return run(["phc", f"-0{seed}", "-p"], ANSWERS, files)


def listed(solutions):
    """Solutions as PHCpack reads them."""
    lines = ["", "THE SOLUTIONS :", f"{len(solutions)} {len(UNKNOWNS)}", "=" * 75]
    for number, solution in enumerate(solutions, 1):
        lines += [f"solution {number} :", "t :  0.00000000000000E+00   0.00000000000000E+00", "m : 1",
                  "the solution for t :"]
        lines += [f" {name} : {value.real:.16E}  {value.imag:.16E}" for name, value in zip(UNKNOWNS, solution)]
        lines.append("== err :  1.000E-14 = rco :  1.000E-02 = res :  1.000E-14 ==")
    return "\n".join(lines) + "\n"


def run(command, given, files):
    with tempfile.TemporaryDirectory(prefix="aspecta-phcpack-") as folder:
        for name, text in files.items():
            (Path(folder) / name).write_text(text)
        before = processor_seconds()
        output(command, " ".join(command), given, cwd=folder)
        seconds = processor_seconds() - before
        found = Path(folder) / "found"
        return Found(seconds, *solutions(found.read_text() if found.exists() else ""))


def processor_seconds():
    """Of all children so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def solutions(text):
    """Number of paths, and the solutions of the last list in an output file."""
    _, heading, listing = text.rpartition("THE SOLUTIONS :")
    if not heading:
        fail("phc wrote no solutions")
    blocks = re.split(r"^solution \d+ :", listing, flags=re.MULTILINE)[1:]
    kept = []
    for block in blocks:
        if re.search(r"(real|complex) (regular|singular) ==", block):
            values = dict(re.findall(r"^ (\w+) : +(\S+ +\S+)", block, re.MULTILINE))
            kept.append([complex(*map(float, values[name].split())) for name in UNKNOWNS])
    return len(blocks), kept
