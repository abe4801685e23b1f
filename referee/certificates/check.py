#!/usr/bin/env python3
"""Checks certificates of robots in the plane with Arb's balls: a second opinion to that of `aspecta verify`.

Written from docs/certificate.md and docs/theory.md. Exit status: 0 every claim is proved, 1 some claim is wrong or could not be
proved, 2 not a certificate, 3 not one that this program can check (robots in space, charts of folds, legs that are one and
the same).
"""

import argparse
import dataclasses
import json
import math
import re
import sys
from itertools import pairwise, product
from pathlib import Path

from enclosures import Form
from flint import arb
from planar import NotACertificate, NotChecked, Robot, demand, items, keys, number
from proofs import INSIDE, OUTSIDE, SUMMITLESS, Domain, Wrong, prove

TOKEN = re.compile(r"(\+)|(\*?)([0-9a-f]*)(?::([0-9a-f]*)(?::([0-9a-f]*))?)?;")
DEPTH = 30
PI_ABOVE = math.nextafter(math.pi, 4)


@dataclasses.dataclass(frozen=True, eq=False)
class Leaf:
    """A box without parts, as whole numbers: cell `place` of the grid of 2^depth cells an axis; and sets of classes, as bits."""

    depth: int
    place: tuple
    inside: int
    undecided: int
    summitless: int


class Scale:
    """The constants that the functions of which P is the least are divided by."""

    def __init__(self, value, robot):
        det, reach, limits = keys(value, "det", "reach", "limits")
        self.det, self.reach = number(det), [number(x) for x in items(reach, len(robot.legs))]
        of_legs = zip(items(limits, len(robot.legs)), robot.legs, strict=True)
        self.limits = [number(x) for scales, leg in of_legs for x in items(scales, len(leg.limits))]
        demand(all(x > 0 for x in (self.det, *self.reach, *self.limits)), "a scale that is not positive")


class Certificate:
    """A certificate whose form is right; what it claims is still to be proved."""

    def __init__(self, value):
        names = ("certificate_version", "robot", "window", "modes", "scale", "claims", "sheets", "joins", "seams")
        version, robot, window, modes, scale, claims, sheets, joins, seams = keys(value, *names)
        demand(version == 2, f"a certificate of version {version}")
        self.robot = Robot(robot)
        if len(items(sheets)) != 1 or items(seams):
            raise NotChecked("a certificate with charts of folds")
        chart, tree = keys(sheets[0], "chart", "tree")
        demand(chart == "pose", "a first sheet that is not of poses")
        n, ranges = self.robot.coordinates, keys(window, "ranges", "glued", "angles", "cut")
        self.ranges = [tuple(map(number, items(ends, 2))) for ends in items(ranges[0], n)]
        self.glued, angles, self.cut = (items(x, n) for x in ranges[1:])
        demand(angles == [False, False, True][:n], "angles that are none")
        self.axes = [k for k, (lo, hi) in enumerate(self.ranges) if lo != hi]
        self.modes = self._signs(items(modes))
        self.scale = Scale(scale, self.robot)
        self.claims = [keys(claim, "low", "high") for claim in items(claims, 2 * len(modes))]
        self.joins = [keys(join, "class", "sheet", "path") for join in items(joins)]
        self.leaves = list(self._leaves(tree))

    def _signs(self, modes):
        legs = self.robot.legs
        words = [re.fullmatch(f"[+-]{{{len(legs)}}}", str(mode)) for mode in modes]
        demand(
            modes and all(words) and len(set(modes)) == len(modes),
            "working modes that are not different words of signs",
        )
        plus = any(sign == "+" and leg.kind == "strut" for mode in modes for sign, leg in zip(mode, legs, strict=True))
        demand(not plus, "a strut with the posture +")
        return [[1 if sign == "+" else -1 for sign in mode] for mode in modes]

    def _leaves(self, tree):
        demand(isinstance(tree, str) and self.axes, "a tree that is no string, or without coordinates")
        at, stack, parts = 0, [(0, (0,) * len(self.axes))], list(product((0, 1), repeat=len(self.axes)))
        while stack:
            depth, place = stack.pop()
            token = TOKEN.match(tree, at)
            demand(token, f"a tree that cannot be read from character {at} on")
            cut, covered, *sets = token.groups()
            at = token.end()
            if cut:
                demand(depth < DEPTH, "a tree that is too deep")
                # Child c is in the upper half of axis a if bit a of c is 1; the first child is to be read first.
                stack.extend(
                    (depth + 1, tuple(2 * i + bit for i, bit in zip(place, c[::-1], strict=True))) for c in parts[::-1]
                )
                continue
            demand(not covered, "a leaf that is covered, without a chart to cover it")
            inside, undecided, summitless = (int(bits or "0", 16) for bits in sets)
            demand(max(inside, undecided, summitless) < 4 ** len(self.modes), "a class that there is not")
            yield Leaf(depth, place, inside, undecided & ~inside, summitless)
        demand(at == len(tree), "more in a tree than its leaves")

    def domain(self):
        """The poses of the window, by the coordinates that vary."""

        def pose(variables):
            box = variables[0].box
            coordinates = [Form(arb(lo), arb(lo), [arb(0)] * len(box), box) for lo, _ in self.ranges]
            for k, variable in zip(self.axes, variables, strict=True):
                coordinates[k] = variable
            return coordinates

        def faces(pose):
            for k in self.axes:
                low, high = map(arb, self.ranges[k])
                if self.cut[k][0]:
                    yield (pose[k] + -low) * (1 / (high - low))
                if self.cut[k][1]:
                    yield (-pose[k] + high) * (1 / (high - low))

        widths = [self.ranges[k][1] - self.ranges[k][0] for k in self.axes]
        return Domain(self.robot, self.modes, self.scale, pose, faces, widths)

    def box(self, leaf):
        """The ranges of the coordinates that vary, in the doubles of the lines."""

        def line(k, i):
            (lo, hi), parts = self.ranges[k], 2**leaf.depth
            return hi if i == parts else lo + (hi - lo) * (i / parts)

        return [(line(k, i), line(k, i + 1)) for k, i in zip(self.axes, leaf.place, strict=True)]


