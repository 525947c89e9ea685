"""The answers once more: by Arb's balls in place of mpmath, every table in Nyström's form.

Implicit steps are solved by Newton's method.
"""

import flint
from flint import arb, arb_mat, arb_series

from tables import Reader, alternation, function, lines

flint.ctx.prec = 256
FUNCTIONS = {
    "number": arb,
    "sqrt": lambda x: arb(x).sqrt(),
    "cos": lambda x: arb(x).cos(),
    "pi": arb.pi(),
}
# What the library computes as well, beside the file; and what is carried from step to step.
OF_LIBRARY = ("discrete-gradient", "deuflhard", "processed")
LEFT_OUT = ("mistake", "reuse_first", "wrap", "euler_before")


class Forces:
    """The force and its derivative by the angle."""

    def __init__(self, scene, table):
        self.g, self.a, self.w = (arb(scene[key]) for key in ("g_over_l", "amplitude", "frequency"))
        self.drive = arb.sin if table.get("drive") == "sine" else arb.cos
        # Of numbers and of series.
        names = {name: lambda x, name=name: getattr(x, name)() for name in ("sin", "cos", "sqrt")}
        names |= {"g": self.g, "number": arb}
        names["radians"] = lambda q: q * arb.pi() / 180
        self.undriven = function(table.get("force", "-g * sin(q)"), names)

    def value(self, t, q):
        return self.undriven(q) + self.a * self.drive(self.w * t)

    def slope(self, q):
        return self.undriven(arb_series([q, 1], 2))[1]


def root(function, guess):
    """A zero by the secant method."""
    a, b = guess, guess + arb(2) ** -40
    for _ in range(12):
        fa, fb = function(a), function(b)
        if (fa - fb).mid() == 0:
            break
        a, b = b, (b - fb * (b - a) / (fb - fa).mid()).mid()
    return b


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), arb(0))


def product(a, b):
    return [[dot(row, column) for column in zip(*b)] for row in a]


class Nystrom:
    """θᵢ = θ + h rᵢ ω + h² Σ aᵢⱼ fⱼ, θ' = θ + h r ω + h² Σ b̄ f, ω' = ω + h Σ b f; times cᵢ."""

    def __init__(self, table):
        reader = Reader(table, FUNCTIONS)
        self.gradients = None
        if table["kind"] == "splitting":
            self.from_splitting(alternation(table, reader))
            if "times" in table:
                self.c = reader.row(table["times"])
            return
        if "collocation" in table:
            self.c, a = gauss(table["collocation"])
            self.b = a.pop()
        else:
            self.c, a = reader.rows(table["a"])
            self.b = reader.row(table["b"])
        if "times" in table:
            self.c = reader.row(table["times"])
        if table["kind"] == "rkn":
            self.r, self.a, self.whole = self.c, a, arb(1)
            self.b_angle = reader.row(table["b_theta"])
            return
        angle = reader.rows(table["a_theta"])[1] if "a_theta" in table else a
        weights = reader.row(table["b_theta"]) if "b_theta" in table else self.b
        self.r, self.whole = [sum(row, arb(0)) for row in angle], sum(weights, arb(0))
        self.a, self.b_angle = product(angle, a), product([weights], a)[0]

    def from_splitting(self, ops):
        elapsed, at, self.b, gradients = arb(0), [], [], []
        for what, length, gradient in ops:
            if what == "drift":
                elapsed += length
            elif length != 0:
                at.append(elapsed)
                self.b.append(length)
                gradients.append(gradient)
        self.c = self.r = at
        self.whole = elapsed
        self.a = []
        for i, x in enumerate(at):
            before = [k * (x - y) for k, y in zip(self.b[:i], at)]
            self.a.append(before + [arb(0)] * (len(at) - i))
        self.b_angle = [k * (elapsed - y) for k, y in zip(self.b, at)]
        if any(x is not None and x != 0 for x in gradients):
            self.gradients = gradients

    def step(self, forces, t, q, p, h):
        size = len(self.c)
        explicit = all(x == 0 for i, row in enumerate(self.a) for x in row[i:])
        start = [q + h * r * p for r in self.r]
        f = []
        if explicit:
            for i in range(size):
                stage = start[i] + h**2 * dot(self.a[i], f)
                f.append(self.force(forces, i, t, h, stage))
        else:
            stages = start
            for _ in range(9):
                f = [self.force(forces, i, t, h, x) for i, x in enumerate(stages)]
                rest = [x - s - h**2 * dot(row, f) for x, s, row in zip(stages, start, self.a)]
                slopes = [h**2 * forces.slope(x) for x in stages]
                jacobian = [[-a * slope for a, slope in zip(row, slopes)] for row in self.a]
                for i in range(size):
                    jacobian[i][i] += 1
                change = arb_mat(jacobian).solve(arb_mat(size, 1, rest))
                stages = [(x - change[i, 0]).mid() for i, x in enumerate(stages)]
            f = [self.force(forces, i, t, h, x) for i, x in enumerate(stages)]
        angle = q + h * self.whole * p + h**2 * dot(self.b_angle, f)
        return angle, p + h * dot(self.b, f)

    def force(self, forces, i, t, h, q):
        f = forces.value(t + self.c[i] * h, q)
        return f + self.gradients[i] * h**2 * f * forces.slope(q) if self.gradients else f


