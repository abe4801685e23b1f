"""Polynomials as {exponents: coefficient}, as much of them as the leg equations need."""


class Polynomial(dict):
    def __add__(self, other):
        total = Polynomial(self)
        for exponents, coefficient in other.items():
            total[exponents] = total.get(exponents, 0.0) + coefficient
        return total

    def __sub__(self, other):
        return self + other * -1.0

    def __neg__(self):
        return self * -1.0

    def __mul__(self, other):
        """Times a polynomial or a number."""
        if not isinstance(other, Polynomial):
            return Polynomial({exponents: coefficient * other for exponents, coefficient in self.items()})
        product = Polynomial()
        for a, x in self.items():
            for b, y in other.items():
                exponents = tuple(i + j for i, j in zip(a, b))
                product[exponents] = product.get(exponents, 0.0) + x * y
        return product

    __rmul__ = __mul__

    def written(self, names):
        """As PHCpack reads it. What is left where two rounded terms cancel is not a term."""
        least = 1e-15 * max(map(abs, self.values()))
        terms = []
        for exponents, coefficient in self.items():
            if abs(coefficient) > least:
                powers = [f"*{name}^{n}" for name, n in zip(names, exponents) if n]
                terms.append(f"{coefficient:+.17g}" + "".join(powers))
        return " ".join(terms) + ";"


def variables(count):
    """1 and the unknowns."""
    one = Polynomial({(0,) * count: 1.0})
    return one, [Polynomial({tuple(int(j == i) for j in range(count)): 1.0}) for i in range(count)]