def check_window(certificate):
    """The window holds all poses of the workspace, up to the ends at which the user's window cuts."""
    robot = certificate.robot
    for k, (lo, hi) in enumerate(certificate.ranges):
        user, name, held = robot.window[k], "xyφ"[k], lo == hi
        if k == 2 and user and user[1] - user[0] >= math.tau:
            user = None  # a full turn is no limit
        glued, cut = certificate.glued[k], certificate.cut[k]
        if held:
            right = not glued and cut == [False, False] and (user is None or user[0] <= lo <= user[1])
        elif k == 2 and user is None:
            right = glued is True and (lo, hi) == (-PI_ABOVE, PI_ABOVE) and cut == [False, False]
        elif k == 2:
            right = glued is False and (lo, hi) == user and cut == [True, True]
        else:
            ends = user or (None, None)
            low = lo == ends[0] if cut[0] is True else any(lo <= least for least, _ in robot.extents(k))
            high = hi == ends[1] if cut[1] is True else any(hi >= most for _, most in robot.extents(k))
            right = glued is False and lo < hi and low and high
        if not right:
            raise Wrong(f"the window of {name} is not that of the robot")


def check_leaves(certificate, prove_box):
    """Every leaf is inside, outside and summitless as it says; returns the number of pieces looked at."""
    domain, pieces = certificate.domain(), 0
    for index, leaf in enumerate(certificate.leaves):
        claims = []
        for c in range(2 * len(certificate.modes)):
            inside, undecided, summitless = (bits >> c & 1 for bits in (leaf.inside, leaf.undecided, leaf.summitless))
            if not undecided:
                claims.append((INSIDE if inside else OUTSIDE, c))
            if summitless and (inside or undecided):
                claims.append((SUMMITLESS, c))
        try:
            pieces += prove_box(domain, certificate.box(leaf), claims)
        except Wrong as wrong:
            raise Wrong(f"leaf {index}: {wrong}") from None
    return pieces


def check_join(certificate, number_of_class, sheet, path):
    """A path of segments lies in its class (theory, section 4); returns a leaf inside the class at each of its ends."""
    robot, domain = certificate.robot, certificate.domain()
    demand(
        type(number_of_class) is int and 0 <= number_of_class < 2 * len(certificate.modes) and sheet == 0,
        "a join in no class",
    )
    path = [[number(x) for x in items(point, robot.coordinates)] for point in items(path)]
    demand(path, "a join without points")
    for point in path:
        for k, (lo, hi) in enumerate(certificate.ranges):
            if not lo <= point[k] <= hi and not certificate.glued[k]:
                raise Wrong("a join leaves the window")
    for a, b in pairwise(path):

        def pose(parameters, a=a, b=b):
            return [parameters[0] * (arb(y) - arb(x)) + arb(x) for x, y in zip(a, b, strict=True)]

        prove(dataclasses.replace(domain, pose=pose, widths=[1.0]), [(0.0, 1.0)], [(INSIDE, number_of_class)])
    for point in (path[0], path[-1]):
        for leaf in certificate.leaves:
            box = zip(certificate.axes, certificate.box(leaf), strict=True)
            if leaf.inside >> number_of_class & 1 and all(lo <= point[k] <= hi for k, (lo, hi) in box):
                yield leaf
                break
        else:
            raise Wrong("a join that does not end in an inside leaf")


