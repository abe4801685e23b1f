#!/usr/bin/env python3
"""Replays a joint path in MuJoCo and compares where the platform goes with where it should go, and whether bodies touch.

The robot starts in the configuration of the first row. From then on nothing but its driven joints is told where to be: the
platform follows through the closed loops, slowly enough for forces to play no part. Exit status: 0 the platform was where each row says
and bodies that are kept apart have not touched, 1 it was not or they have, 2 bad input.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

import mujoco
import numpy as np

SPEED = 0.5  # of driven joints: rad/s, characteristic lengths/s
AT_REST = 1e-7  # joints this near their inputs, and as slow (per second), have settled
SETTLING = 50  # time steps between looks
PATIENCE = 100  # looks before a row is compared as it is


class BadInput(Exception):
    """What the user gave cannot be used."""


class Trajectory:
    """The rows of a CSV file: poses and joint vectors."""

    def __init__(self, path, pose_names, joint_names):
        try:
            lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise BadInput(f"cannot read `{path}`: {error}") from error
        rows = csv.reader(lines)
        header = [name.strip() for name in next(rows, [])]
        times = [name for name in ("segment", "t", "time") if name in header]
        wanted = [*pose_names, *joint_names]
        missing = [name for name in wanted if name not in header]
        if missing or not {"t", "time"} & set(times):
            names = ",".join(wanted)
            raise BadInput(
                f"{path}: the header is `{','.join(header)}`; wanted are `time` or `segment,t`, and `{names}`"
            )
        used = [header.index(name) for name in (*times, *wanted)]
        numbers = np.array([self._numbers(path, rows.line_num, header, used, row) for row in rows if row])
        if len(numbers) < 2:
            raise BadInput(f"{path}: a path has at least two rows")
        column = {name: numbers[:, k] for k, name in enumerate((*times, *wanted))}
        clock = list(zip(*(column[name] for name in times)))
        late = next((k for k in range(1, len(clock)) if clock[k] < clock[k - 1]), None)
        if late:
            raise BadInput(f"{path}: {','.join(times)} goes back at row {late + 1}")
        self.poses = np.stack([column[name] for name in pose_names], axis=1)
        self.joints = np.stack([column[name] for name in joint_names], axis=1)

    @staticmethod
    def _numbers(path, line, header, used, row):
        if len(row) != len(header):
            raise BadInput(f"{path}:{line}: {len(row)} fields, but the header has {len(header)}")
        try:
            values = [float(row[k]) for k in used]
        except ValueError as error:
            raise BadInput(f"{path}:{line}: {error}") from error
        if not all(map(math.isfinite, values)):
            raise BadInput(f"{path}:{line}: give finite numbers")
        return values


def rotation(pose):
    """The platform's orientation in a pose, or None for platforms that do not turn."""
    if not {"phi", "yaw"} & set(pose):
        return None

    def about(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, -s, s, c
        return turn

    yaw = pose.get("yaw", pose.get("phi", 0.0))
    return about(2, yaw) @ about(1, pose.get("pitch", 0.0)) @ about(0, pose.get("roll", 0.0))


class Robot:
    """A model written by `aspecta export mjcf`, and its state."""

    def __init__(self, path):
        try:
            self.model = mujoco.MjModel.from_xml_path(str(path))
            self.length = float(self.model.numeric("characteristic_length").data[0])
            self.pose_names = self._text("pose").split()
            self.platform = self.model.body("platform").id
            joints = [self.model.joint(f"q{k + 1}") for k in range(self.model.nu)]
        except (ValueError, KeyError) as error:
            raise BadInput(f"`{path}` is not a model written by `aspecta export mjcf`: {error}") from error
        self.data = mujoco.MjData(self.model)
        self.joint_names = [joint.name for joint in joints]
        self.driven = np.array([joint.qposadr[0] for joint in joints])
        self.driven_speeds = np.array([joint.dofadr[0] for joint in joints])
        self.angular = np.array([joint.type[0] == mujoco.mjtJoint.mjJNT_HINGE for joint in joints])
        self.unit = np.where(self.angular, 1.0, self.length)
        limited = self.model.jnt_limited[[joint.id for joint in joints]]
        self.middle = np.where(limited, [joint.range.mean() for joint in joints], math.nan)
        numbers = range(1, len(joints) + 1)
        self.ends = [self.model.site(f"end{k}").id for k in numbers]
        self.attachments = [self.model.site(f"attachment{k}").id for k in numbers]
        pairs = zip(self.model.pair_geom1, self.model.pair_geom2, self.model.pair_margin, strict=True)
        self.clearances = {frozenset((int(one), int(other))): margin for one, other, margin in pairs}
        self.spare = {}

    def _text(self, name):
        number = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_TEXT, name)
        if number < 0:
            raise KeyError(f"it has no text `{name}`")
        start = self.model.text_adr[number]
        return bytes(self.model.text_data[start : start + self.model.text_size[number] - 1]).decode()

    def turns(self, joints):
        """The joint path without jumps of a full turn, its beginning within the joints' ranges."""
        path = np.where(self.angular, np.unwrap(joints, axis=0), joints)
        off = np.where(self.angular & ~np.isnan(self.middle), self.middle - path[0], 0.0)
        return path + math.tau * np.round(off / math.tau)

    def place(self, pose, joints, tolerance):
        """Puts platform and driven joints where the first row says; passive joints follow until the loops are closed."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[self.driven] = joints
        self.data.ctrl[:] = joints
        held = list(self.driven_speeds)
        first = self.model.body_jntadr[self.platform]
        for joint in range(first, first + self.model.body_jntnum[self.platform]):
            address, kind = self.model.jnt_qposadr[joint], self.model.jnt_type[joint]
            held.append(self.model.jnt_dofadr[joint])
            if kind == mujoco.mjtJoint.mjJNT_BALL:
                held += [held[-1] + 1, held[-1] + 2]
                start = np.zeros(9)
                mujoco.mju_quat2Mat(start, self.model.body_quat[self.platform])
                turn = start.reshape(3, 3).T @ rotation(pose)
                mujoco.mju_mat2Quat(self.data.qpos[address : address + 4], turn.flatten())
            else:
                self.data.qpos[address] = pose[self.model.joint(joint).name]
        passive = np.setdiff1d(np.arange(self.model.nv), held)
        # A nudge, lest a link that points exactly the wrong way should have nowhere to begin.
        step = np.zeros(self.model.nv)
        step[passive] = 1e-3
        for _ in range(200):
            mujoco.mj_integratePos(self.model, self.data.qpos, step, 1.0)
            mujoco.mj_kinematics(self.model, self.data)
            mujoco.mj_comPos(self.model, self.data)
            step[passive] = np.linalg.lstsq(self._loop_slope()[:, passive], -self._gaps().flatten(), rcond=1e-9)[0]
            if np.abs(step).max() < 1e-14:
                break
        if self.gap() > tolerance:
            raise BadInput(
                f"pose and joints of the first row are no configuration of the robot: loops are open by {self.gap():.1e} "
                "of its size"
            )

    def _gaps(self):
        return self.data.site_xpos[self.ends] - self.data.site_xpos[self.attachments]

    def _loop_slope(self):
        rows = []
        for end in self.ends:
            slope = np.zeros((3, self.model.nv))
            mujoco.mj_jacSite(self.model, self.data, slope, None, end)
            rows.append(slope)
        return np.concatenate(rows)

    def gap(self):
        """How far the worst loop is open, relative to the robot's size."""
        return float(np.linalg.norm(self._gaps(), axis=1).max()) / self.length

    def drive(self, joints):
        """Leads the inputs to `joints` and waits there until the robot is at rest."""
        start = self.data.ctrl.copy()
        seconds = np.abs((joints - start) / self.unit).max() / SPEED
        steps = math.ceil(seconds / self.model.opt.timestep)
        for k in range(1, steps + 1):
            self.data.ctrl[:] = start + (joints - start) * (k / steps)
            mujoco.mj_step(self.model, self.data)
            self._feel()
        for _ in range(PATIENCE):
            mujoco.mj_step(self.model, self.data, nstep=SETTLING)
            speed = np.abs(self.data.qvel[self.driven_speeds] / self.unit).max()
            if self.lag(joints) < AT_REST and speed < AT_REST:
                break
        mujoco.mj_forward(self.model, self.data)
        self._feel()

    def _feel(self):
        """Notes by how much bodies are nearer to one another than the robot allows."""
        for contact in self.data.contact[: self.data.ncon]:
            names = " and ".join(self.model.geom(geom).name for geom in contact.geom)
            spare = contact.dist - self.clearances[frozenset(int(geom) for geom in contact.geom)]
            self.spare[names] = min(spare, self.spare.get(names, 0.0))

    def touching(self, tolerance):
        """The bodies that have been nearer than allowed by more than a share of the robot's size."""
        return sorted(names for names, spare in self.spare.items() if spare < -tolerance * self.length)

    def lag(self, joints):
        """How far the worst driven joint is from `joints` (rad, or relative to the robot's size)."""
        return float(np.abs((self.data.qpos[self.driven] - joints) / self.unit).max())

    def deviation(self, pose):
        """How far the platform is from `pose`: the distance relative to the robot's size, or the angle if that is more."""
        place = [pose.get(name, 0.0) for name in "xyz"]
        distance = float(np.linalg.norm(self.data.xpos[self.platform] - place)) / self.length
        wanted = rotation(pose)
        if wanted is None:
            return distance
        turn = wanted.T @ self.data.xmat[self.platform].reshape(3, 3)
        axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        return max(distance, math.atan2(float(np.linalg.norm(axis)), float(np.trace(turn)) - 1.0))


