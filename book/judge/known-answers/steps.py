"""The steps, each written as its source writes it: stages, kicks and drifts, series."""

import functools

import mpmath

from arithmetic import DIGITS, Digits, dot, mpf
from tables import Reader, alternation, function, lines


class Pendulum:
    """θ̈ = −(g/L) sin θ + A cos Ωt, but for what a table has in place of the first term, or says of
    the second."""

    def __init__(self, n, scene, table=None):
        self.n, table = n, table or {}
        self.g = n.number(scene["g_over_l"])
        self.a = n.number(scene["amplitude"]) if scene["amplitude"] else None
        self.w = n.number(scene["frequency"])
        self.drive = n.sin if table.get("drive") == "sine" else n.cos
        self.undriven = lambda q: -(self.g * n.sin(q))
        if "force" in table:
            names = {"g": self.g, "sin": n.sin, "cos": n.cos, "sqrt": n.sqrt, "number": n.constant}
            names["radians"] = lambda q: q * n.constant(mpmath.pi / 180)
            self.undriven = function(table["force"], names)
        self.linear_frequency = n.sqrt(self.g)

    def force(self, t, q):
        if self.a is None:
            return self.undriven(q)
        return self.undriven(q) + self.a * self.drive(self.w * t)


EXPLICIT = ("splitting", "taylor", "deuflhard", "processed", "formula")


class Method:
    """A table, its coefficients read once for each kind of number."""

    def __init__(self, table):
        self.table = table
        self.kind = table["kind"]
        self.reader = Reader(table)
        self.step = STEPS[self.kind]
        self.explicit = self.kind in EXPLICIT or (
            self.kind in ("rk", "rkn") and is_explicit(self.tableau()[1])
        )
        self.explicit = self.explicit and not table.get("implicit")

    def tableau(self, which="a"):
        if "collocation" in self.table:
            return collocation(self.table["collocation"])[:2]
        return self.reader.rows(self.table[which])

    def row(self, which):
        if which == "b" and "collocation" in self.table:
            return collocation(self.table["collocation"])[2]
        return self.reader.row(self.table[which])

    def run(self, n, scene, steps):
        """The states after each of so many steps, and what the last one leaves: its slopes."""
        t, q, p, h = (n.number(scene[key]) for key in ("t", "theta", "omega", "h"))
        pendulum = Pendulum(n, scene, self.table)
        before = [(n.constant(a), n.constant(b)) for a, b in scene.get("before", [])]
        memory = {"c": Coefficients(self, n), "before": before}
        states = []
        for i in range(steps):
            now = t + h * n.number(i)
            if self.table.get("time") == "never":
                now = t
            q, p = self.step(n, pendulum, memory, now, q, p, h)
            if self.table.get("wrap") and n.plain(q) > 3.141592653589793:
                q = q - n.number(2) * n.constant(mpmath.pi)
            states.append((q, p))
        return states, memory


@functools.lru_cache(None)
@mpmath.workdps(DIGITS + 20)
def collocation(size):
    """Gauss's method: nodes, a, weights, by the zeros of Legendre's polynomial and moments."""
    nodes = []
    for i in reversed(range(size)):
        guess = mpmath.cos(mpmath.pi * (4 * i + 3) / (4 * size + 2))
        zero = mpmath.findroot(lambda x: mpmath.legendre(size, x), (guess, guess + mpf(1) / 1000))
        nodes.append((1 + zero) / 2)
    powers = mpmath.matrix([[c**k for c in nodes] for k in range(size)])

    def weights(end):
        moments = mpmath.matrix([end ** (k + 1) / (k + 1) for k in range(size)])
        return list(mpmath.lu_solve(powers, moments))

    return nodes, [weights(c) for c in nodes], weights(mpf(1))