def components(certificate, leaves, links=()):
    """Sets of leaves that are joined by links or by touching: by sharing a point, also across the ends of glued angles."""
    cells = {(leaf.depth, leaf.place): leaf for leaf in leaves}
    root = {leaf: leaf for leaf in leaves}

    def find(leaf):
        while root[leaf] is not leaf:
            root[leaf] = root[root[leaf]]
            leaf = root[leaf]
        return leaf

    for a, b in links:
        root[find(a)] = find(b)
    glued = [certificate.glued[k] for k in certificate.axes]
    for leaf in leaves:
        # A leaf that touches a larger one has a neighbour of its own size in it.
        for step in product((-1, 0, 1), repeat=len(glued)):
            place = [i + j for i, j in zip(leaf.place, step, strict=True)]
            place = [i % 2**leaf.depth if around else i for i, around in zip(place, glued, strict=True)]
            for up in range(leaf.depth + 1):
                other = cells.get((leaf.depth - up, tuple(i >> up for i in place)))
                if other is not None:
                    root[find(leaf)] = find(other)
                    break
    parts = {}
    for leaf in leaves:
        parts.setdefault(find(leaf), []).append(leaf)
    return list(parts.values())


def check_counts(certificate, links):
    """The claims follow from the leaves: the sandwich of docs/theory.md, section 4. Returns the proved bounds."""
    proved = []
    for c, (low, high) in enumerate(certificate.claims):
        inside = [leaf for leaf in certificate.leaves if leaf.inside >> c & 1]
        undecided = [leaf for leaf in certificate.leaves if leaf.undecided >> c & 1]
        outer = components(certificate, inside + undecided)
        least = sum(any(leaf.inside >> c & 1 for leaf in part) for part in outer)
        most = None
        if all(leaf.summitless >> c & 1 for leaf in undecided):
            inner = components(certificate, inside, [ends for number_of_class, *ends in links if number_of_class == c])
            most = sum(any(not leaf.summitless >> c & 1 for leaf in part) for part in inner)
        whole = type(low) is int and low >= 0 and (high is None or type(high) is int)
        demand(whole, f"bounds of class {c} that are none")
        if least < low or (high is not None and (most is None or most > high)):
            raise Wrong(f"class {c}: claimed are {low} to {high} aspects, proved {least} to {most}")
        proved.append((least, most))
    return proved


def parse(text):
    """A JSON text in which no key stands twice."""

    def unique(pairs):
        demand(len(dict(pairs)) == len(pairs), "a key that stands twice")
        return dict(pairs)

    try:
        return json.loads(text, object_pairs_hook=unique)
    except (ValueError, RecursionError) as error:
        raise NotACertificate(f"no JSON: {error}") from None


def check(value, prove_box=prove):
    """Proves all claims of a certificate, or raises; returns it, the proved bounds per class and the number of pieces."""
    certificate = Certificate(value)
    check_window(certificate)
    links = [(join[0], *check_join(certificate, *join)) for join in certificate.joins]
    proved = check_counts(certificate, links)
    return certificate, proved, check_leaves(certificate, prove_box)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", help="certificate, as `aspecta analyze ROBOT --certificate FILE` writes it")
    try:
        text = Path(parser.parse_args().file).read_text(encoding="utf-8")
        certificate, proved, pieces = check(parse(text))
    except (OSError, UnicodeDecodeError, NotACertificate) as error:
        print(f"not a certificate: {error}")
        return 2
    except NotChecked as error:
        print(f"not checked: {error}")
        return 3
    except Wrong as error:
        print(f"not verified: {error}")
        return 1
    low, high = sum(least for least, _ in proved), [most for _, most in proved]
    count = f"at least {low}" if None in high else f"exactly {low}" if low == sum(high) else f"{low} to {sum(high)}"
    print(
        f"verified: {count} aspects; {len(certificate.leaves)} leaves, {pieces} pieces, {len(certificate.joins)} joins"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
