"""The formulas of right-hand sides and energies: right ones follow from where the bobs are, wrong
ones have the effects that are said of them."""

import cmath
import itertools
import math

import pytest
from pendula.formulas import evaluate
from pendula.formulas import system as system_of
from pendula.right_hand_sides import OF_A_MISTAKE, STATES, _points

SINGLE = 2.0**-23
COMPLEX = {"number": complex, "sin": cmath.sin, "cos": cmath.cos, "sqrt": cmath.sqrt, "pi": math.pi}
# Of derivatives by a complex step: its square is below every rounding.
STEP = 1e-30
# Some hundred roundings of numbers up to 100, of which the sums here are made; and what is not
# nothing.
NOTHING, SOMETHING = 1e-11, 1e-3
# What the effects say by "right only where …", as what makes it so in the set `uneven`, whose
# parameters all differ.
CONDITIONS = {
    "both lengths are 1": {"l1": 1, "l2": 1},
    "both masses are 1": {"m1": 1, "m2": 1},
    "g = 1": {"g": 1},
    "g = 9.81": {"g": 9.81},
    "g = l": {"g": 1.75},
    "g/l = 9.81": {"g": 19.62, "l": 2},
    "l = 1": {"l": 1},
    "l₁ = 1": {"l1": 1},
    "l₁ = l₂": {"l2": 1.5},
    "m = 1": {"m": 1},
    "m l = 1": {"m": 0.5, "l": 2},
    "m l² = 1": {"m": 0.25, "l": 2},
    "m₁ = m₂": {"m2": 1.25},
    "m₂ = 1": {"m2": 1},
    "Ω = 1": {"frequency": 1},
}
each_system = pytest.mark.parametrize("system", [system_of(name) for name in STATES], ids=STATES)


def energies(inputs, angles, velocities):
    """Those of motion and of height, from where the bobs are and how fast they move."""
    joints = [("l", "m")] if "l" in inputs else [("l1", "m1"), ("l2", "m2")]
    y = vx = vy = motion = height = 0
    for (length, mass), angle, velocity in zip(joints, angles, velocities):
        length, mass = inputs[length], inputs[mass]
        y -= length * cmath.cos(angle)
        vx += length * cmath.cos(angle) * velocity
        vy += length * cmath.sin(angle) * velocity
        motion += mass * (vx**2 + vy**2) / 2
        height += mass * inputs["g"] * y
    return motion, height


def momenta(inputs, angles, velocities):
    """∂L/∂ω: differences, which are exact because L is quadratic in ω."""
    found = []
    for j in range(len(angles)):
        above, below = (
            energies(inputs, angles, [w + sign * (i == j) for i, w in enumerate(velocities)])[0]
            for sign in (1, -1)
        )
        found.append((above - below) / 2)
    return found


def pulls(inputs, angles, velocities):
    """∂L/∂θ, and what drag and drive do."""
    found = []
    for j in range(len(angles)):
        aside = [q + 1j * STEP * (i == j) for i, q in enumerate(angles)]
        motion, height = energies(inputs, aside, velocities)
        found.append((motion - height).imag / STEP)
    return [pull + torque(inputs) for pull in found]


def torque(inputs):
    """That of drag and drive, of a single pendulum."""
    if "beta" not in inputs:
        return 0
    drive = inputs.get("amplitude", 0) * math.cos(inputs.get("frequency", 0) * inputs.get("t", 0))
    return inputs["m"] * inputs["l"] ** 2 * (drive - 2 * inputs["beta"] * inputs["omega"])


def motion(system, inputs, rates):
    """How fast each number of the state changes, but the time."""
    known = {**inputs, **dict(zip(system.rates, rates))}
    names = [name for name in system.state if name != "t"]
    # An angle by its velocity, this by the acceleration, a momentum by its own rate.
    rate_of = {"theta": "omega", "omega": "alpha"}
    found = {}
    for name in names:
        word = name.rstrip("12")
        found[name] = known[
            rate_of[word] + name[len(word) :] if word in rate_of else name + "_rate"
        ]
    return found


def amiss(system, point, rates):
    """By how much rates miss Lagrange's equations, d/dt ∂L/∂ω = ∂L/∂θ + Q; or, with momenta, the
    momenta that their velocities have, and ṗ."""
    inputs = system.inputs(point)
    moving = motion(system, inputs, rates)
    angles = [inputs[name] for name in system.state if name.startswith("theta")]
    velocities = [rate for name, rate in moving.items() if name.startswith("theta")]
    wanted = pulls(inputs, angles, velocities)
    there = [(inputs[name], rate) for name, rate in moving.items() if name.startswith("p")]
    if there:
        own = momenta(inputs, angles, velocities)
        differences = [p - x for (p, _), x in zip(there, own)]
        differences += [rate - x for (_, rate), x in zip(there, wanted)]
    else:
        later = [q + 1j * STEP * w for q, w in zip(angles, velocities)]
        faster = [
            w + 1j * STEP * a for w, a in zip(velocities, list(moving.values())[len(angles) :])
        ]
        changes = [p.imag / STEP for p in momenta(inputs, later, faster)]
        differences = [x - y for x, y in zip(changes, wanted)]
    return max(map(abs, differences))


