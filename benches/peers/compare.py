"""Aspecta and Codac pave one working mode of the five-bar side by side; see README.md."""

import argparse
import json
import os
import platform
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from commands import fail, output

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MODE = "++"
# Both: version 2 is the current one, version 1 the faster one on this set.
PEERS = [("1.5.7", "codac_v1.py"), ("2.1.2", "codac_v2.py")]
# Repetitions of each paving in Aspecta.
REPETITIONS = 30
COLUMNS = "s | boxes | certified | undecided"


def aspecta(depth, threads):
    command = ["cargo", "run", "--quiet", "--release", "-p", "aspecta", "--example", "pave_one_mode", "--",
               MODE, str(depth), str(REPETITIONS)]
    environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    return json.loads(output(command, "Aspecta", cwd=ROOT, env=environment))


def environment(folder, version):
    """Python of a new virtual environment with this Codac; None if no build of it fits this Python."""
    python = folder / "bin" / "python"
    made = subprocess.run([sys.executable, "-m", "venv", str(folder)], capture_output=True, text=True)
    if made.returncode != 0:
        fail("python3 cannot make a virtual environment; on Debian: apt install python3-venv\n"
             f"{made.stdout}{made.stderr}")
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
               "--only-binary=codac", f"codac=={version}"]
    done = subprocess.run(install, capture_output=True, text=True)
    if done.returncode != 0:
        print(f"codac {version} left out; pip says: {done.stderr.strip()[-500:]}", file=sys.stderr)
        return None
    return python


def codac(version, script, request):
    """What a Codac of this version does with the request; None if it cannot be installed."""
    with tempfile.TemporaryDirectory(prefix="aspecta-peers-") as folder:
        python = environment(Path(folder), version)
        if python is None:
            return None
        command = [python, "-B", str(HERE / script)]
        return json.loads(output(command, f"codac {version}", json.dumps(request), cwd=folder))


def agree(a, b):
    """What one program certifies lies in what the other certifies or leaves undecided."""
    for one, other in ((a, b), (b, a)):
        if one["certified"] > (other["certified"] + other["undecided"]) * (1 + 1e-9):
            sys.exit(f"the pavings contradict each other: {one} and {other}")


def measure(depths):
    """All figures, as written to the JSON file."""
    threads = os.cpu_count()
    counts = sorted({1, threads})
    report = {
        "mode": MODE, "sign": "det A > 0", "cores": threads, "python": platform.python_version(),
        "rustc": output(["rustc", "--version"], "rustc").strip(),
        "aspecta": [], "codac": {},
    }
    for depth in depths:
        report["aspecta"].append({str(count): aspecta(depth, count) for count in counts})
        print(f"Aspecta, window/2^{depth}: done", file=sys.stderr)
    pavings = [by_threads["1"] for by_threads in report["aspecta"]]
    report["window"], samples = pavings[0]["window"], pavings[0]["samples"]
    for by_threads in report["aspecta"]:
        for paving in by_threads.values():
            del paving["samples"], paving["window"]
    request = {"window": report["window"], "samples": samples,
               "depths": [{"depth": p["depth"], "undecided": p["undecided"]} for p in pavings]}
    for version, script in PEERS:
        answer = codac(version, script, request)
        if answer is None:
            continue
        for ours, theirs in zip(pavings, answer["depths"]):
            agree(ours, theirs["same_cells"])
            agree(ours, theirs["same_undecided"])
        report["codac"][version] = answer
        print(f"Codac {version}: done; {answer['signs_compared']} signs of det A agree", file=sys.stderr)
    if not report["codac"]:
        fail("no Codac could be installed")
    return report


def threads_of(count):
    return "1 thread" if count == "1" else f"{count} threads"


def table(report):
    """The figures as Markdown."""
    heads = " | ".join(f"time / Aspecta's, {threads_of(n)}" for n in report["aspecta"][0])
    lines = [f"| cells | program | {COLUMNS} | {heads} |", "|---" * (6 + len(report["aspecta"][0])) + "|"]
    for k, ours in enumerate(report["aspecta"]):
        runs = {f"Aspecta, {threads_of(n)}": run for n, run in ours.items()}
        for version, answer in report["codac"].items():
            runs[f"Codac {version}, same cells"] = answer["depths"][k]["same_cells"]
            runs[f"Codac {version}, same undecided area"] = answer["depths"][k]["same_undecided"]
        for program, run in runs.items():
            ratios = " | ".join(f"{run['seconds'] / own['seconds']:.1f}" for own in ours.values())
            lines.append(f"| window/2^{ours['1']['depth']} | {program} | {figures(run)} | {ratios} |")
    for version, answer in report["codac"].items():
        lines += ["", f"Codac {version} at the first precision; the table uses *{answer['best']}*:", "",
                  f"| formulation | {COLUMNS} |", "|---|---|---|---|---|"]
        lines += [f"| {name} | {figures(run)} |" for name, run in answer["variants"].items()]
    return "\n".join(lines)


def figures(run):
    return f"{run['seconds']:.4f} | {run['boxes']} | {run['certified']:.3f} | {run['undecided']:.3f}"


def main():
    # A stop leaves by the usual way out, so that the virtual environments are removed.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    parser = argparse.ArgumentParser(prog="benches/peers/run", description=__doc__)
    parser.add_argument("--depths", type=int, nargs="+", default=[7, 8, 9], metavar="N",
                        help="finest cells are window/2^N (default: 7 8 9)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures to FILE")
    arguments = parser.parse_args()
    report = measure(arguments.depths)
    if arguments.json:
        arguments.json.write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n")
    print(f"{report['rustc']}; Python {report['python']}; {report['cores']} cores\n\n{table(report)}")


if __name__ == "__main__":
    main()
