#!/usr/bin/env python3
"""Plans motions between poses drawn at random and replays each in MuJoCo: bodies that are kept apart must not touch.

Both poses of a pair are drawn within --ranges, and a mode in which there is a motion is one of --modes. Pairs for which nothing is planned
are passed over. Exit status: 0 all motions went where they should and nothing touched, 1 one did not, 2 bad input.
"""

import argparse
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from replay import BadInput, Robot, Trajectory, replay

TOLERANCE = 1e-3  # of the robot's size, or rad


def ranges(text):
    """`0:5,-1:1` as pairs of numbers."""
    return [tuple(float(end) for end in one.split(":")) for one in text.split(",")]


def planned(command, robot, mode, ends, out):
    """Writes the trajectory of a motion, and returns whether there is one."""
    start, goal = (",".join(f"{x:.6f}" for x in pose) for pose in ends)
    where = [f"--from={start}", f"--to={goal}", f"--mode={mode}"]
    how = ["--trajectory", str(out), "--speed", "2", "--acceleration", "8", "--rate", "25"]
    return subprocess.run([command, "plan", robot, *where, *how], capture_output=True, check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", required=True, help="a robot file with bodies")
    parser.add_argument("--ranges", type=ranges, required=True, help="of the pose's coordinates: 0:5,-1:1")
    parser.add_argument("--modes", required=True, help="working modes, by commas")
    parser.add_argument("--count", type=int, default=10, help="how many motions [10]")
    parser.add_argument("--seed", type=int, default=1, help="of the poses drawn [1]")
    arguments = parser.parse_args()
    command = os.environ.get("ASPECTA", "aspecta")
    drawn = random.Random(arguments.seed)
    pairs = moved = rows = 0
    with tempfile.TemporaryDirectory() as work:
        path, model = Path(work) / "motion.csv", Path(work) / "model.xml"
        while moved < arguments.count:
            pairs += 1
            if pairs > 100 * arguments.count:
                print(f"error: of {pairs} pairs only {moved} have a motion", file=sys.stderr)
                return 2
            mode = drawn.choice(arguments.modes.split(","))
            ends = [[drawn.uniform(*ends) for ends in arguments.ranges] for _ in range(2)]
            if not planned(command, arguments.robot, mode, ends, path):
                continue
            pose = ",".join(f"{x:.6f}" for x in ends[0])
            export = ["export", "mjcf", arguments.robot, f"--pose={pose}", f"--mode={mode}", "--out", str(model)]
            subprocess.run([command, *export], capture_output=True, check=True)
            try:
                robot = Robot(model)
                trajectory = Trajectory(path, robot.pose_names, robot.joint_names)
                found = replay(robot, trajectory, TOLERANCE)
            except BadInput as error:
                print(f"error: motion {moved + 1}: {error}", file=sys.stderr)
                return 2
            moved, rows = moved + 1, rows + len(found)
            touched = robot.touching(TOLERANCE)
            if not robot.model.npair or (found > TOLERANCE).any() or touched:
                touching = ", ".join(touched) or "nothing"
                print(f"motion {moved}, {mode} {ends}: {found.max():.1e} off, {touching} in contact", file=sys.stderr)
                return 1
    print(
        f"{Path(arguments.robot).stem}: {moved} motions of {pairs} pairs, {rows} rows: {robot.model.npair} pairs of bodies, no contact"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