@each_system
def test_right_hand_sides_are_lagranges(system):
    """No formula of an acceleration or of a rate is used here.

    Catches: a sign, a factor or a length in a form of the right formulas; a check that finds
    nothing: each wrong formula is found."""
    for form in system.forms.values():
        for point in system.points:
            rates = evaluate(form, system.inputs(point), system.rates)
            assert amiss(system, point, rates) < NOTHING
    for wrong in system.mistakes:
        rates = [
            evaluate(wrong.lines, system.inputs(point), system.rates) for point in system.points
        ]
        assert max(map(amiss, itertools.repeat(system), system.points, rates)) > SOMETHING, wrong


@each_system
def test_energies_are_those_of_the_bobs(system):
    """Catches: as above, in the energies and in what they are compared with."""
    for point in system.points:
        inputs = system.inputs(point)
        moving = motion(system, inputs, system.right(inputs))
        angles = [inputs[name] for name in system.state if name.startswith("theta")]
        velocities = [rate for name, rate in moving.items() if name.startswith("theta")]
        nothing = [0.0 for _ in angles]
        rest = energies(inputs, nothing, nothing)[1]
        bobs = sum(energies(inputs, angles, velocities)) - rest
        for form in system.energies.values():
            # Those of the damped and the driven pendulum are the pendulum's.
            assert abs(system.above_rest(form, inputs)[0] - bobs) < NOTHING
        assert system.depth(inputs) == pytest.approx(-rest.real, rel=1e-15)


def power(system, point, energy, rates):
    """How fast the energy that a formula says changes along rates."""
    moving = motion(system, system.inputs(point), rates)
    inputs = system.inputs(point, COMPLEX)
    for name, rate in moving.items():
        inputs[name] += 1j * STEP * rate
    return evaluate(energy, inputs, ["energy"], COMPLEX)[0].imag / STEP


def right_where(effect, difference):
    """Whether it is right where its effect says so, and nowhere else. `difference` is that from the
    right numbers, with such parameters."""
    _, only, said = effect.partition("right only where ")
    if only:
        assert difference(CONDITIONS[said.split(",")[0]]) < NOTHING
        assert difference({}) > SOMETHING


def largest_difference(system, parameters, right, wrong):
    """Of two functions of the inputs, at the points whose parameters all differ."""
    all_inputs = [
        {**system.inputs(point), **parameters}
        for point in system.points
        if point["set"] == "uneven"
    ]
    pairs = (pair for inputs in all_inputs for pair in zip(right(inputs), wrong(inputs)))
    return max(abs(a - b) for a, b in pairs)


@each_system
def test_effects_of_mistakes(system):
    """Catches: a mistake that keeps the energy and is said not to, that is right elsewhere than it
    says or not there; a right formula along which the energy changes otherwise than by the drag
    and the drive."""
    energy = next(iter(system.energies.values()))
    for point in system.points:
        inputs = system.inputs(point)
        lost = torque(inputs) * inputs.get("omega", 0)
        assert abs(power(system, point, energy, system.right(inputs)) - lost) < NOTHING
    for mistake in system.mistakes:

        def wrong(inputs, lines=mistake.lines):
            return evaluate(lines, inputs, system.rates)

        if "energy is not conserved" in mistake.effect:
            changes = [power(system, p, energy, wrong(system.inputs(p))) for p in system.points]
            assert max(map(abs, changes)) > SOMETHING, mistake
        right_where(
            mistake.effect,
            lambda parameters, wrong=wrong: largest_difference(
                system, parameters, system.right, wrong
            ),
        )


@each_system
def test_effects_of_mistakes_in_energies(system):
    """Catches: as above."""
    for mistake in system.energy_mistakes:
        changes = max(
            abs(power(system, point, mistake.lines, system.right(system.inputs(point))))
            for point in system.points
        )
        if "is not conserved" in mistake.effect:
            assert changes > SOMETHING, mistake
        elif mistake.effect.startswith("conserved"):
            assert changes < NOTHING, mistake

        def wrong(inputs, lines=mistake.lines):
            return system.above_rest(lines, inputs)

        right_where(
            mistake.effect,
            lambda parameters, wrong=wrong: largest_difference(
                system, parameters, system.energy, wrong
            ),
        )


