"""Platforms, and the direct problem as PHCpack is given it; nothing here is taken from Aspecta.

A platform has its base's joints P, its platform's joints c and the legs' lengths ρ. Its poses are v ↦ R v + p with
‖R c + p − P‖ = ρ.
"""

import math
import random
import tomllib
from dataclasses import dataclass

from polynomial import variables


def dot(a, b):
    terms = [x * y for x, y in zip(a, b)]
    return sum(terms[1:], terms[0])


def product(a, b):
    """Of quaternions, of numbers or of polynomials."""
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def conjugate(e):
    return [e[0], -e[1], -e[2], -e[3]]


def turned(e, v):
    """e v ē = ‖e‖² R(e) v."""
    nil = v[0] * 0.0
    return product(product(e, [nil, *v]), conjugate(e))[1:]


def rotation(e):
    """R(e), also of a complex quaternion."""
    columns = [turned(e, [float(i == k) for i in range(3)]) for k in range(3)]
    return [[columns[k][i] / dot(e, e) for k in range(3)] for i in range(3)]


def applied(r, v):
    return [dot(row, v) for row in r]


def transposed(r):
    return [list(row) for row in zip(*r)]


@dataclass
class Platform:
    name: str
    base: list
    joints: list
    lengths: list

    def residual(self, r, p):
        """The largest error of ‖R c + p − P‖², also at a complex pose."""
        ends = [[x + y - z for x, y, z in zip(applied(r, c), p, b)] for b, c in zip(self.base, self.joints)]
        return max(abs(dot(end, end) - rho**2) for end, rho in zip(ends, self.lengths))

    def robot_file(self):
        legs = [f'[[legs]]\nanchor = {b}\nattachment = {c}\nactuator = {{ kind = "strut" }}\n'
                for b, c in zip(self.base, self.joints)]
        return f'name = "{self.name}"\nplatform = "free-body"\n\n' + "\n".join(legs)


def from_robot_file(path, lengths):
    robot = tomllib.loads(path.read_text())
    legs = robot["legs"]
    return Platform(robot["name"], [leg["anchor"] for leg in legs], [leg["attachment"] for leg in legs], lengths)


def random_platform(name):
    """Joints uniform in [−1, 1]³, lengths from a random pose. The name is the seed."""
    draw = random.Random(name)
    point = lambda: [draw.uniform(-1.0, 1.0) for _ in range(3)]
    base, joints, p = [point() for _ in range(6)], [point() for _ in range(6)], point()
    r = rotation([draw.gauss(0.0, 1.0) for _ in range(4)])
    ends = [[x + y for x, y in zip(applied(r, c), p)] for c in joints]
    return Platform(name, base, joints, [math.dist(b, end) for b, end in zip(base, ends)])


class Posed:
    """The direct problem of one platform in the frames that suit PHCpack.

    Both origins are the ends of the first leg, and the base is turned at random: an orientation is then the quaternion
    e = (1, x₁, x₂, x₃) unless it is half a turn away from the random one, which almost none is.
    """

    def __init__(self, platform):
        draw = random.Random(f"frame of {platform.name}")
        self.platform = platform
        self.turn = rotation([draw.gauss(0.0, 1.0) for _ in range(4)])
        away = lambda points: [[x - o for x, o in zip(v, points[0])] for v in points]
        base = [applied(self.turn, v) for v in away(platform.base)]
        self.legs = list(zip(base, away(platform.joints), platform.lengths))

    def equations(self):
        """Seven quadrics in x and g = p e: ‖e‖² ‖p‖² = ‖g‖², ‖e‖² p = g ē, ‖e‖² Rᵀp = ē g and e · g = 0.

        A solution with e · e ≠ 0 is a pose. Those with e = 0, which are none, are at infinity here.
        """
        one, unknowns = variables(7)
        e, g = [one, *unknowns[:3]], unknowns[3:]
        position, back = product(g, conjugate(e))[1:], product(conjugate(e), g)[1:]

        def leg(base, joint, length):
            fixed = dot(joint, joint) + dot(base, base) - length**2
            arm = turned(e, [one * x for x in joint])
            mixed = dot(joint, back) - dot(base, arm) - dot(base, position)
            return dot(g, g) + dot(e, e) * fixed + 2.0 * mixed

        return [*(leg(*given) for given in self.legs), dot(e, g)]

    def pose(self, unknowns):
        """R and p in the platform's own frames."""
        e, g = [1.0, *unknowns[:3]], unknowns[3:]
        r, back = rotation(e), transposed(self.turn)
        p = [value / dot(e, e) for value in product(g, conjugate(e))[1:]]
        r = [[dot(row, column) for column in transposed(r)] for row in back]
        arm = applied(r, self.platform.joints[0])
        return r, [a + b - c for a, b, c in zip(applied(back, p), self.platform.base[0], arm)]