class Coefficients:
    """The coefficients of a method as numbers of one kind; 0 is None: its terms are left out."""

    def __init__(self, method, n):
        table, self.table = method.table, method.table

        def row(xs):
            return [n.constant(x) if x != 0 else None for x in xs]

        if "a" in table or "collocation" in table:
            nodes, a = method.tableau()
            self.a, self.explicit = [row(xs) for xs in a], method.explicit
            self.c = [n.constant(x) for x in (method.row("times") if "times" in table else nodes)]
            self.a_theta = (
                [row(xs) for xs in method.tableau("a_theta")[1]] if "a_theta" in table else self.a
            )
            for name in ("b", "b_embedded", "b_theta", "interpolant"):
                if name in table or (name == "b" and "collocation" in table):
                    setattr(self, name, row(method.row(name)))
            self.b_theta = getattr(self, "b_theta", getattr(self, "b", None))
        lists = ("explicit", "implicit", "values")
        self.lists = {key: row(method.row(key)) for key in lists if table.get(key)}
        if "lengths" in table or "substeps" in table:
            self.ops, elapsed, at = [], 0, []
            for what, length, gradient in alternation(table, method.reader):
                if what == "drift":
                    elapsed = elapsed + length
                if length != 0:
                    by = n.constant(gradient) if gradient else None
                    self.ops.append((what == "kick", n.constant(length), by))
                    at.append(n.constant(elapsed) if elapsed != 0 else n.number(0))
            kicks = [i for i, op in enumerate(self.ops) if op[0]]
            if "times" in table:
                for i, time in zip(kicks, method.row("times"), strict=True):
                    at[i] = n.constant(time)
            self.at = at
        parameters = table.get("parameters", {})
        self.x = {k: n.constant(method.reader.expression(v)) for k, v in parameters.items()}


def is_explicit(a):
    return all(x == 0 for i, row in enumerate(a) for x in row[i:])


def solve(n, first, improve, sweeps=None):
    """Improves the stages until they are settled, or so many times as a mistake has it."""
    old = first
    for _ in range(sweeps or n.sweeps):
        new = improve(old)
        if n.settled(new, old):
            return new
        old = new
    if n is Digits and not sweeps:
        raise ArithmeticError("the stages are not solved")
    return new


def runge_kutta(n, system, memory, t, q, p, h):
    """Partitioned, if there is an `a_theta`: that is for the angles, `a` for the velocities."""
    c, size = memory["c"], len(memory["c"].c)
    if c.explicit:
        v, f = [], []
        for i in range(size):
            stage_q = q + dot(n, c.a_theta[i], v, h) if i else q
            v.append(p + dot(n, c.a[i], f, h) if i else p)
            f.append(system.force(t + c.c[i] * h, stage_q))
            if c.table.get("reuse_first") and i == 0 and "slope" in memory:
                v[0], f[0] = memory["slope"]
    else:

        def improve(f):
            v = [p + dot(n, row, f, h) for row in c.a]
            return [
                system.force(t + c.c[i] * h, q + dot(n, c.a_theta[i], v, h)) for i in range(size)
            ]

        f = solve(n, [system.force(t, q)] * size, improve, c.table.get("sweeps"))
        v = [p + dot(n, row, f, h) for row in c.a]
    memory["slopes"] = (v, f)
    memory["slope"] = v[-1], f[-1]
    return q + dot(n, c.b_theta, v, h), p + dot(n, c.b, f, h)


def combination(n, weights, memory, h):
    """h times the sum of the slopes of the last step with these weights."""
    v, f = memory["slopes"]
    return dot(n, weights, v, h), dot(n, weights, f, h)


def nystrom(n, system, memory, t, q, p, h):
    c, size = memory["c"], len(memory["c"].c)

    def stage(i, f):
        way = c.c[i] * h
        return system.force(t + way, q + way * p + dot(n, c.a[i][: len(f)], f, h) * h)

    if c.explicit:
        f = []
        for i in range(size):
            f.append(stage(i, f))
    else:

        def improve(f):
            return [stage(i, f) for i in range(size)]

        f = solve(n, [system.force(t, q)] * size, improve, c.table.get("sweeps"))
    return q + h * p + dot(n, c.b_theta, f, h) * h, p + dot(n, c.b, f, h)