@pytest.mark.parametrize("kind", ["mistakes", "energy_mistakes"])
@each_system
def test_no_two_are_alike(system, kind):
    """No two entries are nearer than ten tolerances of single precision, more than twice what a
    program may be from each: it has one name at most. (2000 are seen.)

    Catches: a mistake that is in twice, or that its states do not show."""
    points = _points(system.name, kind)
    entries = list(zip(*([point.right, *point.wrong] for point in points)))
    for a, b in itertools.combinations(entries, 2):
        far = 0.0
        for point, x, y in zip(points, a, b):
            size = max(point.least, *map(abs, [*point.right, *x, *y]))
            apart = max(abs(p - q) for p, q in zip(x, y))
            far = max(far, apart / (point.tolerance * SINGLE * size))
        assert far >= 10


@each_system
def test_programs_in_single_precision(system):
    """Catches: a state or a parameter that is not exact in single precision, so that its rounding
    is taken for a mistake; a tolerance too small for one of the right or the wrong formulas."""
    numpy = pytest.importorskip("numpy")
    library = {name: getattr(numpy, name) for name in ("sin", "cos", "sqrt")}
    library |= {"number": numpy.float32, "pi": numpy.float32(math.pi)}
    for point in system.points:
        for name, number in system.inputs(point).items():
            # 9.81, whose rounding is in the tolerance.
            assert (name, number) == ("g", 9.81) or number == numpy.float32(number)
    for kind, forms, names in (
        ("mistakes", system.forms, system.rates),
        ("energy_mistakes", system.energies, ["energy"]),
    ):
        for point, known in zip(system.points, _points(system.name, kind)):
            inputs = system.inputs(point, library)

            def off(lines, those, names=names, known=known, inputs=inputs):
                if names == ["energy"]:
                    found = system.above_rest(lines, inputs, library)
                else:
                    found = evaluate(lines, inputs, names, library)
                assert all(isinstance(x, numpy.float32) for x in found)
                apart = max(abs(float(x) - y) for x, y in zip(found, those))
                size = max(known.least, *map(abs, known.right), *map(abs, those))
                return apart / (known.tolerance * SINGLE * size)

            assert all(off(lines, known.right) <= 1 for lines in forms.values())
            for mistake, those in zip(getattr(system, kind), known.wrong):
                assert off(mistake.lines, those) <= OF_A_MISTAKE, mistake


@each_system
def test_tolerances_are_twice_what_rounding_does(system):
    """Two or more forms of each formula are computed 32 times with a random relative error, up to
    one ε, in each operation, each function and each parameter that is not short in binary. (The
    errors are of size 2⁻³⁰, and divided by it: their effect is linear, and the doubles' own
    rounding does not matter.) The largest error, twice, rounded up, at least 4, is the tolerance.
    Right rounding errs by half an ε: so a factor of four is in hand for other orders.

    Catches: a tolerance of another state, or one that was set by hand."""
    numpy = pytest.importorskip("numpy")
    unit, trials = 2.0**-30, 32
    random = numpy.random.Generator(numpy.random.PCG64(1)).uniform(-1, 1, (4099, trials))
    pool = 1 + unit * random
    errors = iter(pool)

    class Rough(numpy.ndarray):
        """Doubles, several at once, of which every operation is wrong."""

        def __array_ufunc__(self, operation, method, *operands):
            result = getattr(operation, method)(*map(numpy.asarray, operands))
            if operation is not numpy.negative:
                result = result * next(errors)
            return result.view(Rough)

    def number(x):
        exact = numpy.full(trials, float(x)).view(Rough)
        return exact if x * 1024 == int(x * 1024) else exact * 1.0

    def library():
        functions = {name: getattr(numpy, name) for name in ("sin", "cos", "sqrt")}
        return {**functions, "number": number, "pi": number(math.pi)}

    def measured(found, right, size):
        misses = (abs(numpy.asarray(x) - y).max() for x, y in zip(found, right))
        return max(misses) / unit / size

    for point in system.points:
        # Each state has the same errors, so that it does not matter which others there are.
        errors = itertools.islice(itertools.cycle(pool), 1, None)
        plain, rough = system.inputs(point), system.inputs(point, {"number": number})
        right, energy = system.right(plain), system.energy(plain)
        worst = max(
            measured(evaluate(lines, rough, system.rates, library()), right, max(map(abs, right)))
            for lines in system.forms.values()
        )
        assert point["tolerance"] == math.ceil(max(4, 2 * worst))
        height = max(abs(energy[0]), system.depth(plain))
        worst = max(
            measured(system.above_rest(lines, system.inputs(point, names), names), energy, height)
            for lines in system.energies.values()
            for names in [library()]
        )
        assert point["energy_tolerance"] == math.ceil(max(4, 2 * worst))
