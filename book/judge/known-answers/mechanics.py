"""The right-hand sides once more: from where the bobs are, by d'Alembert's principle.

No formula of an acceleration is used. For trial accelerations the bobs' own follow from their
positions as series in the time; Σ m (r̈ − g) · ∂r/∂θⱼ is what the other forces do on ∂θⱼ, and it is
linear in the trial. Momenta and their rates follow from the energy of the bobs, by differences.
"""

import flint
from flint import arb, arb_mat, arb_series

flint.ctx.prec = 256

# The difference quotients err by its square, and by rounding, 2⁻²⁵⁶, over it.
SMALL = arb(10) ** -25


def joints(inputs):
    """(length, mass) from above."""
    if "l" in inputs:
        return [(inputs["l"], inputs["m"])]
    return [(inputs["l1"], inputs["m1"]), (inputs["l2"], inputs["m2"])]


def bobs(inputs, angles):
    """(mass, x, y) of each bob, y upwards from the pivot; of numbers or of series."""
    x = y = arb(0)
    found = []
    for (length, mass), angle in zip(joints(inputs), angles):
        x, y = x + length * angle.sin(), y - length * angle.cos()
        found.append((mass, x, y))
    return found


def series(*coefficients):
    return arb_series(list(coefficients), 3)


def moving(inputs, angles, velocities, accelerations):
    """The bobs along the motion, as series in the time."""
    motion = zip(angles, velocities, accelerations)
    return bobs(inputs, [series(q, w, a / 2) for q, w, a in motion])


def shifts(inputs, angles):
    """For each angle, ∂x and ∂y of each bob."""
    found = []
    for j in range(len(angles)):
        shifted = [series(q, 1 if i == j else 0) for i, q in enumerate(angles)]
        found.append([(x[1], y[1]) for _, x, y in bobs(inputs, shifted)])
    return found


def solve(residual, size):
    """Where a function that is linear is zero."""
    unit = [[arb(int(i == j)) for i in range(size)] for j in range(size)]
    constant = residual([arb(0)] * size)
    columns = [[a - b for a, b in zip(residual(e), constant)] for e in unit]
    rows = [list(row) for row in zip(*columns)]
    found = arb_mat(rows).solve(arb_mat(size, 1, [-x for x in constant]))
    return [found[i, 0] for i in range(size)]


def accelerations(inputs, angles, velocities):
    """The accelerations of the angles."""
    drag, drive = inputs.get("beta", arb(0)), arb(0)
    if "t" in inputs:
        drive = inputs["amplitude"] * (inputs["frequency"] * inputs["t"]).cos()
    directions = shifts(inputs, angles)

    def residual(trial):
        along = moving(inputs, angles, velocities, trial)
        sums = []
        for direction in directions:
            work = arb(0)
            for (mass, x, y), (dx, dy) in zip(along, direction):
                # The drag of a bob is −2βm times its velocity.
                work += mass * (2 * x[2] + 2 * drag * x[1]) * dx
                work += mass * (2 * y[2] + 2 * drag * y[1] + inputs["g"]) * dy
                # The drive is an acceleration of the angle: a torque over the moment of inertia.
                work -= mass * drive * (dx**2 + dy**2)
            sums.append(work)
        return sums

    return solve(residual, len(angles))


def energy(inputs, angles, velocities):
    """The energy of the bobs, 0 where they hang at rest."""
    along = moving(inputs, angles, velocities, [arb(0)] * len(angles))
    resting = bobs(inputs, [arb(0)] * len(angles))
    parts = [
        mass * (x[1] ** 2 + y[1] ** 2) / 2 + mass * inputs["g"] * (y[0] - lowest)
        for (mass, x, y), (_, _, lowest) in zip(along, resting)
    ]
    return sum(parts, arb(0))


def velocities_of(inputs, angles, momenta):
    """The velocities that have these momenta, Σ m ṙ · ∂r/∂θⱼ."""
    directions = shifts(inputs, angles)

    def residual(trial):
        along = moving(inputs, angles, trial, [arb(0)] * len(angles))
        return [
            sum((m * (x[1] * dx + y[1] * dy) for (m, x, y), (dx, dy) in zip(along, d)), -p)
            for d, p in zip(directions, momenta)
        ]

    return solve(residual, len(angles))


def hamiltons(inputs, angles, momenta):
    """The velocities, and the rates of the momenta: −∂H/∂θⱼ."""

    def hamiltonian(q):
        return energy(inputs, q, velocities_of(inputs, q, momenta))

    rates = []
    for j in range(len(angles)):
        there, here = (
            hamiltonian([q + shift if i == j else q for i, q in enumerate(angles)])
            for shift in (SMALL, -SMALL)
        )
        rates.append((here - there) / (2 * SMALL))
    return velocities_of(inputs, angles, momenta) + rates


def right(system, inputs):
    """The rates of a system at a point, and its energy."""
    names = [[n for n in system.state if n.startswith(kind)] for kind in ("theta", "omega", "p")]
    angles, velocities, momenta = ([inputs[n] for n in those] for those in names)
    if momenta:
        rates = hamiltons(inputs, angles, momenta)
        velocities = rates[: len(angles)]
    else:
        rates = accelerations(inputs, angles, velocities)
    return rates, energy(inputs, angles, velocities)
