"""Enclosures of functions over boxes, in Arb's balls (docs/theory.md, section 1, "Centred form")."""

from flint import arb, ctx

ctx.prec = 64  # a little more than the doubles of the certificate, which are taken exactly


def interval(lo, hi):
    """A ball that holds all numbers between two doubles."""
    return arb(lo).union(arb(hi))


class Form:
    """A function f over a box: its value in the middle, its range, and the ranges of its derivatives.

    The variables t_k lie in the balls `box` about 0. f(t) is in `range`, and by the mean-value theorem in `at` + Σ `slopes`_k t_k.
    In all operations a ball stands for a constant.
    """

    __slots__ = ("at", "box", "range", "slopes")

    def __init__(self, at, range_, slopes, box):
        self.at, self.range, self.slopes, self.box = at, range_, slopes, box

    @classmethod
    def variable(cls, ball, k, box):
        """The k-th variable, which takes the values of a ball."""
        return cls(ball.mid(), ball, [arb(i == k) for i in range(len(box))], box)

    def widened(self, box):
        """The same function where there are more variables, on which it does not depend."""
        return Form(self.at, self.range, self.slopes + [arb(0)] * (len(box) - len(self.slopes)), box)

    def tight(self):
        """The same with the common part of range and centred form as its range."""
        centred = self.at
        for slope, t in zip(self.slopes, self.box, strict=True):
            centred += slope * t
        return Form(self.at, self.range.intersection(centred), self.slopes, self.box)

    def __neg__(self):
        return Form(-self.at, -self.range, [-a for a in self.slopes], self.box)

    def __add__(self, other):
        if isinstance(other, arb):
            return Form(self.at + other, self.range + other, self.slopes, self.box)
        slopes = [a + b for a, b in zip(self.slopes, other.slopes, strict=True)]
        return Form(self.at + other.at, self.range + other.range, slopes, self.box)

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        if isinstance(other, arb):
            return Form(self.at * other, self.range * other, [a * other for a in self.slopes], self.box)
        f, g = self.range, other.range
        slopes = [a * g + f * b for a, b in zip(self.slopes, other.slopes, strict=True)]
        return Form(self.at * other.at, f * g, slopes, self.box)

    __radd__, __rmul__ = __add__, __mul__

    def _composed(self, function, derivative):
        return Form(function(self.at), function(self.range), [a * derivative for a in self.slopes], self.box)

    def square(self):
        return self._composed(lambda x: x * x, self.range * 2)

    def sqrt(self):
        """Its root; of a function > 0."""
        return self._composed(arb.sqrt, 1 / (self.range.sqrt() * 2))

    def inverse(self):
        """1/f; of a function that is not 0."""
        return self._composed(lambda x: 1 / x, -1 / (self.range * self.range))

    def sin_cos(self):
        sin, cos = self.range.sin_cos()
        return self._composed(arb.sin, cos), self._composed(arb.cos, -sin)


def dot(a, b):
    """Σ a_k b_k."""
    first, *rest = (x * y for x, y in zip(a, b, strict=True))
    for term in rest:
        first = first + term
    return first


def determinant(rows):
    """The determinant of up to three rows."""
    if len(rows) == 1:
        return rows[0][0]

    def minor(i, k):
        (*_, p, q) = rows
        return p[i] * q[k] - p[k] * q[i]

    if len(rows) == 2:
        return minor(0, 1)
    return dot(rows[0], (minor(1, 2), minor(2, 0), minor(0, 1)))