def splitting(n, system, memory, t, q, p, h):
    c, mistake, kicked = memory["c"], memory["c"].table.get("mistake"), None
    q, p = memory.get("real", (q, p))
    for (is_kick, length, gradient), at in zip(c.ops, c.at):
        if is_kick:
            seen = p
            force = system.force(t + at * h, q)
            if mistake == "old force in the last kick" and kicked is not None:
                force = kicked
            if mistake == "first force handed on" and kicked is None:
                force = memory.setdefault("first", force)
            kicked = force
            if gradient is not None:
                # f + c h² f f'
                force = force * (n.number(1) - gradient * h * h * system.g * n.cos(q))
            p = p + length * h * force
        else:
            q = q + length * h * p
    if mistake == "velocity before the last kick":
        memory["real"] = q, p
        return q, seen
    return q, p


def taylor(n, system, memory, t, q, p, h, order=None):
    order = order or memory["c"].table["order"]
    theta, omega, s, c = [q], [p], [n.sin(q)], [n.cos(q)]
    if system.a is not None:
        wave = [system.a * n.cos(system.w * t), -(system.a * n.sin(system.w * t))]
        turn = n.number(1)
    for k in range(order):
        over = n.number(k + 1)
        slope = -(system.g * s[k])
        if system.a is not None:
            # The k-th derivative of cos x is cos, −sin, −cos, sin; over k!, times Ωᵏ.
            slope = slope + (wave[k % 2] if k % 4 < 2 else -wave[k % 2]) * turn
            turn = turn * system.w / over
        theta.append(omega[k] / over)
        omega.append(slope / over)
        rates = [theta[j] * n.number(j) for j in range(1, k + 2)]
        s.append(dot(n, rates, c[k::-1]) / over)
        c.append(-(dot(n, rates, s[k::-1]) / over))
    power, ways = n.number(1), [n.number(1)]
    for _ in range(order):
        power = power * h
        ways.append(power)
    return dot(n, ways[::-1], theta[::-1]), dot(n, ways[::-1], omega[::-1])


def discrete_gradient(n, system, memory, t, q, p, h):
    half = n.number(0.5)
    exact = memory["c"].table.get("exact_when_small")
    if exact:
        w = system.linear_frequency if exact in (True, "sine") else n.number(1)
        bend = n.sin if exact == "sine" else n.tan
        h = n.number(2) / w * bend(w * h * half)
    way = n.number(float(memory["c"].table.get("way", 1)))

    def improve(guess):
        (new,) = guess
        middle, side = (q + new) * half, (new - q) * half * way
        mean = system.force(t, middle)
        # At rest the first guess is the start itself.
        if n.plain(side):
            mean = mean * n.sin(side) / side
        return [q + h * (p + h * half * mean)]

    (new,) = solve(n, [q + h * p], improve, memory["c"].table.get("sweeps"))
    return new, (new - q) * n.number(2) / h - p


def gonzalez(n, system, memory, t, q, p, h):
    """The midpoint rule, its gradient of the energy corrected along the step in phase space."""
    half = n.number(0.5)

    def energy(q, p):
        return half * p * p - system.g * n.cos(q)

    def improve(guess):
        dq, dp = guess[0] - q, guess[1] - p
        middle, mean = (q + guess[0]) * half, (p + guess[1]) * half
        force = system.force(t, middle)
        missing = energy(*guess) - energy(q, p) - (mean * dp - force * dq)
        more = missing / (dq * dq + dp * dp)
        return [q + h * (mean + more * dp), p + h * (force - more * dq)]

    return tuple(solve(n, [q + h * p, p + h * system.force(t, q)], improve))


def deuflhard(n, system, memory, t, q, p, h):
    w, half = system.linear_frequency, n.number(0.5)
    rotation_first = memory["c"].table.get("rotation_first")
    one_bottom = memory["c"].table.get("one_bottom")

    def rest(q):
        turns = 0 if one_bottom else round(float(n.plain(q)) / TURN)
        return q - n.number(2 * turns) * n.constant(mpmath.pi) if turns else q

    def kick(t, q, p, length):
        return p + length * (system.force(t, q) + system.g * rest(q))

    def turned(q, p, h):
        # Kick, drift and kick, each from its nearest bottom: over the top, too, it is symmetric.
        length, drift = n.tan(w * h * half) / w, n.sin(w * h) / w
        p = p - length * (system.g * rest(q))
        q = q + drift * p
        return q, p - length * (system.g * rest(q))

    if rotation_first:
        q, p = turned(q, p, h * half)
        return turned(q, kick(t + h * half, q, p, h), h * half)
    q, p = turned(q, kick(t, q, p, h * half), h)
    return q, kick(t + h, q, p, h * half)


