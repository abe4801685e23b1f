"""What is claimed of boxes and segments, proved by cutting them (docs/theory.md, sections 3 to 5)."""

from dataclasses import dataclass
from itertools import combinations, product

from enclosures import Form, determinant, dot, interval
from flint import arb

PIECES = 2000  # a claim that needs more is not proved
NEAR = 1.1  # h_j is a variable of its own where it may change by this factor in a piece
HEIGHTS = 0.05  # the width of a range of h_j counts this much when a piece is cut
INSIDE, OUTSIDE, SUMMITLESS = "inside", "outside", "summitless"


class Wrong(Exception):
    """A claim is false, or could not be proved."""


@dataclass(frozen=True)
class Domain:
    """Poses by parameters, and what aspects on them are: the signs of each mode and the functions that P is the least of."""

    robot: object
    modes: list
    scale: object
    pose: object  # the coordinates at given parameters
    faces: object  # at a pose: its distances to the faces where the user's window cuts, as shares of the window
    widths: list  # of the parameters' ranges, by which pieces are measured


@dataclass(frozen=True)
class Piece:
    """A part of a domain: an interval of each parameter, and of those h_j that are cut by themselves."""

    ranges: list
    heights: dict


class Region:
    """All configurations (X, h) over a piece, and the functions that bound aspects there.

    Legs named in `free` may be singular: h_j = √H_j is a variable of its own (theory, section 5, "Which vectors").
    """

    def __init__(self, domain, piece):
        self.domain, self.piece, robot = domain, piece, domain.robot
        balls = [interval(*ends) for ends in piece.ranges]
        box = [ball - ball.mid() for ball in balls]
        self.pose = domain.pose([Form.variable(ball, k, box) for k, ball in enumerate(balls)])
        self.spans, self.spins = robot.spans(self.pose)
        self.reaches = [leg.reach(d).tight() for leg, d in zip(robot.legs, self.spans, strict=True)]
        ranges = [self._height(j, reach.range) for j, reach in enumerate(self.reaches)]
        self.empty = None in ranges
        if not self.empty:
            self._widen(box, ranges)
        self.signed = {}

    def _height(self, j, reach):
        """The range of h_j, None if there is none."""
        if reach < 0:
            return None
        low, high = reach.lower().max(arb(0)).sqrt().lower(), reach.upper().sqrt().upper()
        least, greatest = map(arb, self.piece.heights.get(j, (0, "inf")))
        if low > greatest or least > high:
            return None
        return low.max(least).union(high.min(greatest))

    def _widen(self, box, ranges):
        """Makes the h_j of legs that may be singular variables, beside the parameters."""
        self.free = [
            j
            for j, (reach, h) in enumerate(zip(self.reaches, ranges, strict=True))
            if not reach.range > 0 or (h.lower() * NEAR < h.upper() and self.domain.robot.legs[j].kind != "strut")
        ]
        box = box + [ranges[j] - ranges[j].mid() for j in self.free]
        self.parameters = len(box) - len(self.free)
        self.pose, self.reaches = ([f.widened(box) for f in forms] for forms in (self.pose, self.reaches))
        self.spans, self.spins = (
            [[f.widened(box) for f in v] for v in vectors] for vectors in (self.spans, self.spins)
        )
        self.heights = []
        for j, (reach, h) in enumerate(zip(self.reaches, ranges, strict=True)):
            if j in self.free:
                self.heights.append(Form.variable(h, self.parameters + self.free.index(j), box))
            else:
                root = reach.sqrt()
                self.heights.append(Form(root.at, root.range.intersection(h), root.slopes, box))

    def functions(self, mode):
        """(Π w_j) det A and the margins of the limits in a working mode; a margin is None where a piece is too wide for it."""
        if mode not in self.signed:
            robot = self.domain.robot
            legs = list(zip(robot.legs, self.spans, self.heights, self.domain.modes[mode], strict=True))
            swings = [h * arb(sign) for _, _, h, sign in legs]
            margins = [
                robot.margin(leg, limit, self.pose, d, swing)
                for (leg, d, _, _), swing in zip(legs, swings, strict=True)
                for limit in leg.limits
            ]
            det = determinant(robot.rows(self.spans, self.spins, swings))
            self.signed[mode] = det.tight(), [margin and margin.tight() for margin in margins]
        return self.signed[mode]

    def side(self, mode, sign):
        """1 if the piece lies in S_{s,σ}, −1 if it is disjoint from it, 0 if neither is proved (theory, section 3)."""
        if self.empty:
            return -1
        det, margins = self.functions(mode)
        bounds = [
            det.range * sign,
            *(reach.range for reach in self.reaches),
            *(margin and margin.range for margin in margins),
        ]
        if any(g is not None and g < 0 for g in bounds):
            return -1
        return 1 if all(g is not None and g > 0 for g in bounds) else 0

    def summitless(self, mode, sign):
        """Whether P is proved to have no maximum over S_{s,σ} here: it grows along some field (theory, section 5)."""
        if self.empty:
            return True
        functions = self._functions_of_p(mode, sign)
        if functions is None:
            return False
        least = min((g.range.upper() for g in functions), key=float)
        if least < 0:
            return True
        fields = list(self._fields())
        growth = [[dot(g.slopes, field) for field in fields] for g in functions if not g.range.lower() > least]
        coefficients = combination(growth)
        return coefficients is not None and all(dot(row, map(arb, coefficients)) > 0 for row in growth)

    def _functions_of_p(self, mode, sign):
        """The g_k of which P is the least, each divided by its scale; None where a piece is too wide for them."""
        scale, (det, margins) = self.domain.scale, self.functions(mode)
        weights = [leg.weight(d) for leg, d in zip(self.domain.robot.legs, self.spans, strict=True)]
        if None in margins or not all(w is None or w.range > 0 for w in weights):
            return None
        for weight in filter(None, weights):
            det *= weight.inverse()
        functions = [
            det * (sign / arb(scale.det)),
            *(h * (1 / arb(s).sqrt()) for h, s in zip(self.heights, scale.reach, strict=True)),
            *(margin * (1 / arb(s)) for margin, s in zip(margins, scale.limits, strict=True)),
            *self.domain.faces(self.pose),
        ]
        return [g.tight() for g in functions]

    def _fields(self):
        """Vectors (Ẋ, ḣ) with 2 h_j ḣ_j = ∇H_j·Ẋ at every point (theory, section 5, "Which vectors")."""
        gradients = {j: self.reaches[j].slopes[: self.parameters] for j in self.free}
        for t in tangents(list(gradients.values()), self.parameters):
            yield t + [arb(0)] * len(self.free)
        for j in self.free:
            others = [gradient for i, gradient in gradients.items() if i != j]
            for m in tangents(others, self.parameters):
                rate = dot(gradients[j], m) / 2
                yield [x * self.heights[j].range for x in m] + [rate if i == j else arb(0) for i in self.free]

    def halves(self, with_heights):
        """The piece in two, cut across the widest of its sides."""
        ranges, heights = self.piece.ranges, self.piece.heights
        axes = range(len(ranges))
        axis = max(axes, key=lambda k: (ranges[k][1] - ranges[k][0]) / self.domain.widths[k])
        widest = (ranges[axis][1] - ranges[axis][0]) / self.domain.widths[axis]
        for j in self.free if with_heights else ():
            h = self.heights[j].range
            width = float(2 * h.rad()) / self.domain.scale.reach[j] ** 0.5 * HEIGHTS
            if width > widest:
                (low, high), middle = heights.get(j, (0.0, float("inf"))), float(h.mid())
                return [Piece(ranges, {**heights, j: part}) for part in ((low, middle), (middle, high))]
        low, high = ranges[axis]
        middle = low + (high - low) / 2
        return [Piece([*ranges[:axis], part, *ranges[axis + 1 :]], heights) for part in ((low, middle), (middle, high))]


