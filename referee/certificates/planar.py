"""Robots in the plane as certificates tell them (docs/certificate.md, "The robot"; docs/theory.md, section 2)."""

from enclosures import determinant, dot, interval
from flint import arb

LENGTHS = {"revolute": ("crank", "rod"), "prismatic": ("rod",), "strut": ()}
LIMITS = {  # their constants, and the kinds of legs that may have them
    "actuator-angle": (("middle", "half_cos"), ("revolute",)),
    "actuator-length": (("min", "max"), ("prismatic", "strut")),
    "elbow": (("middle", "half_cos"), ("revolute",)),
    "base-cone": (("axis", "half_cos"), tuple(LENGTHS)),
    "platform-cone": (("axis", "half_cos"), tuple(LENGTHS)),
}


class NotACertificate(Exception):
    """The file does not have the form that docs/certificate.md describes."""


class NotChecked(Exception):
    """A certificate that this program does not know how to check."""


def demand(condition, otherwise):
    if not condition:
        raise NotACertificate(otherwise)


def keys(value, *names, optional=()):
    """The values of the keys of an object that has these and no others."""
    known = isinstance(value, dict) and set(names) <= set(value) <= {*names, *optional}
    demand(known, f"wanted is an object with the keys {', '.join(names)}, not {str(value)[:60]}")
    return [value[name] for name in names]


def items(value, count=None):
    """A list, of that many items."""
    demand(
        isinstance(value, list) and count in (None, len(value)),
        f"wanted are {count or 'some'} items, not {str(value)[:60]}",
    )
    return value


def number(value):
    """A finite double."""
    finite = isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < float("inf")
    demand(finite, f"wanted is a number, not {str(value)[:60]}")
    return float(value)


def constant(value):
    """An interval, as a ball."""
    lo, hi = map(number, keys(value, "lo", "hi"))
    demand(lo <= hi, f"an interval from {lo} to {hi}")
    return interval(lo, hi)


def vector(value, count=3):
    """The first two components of a vector."""
    return [constant(x) for x in items(value, count)][:2]


def quarter_turn(v):
    return [-v[1], v[0]]


class Limit:
    """A limit of a joint: the name of the joint, a direction or None, and the other constants."""

    def __init__(self, value, kind):
        self.joint = value.get("joint") if isinstance(value, dict) else None
        names, kinds = LIMITS.get(self.joint, ((), ()))
        if self.joint == "clearance":
            raise NotChecked("a robot with obstacles")
        demand(kind in kinds, f"a limit of the joint {self.joint} of a {kind} leg")
        _, first, second = keys(value, "joint", *names, optional=["turns"] if self.joint == "actuator-angle" else [])
        if self.joint == "actuator-length":
            self.min, self.max = constant(first), constant(second)
            demand(self.min.upper() < self.max.lower(), "a least length that is not less than the greatest")
        else:
            self.direction, self.half_cos = vector(first, 2 if names[0] == "middle" else 3), constant(second)


class Leg:
    """A leg from A to C, in whose own frame d is the way from A to C and s h the posture's sign times √H."""

    def __init__(self, value):
        anchor, attachment, frame, actuator, limits = keys(value, "anchor", "attachment", "frame", "actuator", "limits")
        self.anchor, self.attachment = vector(anchor), vector(attachment)
        u, v = self.frame = [vector(row) for row in items(frame, 3)[:2]]
        right_handed = dot(u, u), dot(v, v), determinant([u, v])
        demand(
            all(x.contains(1) for x in right_handed) and dot(u, v).contains(0), "a frame that is not of unit vectors"
        )
        self.kind = actuator.get("kind") if isinstance(actuator, dict) else None
        demand(self.kind in LENGTHS, f"a leg of the kind {self.kind} in the plane")
        lengths = [constant(x) for x in keys(actuator, "kind", *LENGTHS[self.kind])[1:]]
        demand(all(x > 0 for x in lengths), "a link without length")
        self.limits = [Limit(limit, self.kind) for limit in items(limits)]
        if lengths:
            *crank, self.rod = lengths
        if self.kind == "revolute":
            (crank,) = crank
            self.crank, self.product = crank, 2 * crank * self.rod
            self.sum, self.difference = crank**2 + self.rod**2, crank**2 - self.rod**2

    def reach(self, d):
        """H: the leg closes strictly where it is > 0."""
        if self.kind == "prismatic":
            return -d[1].square() + self.rod**2
        if self.kind == "strut":
            return dot(d, d)
        return -(dot(d, d).tight() + -self.sum).square() + self.product**2

    def weight(self, d):
        """w = ‖d‖² of a revolute leg; of others it is 1, None here."""
        return dot(d, d).tight() if self.kind == "revolute" else None

    def force(self, d, swing):
        """w ∂f/∂d, which is 2w times the way from B to C (strut: from A to C)."""
        if self.kind == "strut":
            return [x * arb(2) for x in d]
        if self.kind == "prismatic":
            return [swing * arb(-2), d[1] * arb(2)]
        along = dot(d, d).tight() + -self.difference
        return [along * x - swing * y for x, y in zip(d, quarter_turn(d), strict=True)]

    def rod_direction(self, d, swing):
        """The unit vector from B to C (strut: from A to C); None if C may be on the motor's axis."""
        if self.kind == "prismatic":
            return [x * (1 / (2 * self.rod)) for x in self.force(d, swing)]
        square = dot(d, d).tight()
        if not square.range > 0:
            return None
        if self.kind == "strut":
            return [x * square.sqrt().inverse() for x in d]
        return [x * (square * (2 * self.rod)).inverse() for x in self.force(d, swing)]

    def crank_direction(self, d, swing):
        """(cos q, sin q); None if C may be on the motor's axis."""
        square = dot(d, d).tight()
        if not square.range > 0:
            return None
        along = square + self.difference
        scale = (square * (2 * self.crank)).inverse()
        return [(along * x + swing * y) * scale for x, y in zip(d, quarter_turn(d), strict=True)]

    def own_margin(self, limit, d, swing):
        """The function that is > 0 where a limit of the actuator or the elbow is kept strictly."""
        if limit.joint == "actuator-length":
            if self.kind == "strut":
                return (dot(d, d) + -(limit.min**2)) * (-dot(d, d) + limit.max**2)
            q = d[0] + swing
            return (q + -limit.min) * (-q + limit.max)
        cos, sin = limit.direction
        if limit.joint == "elbow":  # 2LM (cos ψ, sin ψ) = (‖d‖² − L² − M², −s h)
            return (dot(d, d) + -self.sum) * cos - swing * sin + -(self.product * limit.half_cos)
        crank = self.crank_direction(d, swing)
        return crank and dot(crank, limit.direction) + -limit.half_cos

    def reachable(self, k):
        """Coordinate k of the ends of a segment and a distance: C is no further than it from the segment; None if it may be anywhere."""
        a = self.anchor[k]
        if self.kind == "revolute":
            return a, a, self.crank + self.rod
        for limit in self.limits:
            if limit.joint == "actuator-length":
                if self.kind == "strut":
                    return a, a, limit.max
                return a + self.frame[0][k] * limit.min, a + self.frame[0][k] * limit.max, self.rod
        return None


