"""The set in Codac 2. The formulas are those of codac_v1.py."""

from codac import (AnalyticFunction, CtcFixpoint, CtcInverse, CtcInverseNotIn, CtcLazy, Interval,
                   IntervalVector, PavingInOut, SepCtcPair, SepInverse, Vector, VectorVar, acos, atan2, oo,
                   sin, sqr, sqrt)
from codac import pave as codac_pave
from peer import Program, serve

pose = VectorVar(2)
x, y = pose[0], pose[1]
RHO = [sqr(x) + sqr(y), sqr(x - 9) + sqr(y)]
H = [6400 - sqr(rho - 89) for rho in RHO]
H1, H2 = (sqrt(reach) for reach in H)
R1, R2 = RHO[0] - 39, RHO[1] + 39
# d_1 · d_2 = x (x − 9) + y², with x once.
P = sqr(x - 4.5) + sqr(y) - 20.25
D = 9 * y * (R1 * R2 + H1 * H2) + P * (H1 * R2 - H2 * R1)
# The sine of the angle between the rods.
ANGLE = sin(atan2(9 * y, P) + acos(R1 / (10 * sqrt(RHO[0]))) - acos(R2 / (16 * sqrt(RHO[1]))))

RING, POSITIVE = Interval(9, 169), Interval(0, oo)


def function(expression):
    return AnalyticFunction([pose], expression)


def one_each(constraints):
    """One separator per constraint, intersected."""
    first, second, third = (SepInverse(function(expression), image) for expression, image in constraints)
    return first & second & third


def pair(wrap=lambda contractor: contractor, wrap_det=lambda contractor: contractor):
    """Outer: one contractor after the other. Inner: the union over the negations. The natural extension of
    the rings is exact: no centred form for them."""
    rings = [function(rho) for rho in RHO]
    near, far = (CtcInverse(f, RING, False) for f in rings)
    not_near, not_far = (CtcInverseNotIn(f, RING, False) for f in rings)
    outer = near & far & wrap_det(CtcInverse(function(D), POSITIVE))
    inner = not_near | not_far | wrap_det(CtcInverseNotIn(function(D), POSITIVE))
    return SepCtcPair(wrap(inner), wrap(outer))


def pave(window, separator, eps):
    return codac_pave(IntervalVector([list(side) for side in window]), separator, eps)


def areas(paving):
    parts = (PavingInOut.inner, PavingInOut.bound)
    return tuple(sum(box.volume() for box in paving.boxes(part)) for part in parts)


def boxes(_window, _separator, _eps, paving):
    nodes = []
    paving.tree().visit(lambda node: nodes.append(None) or True)
    return len(nodes)


det_a = function(D)


def det(px, py):
    value = det_a.eval(Vector([px, py]))
    return None if value.is_empty() else (value.lb(), value.ub())


rings = [(rho, RING) for rho in RHO]
serve(Program(det, {
    "H_1, H_2, det A, one separator each": one_each([(reach, POSITIVE) for reach in H] + [(D, POSITIVE)]),
    "rings and the angle between the rods": one_each([*rings, (ANGLE, POSITIVE)]),
    "rings and det A": one_each([*rings, (D, POSITIVE)]),
    "rings and det A, paired contractors": pair(),
    "paired contractors, to the fixpoint": pair(lambda c: CtcFixpoint(c, 0.5)),
    "paired contractors, det A twice where it pays (CtcLazy)": pair(wrap_det=CtcLazy),
}, pave, areas, boxes))
