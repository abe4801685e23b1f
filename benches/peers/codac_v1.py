"""The set in Codac 1, whose functions and contractors are IBEX's.

x, y: the pose. ρ_j: squared distance to A_j. Cranks and rods are 8 and 5, so that H_j > 0 is
9 < ρ_j < 169.
D = ρ_1 ρ_2 det A in mode ++, from h_j = √H_j, r_1 = ρ_1 − 39, r_2 = ρ_2 + 39 and p = d_1 · d_2.
"""

from codac import (SIVIA, Ctc3BCid, CtcCompo, CtcFixPoint, CtcFwdBwd, CtcNotIn, CtcUnion, Function, Interval,
                   IntervalVector, Sep, SepCtcPair, SepFwdBwd, SepInter, SetValue, oo)
from peer import Program, serve

RHO = ["(x^2 + y^2)", "((x - 9)^2 + y^2)"]
H = [f"(6400 - ({rho} - 89)^2)" for rho in RHO]
H1, H2 = (f"sqrt({reach})" for reach in H)
R1, R2 = f"({RHO[0]} - 39)", f"({RHO[1]} + 39)"
# d_1 · d_2 = x (x − 9) + y², with x once.
P = "((x - 4.5)^2 + y^2 - 20.25)"
D = f"9*y*({R1}*{R2} + {H1}*{H2}) + {P}*({H1}*{R2} - {H2}*{R1})"
# The sine of the angle between the rods.
ANGLE = f"sin(atan2(9*y, {P}) + acos({R1}/(10*sqrt({RHO[0]}))) - acos({R2}/(16*sqrt({RHO[1]}))))"

RING, POSITIVE, NEGATIVE = Interval(9, 169), Interval(0, oo), Interval(-oo, 0)

# Codac 1 does not keep its operands alive.
kept = []


def keep(operand):
    kept.append(operand)
    return operand


def function(text):
    return keep(Function("x", "y", text))


def one_each(constraints):
    """One separator per constraint, intersected."""
    return SepInter([keep(SepFwdBwd(function(text), image)) for text, image in constraints])


def pair(wrap=lambda contractor: contractor):
    """Outer: one contractor after the other. Inner: the union over the negations."""
    rings = [(function(rho), RING) for rho in RHO]
    outer = [keep(CtcFwdBwd(f, image)) for f, image in [*rings, (function(D), POSITIVE)]]
    inner = [keep(CtcNotIn(f, image)) for f, image in rings] + [keep(CtcFwdBwd(function(D), NEGATIVE))]
    return SepCtcPair(keep(wrap(keep(CtcUnion(*inner)))), keep(wrap(keep(CtcCompo(outer)))))


class Counted(Sep):
    """A separator that counts its uses."""

    def __init__(self, separator):
        Sep.__init__(self, 2)
        self.separator, self.uses = separator, 0

    def separate(self, x_in, x_out):
        self.uses += 1
        self.separator.separate(x_in, x_out)
        return x_in, x_out


def pave(window, separator, eps):
    box = IntervalVector([list(side) for side in window])
    return SIVIA(box, separator, eps, display_result=False, return_result=True)


def areas(paving):
    parts = (SetValue.IN, SetValue.UNKNOWN)
    return tuple(sum(box.volume() for box in paving[part]) for part in parts)


def boxes(window, separator, eps, _):
    counted = Counted(separator)
    pave(window, counted, eps)
    return counted.uses


det_a = function(D)


def det(x, y):
    value = det_a.eval(IntervalVector([[x, x], [y, y]]))
    return None if value.is_empty() else (value.lb(), value.ub())


rings = [(rho, RING) for rho in RHO]
serve(Program(det, {
    "H_1, H_2, det A, one separator each": one_each([(reach, POSITIVE) for reach in H] + [(D, POSITIVE)]),
    "rings and the angle between the rods": one_each([*rings, (ANGLE, POSITIVE)]),
    "rings and det A": one_each([*rings, (D, POSITIVE)]),
    "rings and det A, paired contractors": pair(),
    "paired contractors, to the fixpoint": pair(lambda c: CtcFixPoint(c, 0.5)),
    "paired contractors, with 3BCID": pair(Ctc3BCid),
}, pave, areas, boxes))