TURN = 6.283185307179586


def shifted(n, system, x, theta, omega, h):
    """What the processor adds to the kernel's angle, and the factor of the seen velocity."""
    g, h2, one = system.g, h * h, n.number(1)
    v1, v2 = g * n.sin(theta), g * n.cos(theta)
    shift, stretch = x["linear"] * h2 * v1, x["linear"] * h2 * v2
    if "mixed" in x:
        h4 = h2 * h2
        # V''' is −V', and V'''' is −V''.
        shift = shift + h4 * v1 * (x["mixed"] * v2 - x["cubic"] * n.number(3) * omega * omega)
        stretch = stretch + h4 * (
            x["mixed"] * (v2 * v2 - v1 * v1) - x["cubic"] * v2 * omega * omega
        )
    return shift, one + stretch


def processed(n, system, memory, t, q, p, h):
    x, first_term = memory["c"].x, memory["c"].table.get("first_term")
    kernel = memory.get("kernel")
    if kernel is None:

        def improve(guess):
            return [q - shifted(n, system, x, guess[0], p, h)[0]]

        (theta,) = improve([q]) if first_term else solve(n, [q], improve)
        at = q if first_term else theta
        kernel = theta, p * shifted(n, system, x, at, p, h)[1]
    theta, omega = memory["kernel"] = splitting(n, system, memory, t, *kernel, h)

    def slower(guess):
        return [omega / shifted(n, system, x, theta, guess[0], h)[1]]

    (seen,) = solve(n, [omega], slower)
    if first_term:
        shift, stretch = shifted(n, system, x, theta, omega, h)
        return theta + shift, omega * (n.number(2) - stretch)
    return theta + shifted(n, system, x, theta, seen, h)[0], seen


def multistep(n, system, memory, t, q, p, h):
    """Weighted sums of older states and slopes, newest first; the oldest are exact."""
    c = memory["c"]
    if "past" not in memory:
        # Angles, velocities and forces.
        memory["past"] = [(q, p, system.force(t, q))]
        if c.table.get("euler_before"):
            memory["before"] = [(q - h * p, p - h * memory["past"][0][2])]
        for i, (a, b) in enumerate(memory["before"], 1):
            memory["past"].append((a, b, system.force(t - h * n.number(i), a)))
    past = memory["past"]
    explicit, implicit = c.lists.get("explicit"), c.lists.get("implicit")
    values = c.lists.get("values", [n.number(1)])

    def sums(weights):
        return [dot(n, weights, [x[i] for x in past], h) for i in (1, 2)]

    old = [dot(n, values, [x[i] for x in past]) for i in (0, 1)]
    ahead = t + h
    if explicit:
        dq, dp = sums(explicit)
        new_q, new_p = old[0] + dq, old[1] + dp
    if implicit:
        dq, dp = sums(implicit[1:])

        def improve(guess):
            a, b = guess
            return [
                old[0] + dq + implicit[0] * h * b,
                old[1] + dp + implicit[0] * h * system.force(ahead, a),
            ]

        if explicit:
            new_q, new_p = improve((new_q, new_p))
        else:
            new_q, new_p = solve(n, [q + h * p, p], improve)
    past.insert(0, (new_q, new_p, system.force(ahead, new_q)))
    return new_q, new_p


def formula(n, system, memory, t, q, p, h):
    def force(q):
        return system.force(t, q)

    return lines(memory["c"].table["formula"], {"number": n.constant}, q, p, h, force)


STEPS = {
    "formula": formula,
    "rk": runge_kutta,
    "rkn": nystrom,
    "splitting": splitting,
    "taylor": taylor,
    "discrete-gradient": discrete_gradient,
    "gonzalez": gonzalez,
    "deuflhard": deuflhard,
    "processed": processed,
    "multistep": multistep,
}