def tangents(gradients, n):
    """Vectors of n components that are orthogonal to the given ones, exactly so at each point."""
    units = [[arb(i == k) for i in range(n)] for k in range(n)]
    if not gradients:
        return units
    if n == 2 and len(gradients) == 1:
        ((a, b),) = gradients
        return [[-b, a]]
    if n == 3 and len(gradients) <= 2:
        (a, b, c), *others = gradients
        return [[b * w - c * v, c * u - a * w, a * v - b * u] for u, v, w in others or units]
    return []


def combination(growth):
    """Coefficients c with Σ c_f g_kf > 0 for all rows g_k, as far as doubles can tell; None if there are none.

    A feasible system Σ c_f g_kf ≥ 1 has a solution in which as many rows are 1 as coefficients are not 0: these are tried.
    """
    rows = []
    for row in growth:
        size = max((abs(float(x.mid())) for x in row), default=0.0) or 1.0
        rows.append([(float(x.mid()) / size, float(x.rad()) / size) for x in row])
    n = len(rows[0])
    for p in range(1, min(n, len(rows), 3) + 1):
        for columns, equal in product(combinations(range(n), p), combinations(rows, p)):
            solution = solve([[row[f][0] for f in columns] for row in equal])
            if solution and all(
                sum(c * row[f][0] - abs(c) * row[f][1] for f, c in zip(columns, solution, strict=True)) > 0
                for row in rows
            ):
                c = dict(zip(columns, solution, strict=True))
                return [c.get(f, 0.0) for f in range(n)]
    return None


def solve(matrix):
    """The solution of up to three equations whose right sides are 1, by Cramer's rule; None if there is not just one."""
    whole = determinant(matrix)
    if not whole:
        return None
    return [determinant([[*row[:f], 1.0, *row[f + 1 :]] for row in matrix]) / whole for f in range(len(matrix))]


def prove(domain, ranges, claims):
    """Proves claims, pairs of a kind and a class, of a box; returns the number of pieces it was cut into."""
    pieces, stack = 0, [(Piece(ranges, {}), claims)]
    while stack:
        piece, claims = stack.pop()
        pieces += 1
        region = Region(domain, piece)
        left = [claim for claim in claims if not holds(region, *claim)]
        if left:
            if pieces + len(stack) >= PIECES:
                kind, number = left[0]
                raise Wrong(f"{kind} of class {number} is not proved")
            # Where ranges of h_j are cut, a piece may hold no configuration at all: of S_{s,σ} only uncut ones can tell.
            with_heights = all(kind == SUMMITLESS for kind, _ in left)
            stack.extend((half, left) for half in region.halves(with_heights))
    return pieces


def holds(region, kind, number):
    """Whether a claim is proved of a region; if its contrary is, the claim is wrong."""
    mode, sign = number // 2, 1 - number % 2 * 2
    if kind == SUMMITLESS:
        return region.summitless(mode, sign)
    side = region.side(mode, sign)
    if side == (-1 if kind == INSIDE else 1):
        raise Wrong(f"{kind} of class {number} is false")
    return side != 0
