#!/usr/bin/env python3
"""Plants faults in certificates that are verified: each makes a claim false, or takes its proof away, and must be refused.

Ten faults a certificate, drawn with a fixed seed. With --harmless what is planted is weaker claims, which are true: that these are
accepted shows that a fault which slips through is seen. Exit status: 0 all are refused, 1 something was accepted, or an original refused.
"""

import argparse
import copy
import json
import random
import sys
from collections import Counter
from itertools import cycle, pairwise
from pathlib import Path

from check import TOKEN, Certificate, NotACertificate, Wrong, check, components, parse
from proofs import prove

A_CERTIFICATE = 10


class Planter:
    """A certificate to plant faults in, and what its leaves are."""

    def __init__(self, value, chance):
        self.value, self.chance = value, chance
        self.certificate = Certificate(value)
        self.leaves = self.certificate.leaves
        self.classes = range(len(value["claims"]))

    def some(self, options):
        """One of several, None of none."""
        options = list(options)
        return self.chance.choice(options) if options else None

    def changed(self, change):
        """A copy, changed."""
        value = copy.deepcopy(self.value)
        change(value)
        return value

    def leaves_changed(self, changes):
        """A copy whose leaves at these indices have other sets, and which claims nothing of counts: the leaves must give it away."""
        tree = self.value["sheets"][0]["tree"]
        tokens = [token.group() for token in TOKEN.finditer(tree)]
        places = [k for k, token in enumerate(tokens) if token != "+"]
        for index, sets in changes.items():
            tokens[places[index]] = ":".join(f"{bits:x}" if bits else "" for bits in sets).rstrip(":") + ";"

        def change(value):
            value["sheets"][0]["tree"] = "".join(tokens)
            value["claims"] = [{"low": 0, "high": None} for _ in self.classes]

        return self.changed(change)

    def leaf_moved(self, start, end, beside=None):
        """A leaf of a class is said to be something else: start and end are `inside`, `undecided` or `outside`."""
        options = []
        for c in self.classes:
            kinds = [self.kind(leaf, c) for leaf in self.leaves]
            near = self.beside(c, beside) if beside else None
            options += [(i, c) for i, kind in enumerate(kinds) if kind == start and (near is None or i in near)]
        if not options:
            return None
        index, c = self.chance.choice(options)
        leaf, bit = self.leaves[index], 1 << c
        inside, undecided = leaf.inside & ~bit, leaf.undecided & ~bit
        return self.leaves_changed({index: (inside | bit * (end == "inside"), undecided, leaf.summitless)})

    @staticmethod
    def kind(leaf, c):
        return "inside" if leaf.inside >> c & 1 else "undecided" if leaf.undecided >> c & 1 else "outside"

    def beside(self, c, kind):
        """Indices of leaves that share a point with one that is of this kind for class c."""
        index = {(leaf.depth, leaf.place): i for i, leaf in enumerate(self.leaves)}
        found = set()
        for i, leaf in enumerate(self.leaves):
            for axis in range(len(leaf.place)):
                for step in (-1, 1):
                    place = tuple(x + step * (k == axis) for k, x in enumerate(leaf.place))
                    above = ((leaf.depth - up, tuple(x >> up for x in place)) for up in range(leaf.depth + 1))
                    other = next((index[cell] for cell in above if cell in index), None)
                    if other is not None and self.kind(self.leaves[other], c) == kind:
                        found.add(i)
        return found

    def middle(self, leaf):
        """The pose in the middle of a leaf."""
        pose = [lo for lo, _ in self.certificate.ranges]
        for k, (lo, hi) in zip(self.certificate.axes, self.certificate.box(leaf), strict=True):
            pose[k] = (lo + hi) / 2
        return pose

    # The faults: each a copy of the certificate, or None where there is no place for it.

    def inside_called_outside(self):
        return self.leaf_moved("inside", "outside")

    def outside_called_inside(self):
        return self.leaf_moved("outside", "inside")

    def undecided_beside_inside_called_outside(self):
        return self.leaf_moved("undecided", "outside", beside="inside")

    def undecided_beside_outside_called_inside(self):
        return self.leaf_moved("undecided", "inside", beside="outside")

    def inside_with_the_other_sign(self):
        index, c = self.some((i, c) for i, leaf in enumerate(self.leaves) for c in self.classes if leaf.inside >> c & 1)
        leaf = self.leaves[index]
        return self.leaves_changed({index: (leaf.inside ^ 3 << c // 2 * 2, leaf.undecided, leaf.summitless)})

    def summits_denied(self):
        """The leaves of a class that may hold summits of an aspect are said to hold none."""
        c = self.some(c for c in self.classes if self.value["claims"][c]["low"])
        held = {i: leaf for i, leaf in enumerate(self.leaves) if leaf.inside >> c & 1 and not leaf.summitless >> c & 1}
        changes = {i: (leaf.inside, leaf.undecided, leaf.summitless | 1 << c) for i, leaf in held.items()}
        return self.leaves_changed(changes)

    def signs_exchanged(self):
        """All that is said of det A > 0 is said of det A < 0, and the other way round."""
        c = self.some(c for c in self.classes if self.value["claims"][c]["low"]) // 2 * 2

        def swapped(bits):
            return bits & ~(3 << c) | (bits >> c & 1) << c + 1 | (bits >> c + 1 & 1) << c

        sets = ((leaf.inside, leaf.undecided, leaf.summitless) for leaf in self.leaves)
        return self.leaves_changed({i: tuple(map(swapped, leaf)) for i, leaf in enumerate(sets)})

    def one_aspect_more(self):
        c = self.some(self.classes)
        more = self.value["claims"][c]["low"] + 1
        return self.changed(lambda value: value["claims"][c].update(low=more, high=more))

    def one_aspect_less(self):
        c = self.some(c for c in self.classes if self.value["claims"][c]["low"])
        less = self.value["claims"][c]["low"] - 1
        return self.changed(lambda value: value["claims"][c].update(low=less, high=less))

    def aspects_joined(self):
        """A join leads straight from an aspect to another of its class, or out of it and back."""
        c = self.some(c for c in self.classes if self.value["claims"][c]["low"])
        held = [leaf for leaf in self.leaves if self.kind(leaf, c) != "outside"]
        aspects = [[leaf for leaf in part if leaf.inside >> c & 1] for part in components(self.certificate, held)]
        ends = [self.middle(self.some(leaves)) for leaves in aspects if leaves]
        if len(ends) == 1:
            ends += [self.middle(self.some(leaf for leaf in self.leaves if self.kind(leaf, c) == "outside")), ends[0]]
        path = [point for pair in pairwise(ends) for point in pair]
        return self.changed(lambda value: value["joins"].append({"class": c, "sheet": 0, "path": path}))

    def window_narrower(self):
        free = [(k, end) for k in self.certificate.axes for end in (0, 1) if not self.certificate.cut[k][end]]
        k, end = self.some(free)
        ranges = self.value["window"]["ranges"][k]
        moved = ranges[end] + (ranges[1 - end] - ranges[end]) / 20
        return self.changed(lambda value: value["window"]["ranges"][k].__setitem__(end, moved))

    def cut_forgotten(self):
        end = self.some((k, end) for k in self.certificate.axes for end in (0, 1) if self.certificate.cut[k][end])
        return end and self.changed(lambda value: value["window"]["cut"][end[0]].__setitem__(end[1], False))

    def turn_not_glued(self):
        k = self.some(k for k, glued in enumerate(self.certificate.glued) if glued)
        return k and self.changed(lambda value: value["window"]["glued"].__setitem__(k, False))

    def link_scaled(self, factor):
        leg = self.chance.randrange(len(self.value["robot"]["legs"]))

        def change(value):
            actuator, limits = (value["robot"]["legs"][leg][key] for key in ("actuator", "limits"))
            strut = next((limit["max"] for limit in limits if limit["joint"] == "actuator-length"), None)
            link = actuator.get("crank") or actuator.get("rod") or strut
            link.update({end: x * factor for end, x in link.items()})

        return self.changed(change)

    def link_longer(self):
        return self.link_scaled(1.05)

    def link_shorter(self):
        return self.link_scaled(0.95)

    def proof_of_no_summit_missing(self):
        open_leaves = [(i, leaf.undecided & leaf.summitless) for i, leaf in enumerate(self.leaves)]
        index, c = self.some((i, c) for i, bits in open_leaves for c in self.classes if bits >> c & 1)
        leaf = self.leaves[index]
        faulty = self.leaves_changed({index: (leaf.inside, leaf.undecided, leaf.summitless & ~(1 << c))})
        return {**faulty, "claims": self.value["claims"]}

    def leaf_missing(self):
        tree = self.value["sheets"][0]["tree"]
        return self.changed(lambda value: value["sheets"][0].update(tree=tree[: tree[:-1].rindex(";") + 1]))


FAULTS = [
    Planter.inside_called_outside,
    Planter.outside_called_inside,
    Planter.undecided_beside_inside_called_outside,
    Planter.undecided_beside_outside_called_inside,
    Planter.inside_with_the_other_sign,
    Planter.summits_denied,
    Planter.signs_exchanged,
    Planter.one_aspect_more,
    Planter.one_aspect_less,
    Planter.aspects_joined,
    Planter.window_narrower,
    Planter.cut_forgotten,
    Planter.turn_not_glued,
    Planter.link_longer,
    Planter.link_shorter,
    Planter.proof_of_no_summit_missing,
    Planter.leaf_missing,
]


def remembering(value, proved):
    """`prove`, which does not prove again what is proved of a box of the same robot."""
    about = json.dumps([value[key] for key in ("robot", "window", "modes", "scale")])

    def prove_box(domain, ranges, claims):
        key = about, tuple(ranges), tuple(claims)
        if key not in proved:
            proved[key] = prove(domain, ranges, claims)
        return proved[key]

    return prove_box


def verdict(value, proved):
    """Why a certificate is refused; None if it is not."""
    try:
        check(parse(json.dumps(value)), remembering(value, proved))
    except (Wrong, NotACertificate) as error:
        return str(error)
    return None


def weakened(value, k):
    """The k-th weaker certificate."""
    value = copy.deepcopy(value)
    claim = value["claims"][k % len(value["claims"])]
    claim.update(high=None) if k % 2 else claim.update(low=0)
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--harmless", action="store_true", help="plant what is true")
    parser.add_argument("files", nargs="+", help="certificates")
    arguments = parser.parse_args()
    kinds, slipped, faults = Counter(), 0, cycle(FAULTS)
    for number, name in enumerate(arguments.files):
        value, proved, planted = parse(Path(name).read_text(encoding="utf-8")), {}, 0
        if (reason := verdict(value, proved)) is not None:
            print(f"{name}: refused, {reason}")
            return 1
        planter = Planter(value, random.Random(22 + number))
        # Each certificate begins where the one before it ended, so that all kinds occur.
        while planted < A_CERTIFICATE:
            fault = next(faults)
            label = "weaker claims" if arguments.harmless else fault.__name__.replace("_", " ")
            faulty = weakened(value, planted) if arguments.harmless else fault(planter)
            if faulty is None:
                continue
            planted += 1
            kinds[label] += 1
            if (reason := verdict(faulty, proved)) is None:
                slipped += 1
                print(f"{name}: accepted, with {label}")
            else:
                print(f"   {label}: {reason}")
    print(f"{kinds.total()} faults of {len(kinds)} kinds planted, {kinds.total() - slipped} refused")
    return 1 if slipped else 0


if __name__ == "__main__":
    sys.exit(main())