class Robot:
    """A robot whose poses are (x, y), or (x, y, φ) if its platform is a body."""

    def __init__(self, value):
        if isinstance(value, dict) and "rod_angles" in value:
            raise NotChecked("a robot with limits that two legs share")
        if isinstance(value, dict) and ("pairs" in value or "bodies" in value):
            raise NotChecked("a robot with bodies")
        *_, platform, legs, window = keys(value, "name", "title", "source", "length_unit", "platform", "legs", "window")
        if platform not in ("plane-point", "plane-body"):
            raise NotChecked(f"a robot whose platform is a {platform}")
        self.turns = platform == "plane-body"
        self.coordinates = 3 if self.turns else 2
        self.legs = [Leg(leg) for leg in items(legs, self.coordinates)]
        alike = [[leg[key] for key in ("anchor", "attachment", "frame", "actuator")] for leg in legs]
        if any(leg in alike[:j] for j, leg in enumerate(alike)):
            raise NotChecked("a robot two of whose legs are one and the same")
        demand(self.turns or all(x == 0 for leg in self.legs for x in leg.attachment), "an attachment of a point")
        ends = items(window, self.coordinates)
        self.window = [pair and tuple(map(number, items(pair, 2))) for pair in ends]

    def spans(self, pose):
        """Per leg d in its frame, and ∂C/∂φ in the base (nothing if the platform does not turn)."""
        spans, spins = [], []
        for leg in self.legs:
            base = [pose[k] + -leg.anchor[k] for k in (0, 1)]
            spin = []
            if self.turns:
                sin, cos = pose[2].sin_cos()
                x, y = leg.attachment
                arm = [cos * x - sin * y, sin * x + cos * y]
                base, spin = [b + a for b, a in zip(base, arm, strict=True)], quarter_turn(arm)
            spans.append([dot(row, base).tight() for row in leg.frame])
            spins.append(spin)
        return spans, spins

    def rows(self, spans, spins, swings):
        """A, each row times the weight of its leg."""
        rows = []
        for leg, d, spin, swing in zip(self.legs, spans, spins, swings, strict=True):
            own = leg.force(d, swing)
            force = [dot(own, column) for column in zip(*leg.frame, strict=True)]
            rows.append([*force, dot(force, spin)] if spin else force)
        return rows

    def margin(self, leg, limit, pose, d, swing):
        """The function that is > 0 where a limit is kept strictly; None where a box is too wide for it."""
        if limit.joint not in ("base-cone", "platform-cone"):
            return leg.own_margin(limit, d, swing)
        rod = leg.rod_direction(d, swing)
        if rod and limit.joint == "platform-cone":
            rod = [dot(rod, column) for column in zip(*leg.frame, strict=True)]
            if self.turns:
                sin, cos = pose[2].sin_cos()
                rod = [cos * rod[0] + sin * rod[1], cos * rod[1] - sin * rod[0]]
        return rod and dot(rod, limit.direction) + -limit.half_cos

    def extents(self, k):
        """Least and greatest values that legs allow of coordinate k of the platform's origin, of each that does."""
        for leg in self.legs:
            if reachable := leg.reachable(k):
                a, b, distance = reachable
                distance += dot(leg.attachment, leg.attachment).sqrt()
                yield a.min(b) - distance, a.max(b) + distance