def replay(robot, trajectory, tolerance):
    """Per row: deviation of the platform, opening of the loops, lag of the driven joints."""
    poses = [dict(zip(robot.pose_names, pose)) for pose in trajectory.poses]
    path = robot.turns(trajectory.joints)
    robot.place(poses[0], path[0], tolerance)
    found = []
    for pose, joints in zip(poses, path):
        robot.drive(joints)
        found.append((robot.deviation(pose), robot.gap(), robot.lag(joints)))
    return np.array(found)


def positive(text):
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError("give a positive number")
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", required=True, help="what `aspecta export mjcf` has written")
    parser.add_argument(
        "--trajectory", required=True, help="CSV: `time` or `segment,t`, the pose, q1, q2, …; angles in rad"
    )
    parser.add_argument(
        "--tolerance",
        type=positive,
        default=1e-3,
        help="greatest deviation, relative to the robot's size, or rad [1e-3]",
    )
    arguments = parser.parse_args()
    try:
        robot = Robot(arguments.model)
        trajectory = Trajectory(arguments.trajectory, robot.pose_names, robot.joint_names)
        found = replay(robot, trajectory, arguments.tolerance)
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    worst = int(np.argmax(found[:, 0]))
    kept = bool(np.all(found <= arguments.tolerance))
    touched = ", ".join(robot.touching(arguments.tolerance))
    print(f"{Path(arguments.model).name}: {len(found)} rows, {robot.data.time:.1f} s simulated")
    print(f"  platform  {found[worst, 0]:.1e} at most (row {worst + 1}), {found[-1, 0]:.1e} at the end")
    print(f"  loops     {found[:, 1].max():.1e} open at most")
    print(f"  joints    {found[:, 2].max():.1e} off at most")
    verdict = "within" if kept else "BEYOND"
    print(f"  {verdict} the tolerance of {arguments.tolerance:g} (of the robot's size, {robot.length:g}, or rad)")
    if robot.model.npair:
        print(f"  bodies    {touched or f'none of {robot.model.npair} pairs'} in contact")
    return 0 if kept and not touched else 1


if __name__ == "__main__":
    sys.exit(main())