def gauss(size):
    """Nodes, and a with the weights as its last row, by integrating Lagrange's polynomials."""
    nodes = [(1 + arb.legendre_p_root(size, i)) / 2 for i in reversed(range(size))]
    rows = [[] for _ in range(size + 1)]
    for j, node in enumerate(nodes):
        polynomial, scale = flint.arb_poly([1]), arb(1)
        for i, other in enumerate(nodes):
            if i != j:
                polynomial, scale = polynomial * flint.arb_poly([-other, 1]), scale * (node - other)
        integral = polynomial.integral()
        for row, end in zip(rows, [*nodes, arb(1)]):
            row.append(integral(end) / scale)
    return nodes, rows


def gonzalez(forces, q, p, h):
    """Without the correction: a step that keeps the energy, with |Δz|² = h (Δθ ω̄ + Δω f).

    That is what is left of the two lines of the step, the first times Δθ and the second times Δω.
    """
    a, b = q + h * p, p + h * forces.value(0, q)
    for _ in range(12):
        dq, dp, middle = a - q, b - p, (q + a) / 2
        force = forces.value(0, middle)
        gained = (b**2 - p**2) / 2 - forces.g * (a.cos() - q.cos())
        way = dq**2 + dp**2 - h * (dq * (p + b) / 2 + dp * force)
        by_angle = 2 * dq - h * ((p + b) / 2 + dp * forces.slope(middle) / 2)
        by_velocity = 2 * dp - h * (dq / 2 + force)
        jacobian = arb_mat([[-forces.value(0, a), b], [by_angle, by_velocity]])
        change = jacobian.solve(arb_mat(2, 1, [gained, way]))
        a, b = (a - change[0, 0]).mid(), (b - change[1, 0]).mid()
    return a, b


def series(forces, t, q, p, h, order):
    """Taylor's series of this order, by Picard's iteration."""
    flint.ctx.cap = order + 1
    x = arb_series([0, 1])
    theta, omega = arb_series([q]), arb_series([p])
    for _ in range(order + 1):
        force = -forces.g * theta.sin() + forces.a * (forces.w * (t + x)).cos()
        omega = force.integral() + p
        theta = omega.integral() + q
    return tuple(sum((z[k] * h**k for k in range(order + 1)), arb(0)) for z in (theta, omega))


def moved(bases, weights, past, h):
    """The bases and h times the weighted slopes of older states, (θ, ω, force)."""
    return [base + h * dot(weights, [x[k] for x in past]) for k, base in enumerate(bases, 1)]


def multistep(table, forces, t, q, p, h, steps):
    reader = Reader(table, FUNCTIONS)
    values = reader.row(table.get("values", "1"))
    explicit, implicit = (reader.row(table.get(key, "")) for key in ("explicit", "implicit"))
    past, states = [(q, p, forces.value(t, q))], []
    for i in range(table["before"]):
        a, b = series(forces, t - i * h, past[-1][0], past[-1][1], -h, 70)
        past.append((a, b, forces.value(t - (i + 1) * h, a)))
    for step in range(steps):
        now = t + (step + 1) * h
        bases = [dot(values, [x[k] for x in past]) for k in (0, 1)]
        if explicit:
            q, p = moved(bases, explicit, past, h)
        if implicit:
            a, b = moved(bases, implicit[1:], past, h)
            beta = h * implicit[0]
            if explicit:
                q, p = a + beta * p, b + beta * forces.value(now, q)
            else:
                q = root(lambda x: x - a - beta * (b + beta * forces.value(now, x)), q + h * p)
                p = b + beta * forces.value(now, q)
        past.insert(0, (q, p, forces.value(now, q)))
        states.append((q, p))
    return states


def run(table, scene, steps):
    """The states after each step, or nothing where this file does not know the method."""
    if table["kind"] in OF_LIBRARY or any(key in table for key in LEFT_OUT):
        return None
    forces = Forces(scene, table)
    t, q, p, h = (arb(scene[key]) for key in ("t", "theta", "omega", "h"))
    states = []
    if table["kind"] == "multistep":
        return multistep(table, forces, t, q, p, h, steps)
    tableau = None if table["kind"] in ("taylor", "formula", "gonzalez") else Nystrom(table)
    for i in range(steps):
        now = t if table.get("time") == "never" else t + i * h
        if tableau:
            q, p = tableau.step(forces, now, q, p, h)
        elif table["kind"] == "gonzalez":
            q, p = gonzalez(forces, q, p, h)
        elif table["kind"] == "formula":
            q, p = lines(table["formula"], FUNCTIONS, q, p, h, lambda q: forces.value(now, q))
        else:
            q, p = series(forces, now, q, p, h, table["order"])
        states.append((q, p))
    return states
