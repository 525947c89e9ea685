"""The known answers: right programs have their names, wrong ones those of their mistakes, and what
is neither has none."""

import math
import runpy
import struct
from pathlib import Path

import pytest
from listings import listings, run
from pendula import check_energy, check_right_hand_side, identify, known_answers
from pendula.formulas import evaluate
from pendula.formulas import system as system_of
from pendula.right_hand_sides import STATES

SINGLE = 2.0**-23
FILE = known_answers()


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def verlet(force, h=0.125, theta=1.0, omega=0.5):
    half = omega + h / 2 * force(theta)
    theta += h * half
    return theta, half + h / 2 * force(theta)


def rk4(force, h=0.125, theta=1.0, omega=0.5):
    a1 = force(theta)
    v2 = omega + h / 2 * a1
    a2 = force(theta + h / 2 * omega)
    v3 = omega + h / 2 * a2
    a3 = force(theta + h / 2 * v2)
    v4 = omega + h * a3
    a4 = force(theta + h * v3)
    return (
        theta + h / 6 * (omega + 2 * v2 + 2 * v3 + v4),
        omega + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4),
    )


def pull(theta):
    return -math.sin(theta)


def test_right_steps_have_their_names():
    """Catches: a tolerance that is too small, a step of other length, another scene's answers."""
    assert identify(*verlet(pull)).name == "stormer-verlet"
    assert identify(*rk4(pull)).name == "rk4"
    back = verlet(pull, -0.125, *verlet(pull, -0.125, -1.25, 0.75))
    assert identify(*back, h=-0.125, steps=2).name == "stormer-verlet"
    two = verlet(pull, 0.125, *verlet(pull))
    assert identify(*two, steps=2).name == "stormer-verlet"
    over = 2.75, 2.0
    for _ in range(8):
        over = verlet(lambda q: 2.25 * pull(q), 0.125, *over)
    assert identify(*over, scene="over-the-top", steps=8).name == "stormer-verlet"


@pytest.mark.parametrize("steps, scene", [(1, "swinging"), (2, "swinging"), (1, "driven")])
def test_every_entry_is_found(steps, scene):
    """Catches: an entry that is lost, or the name of another for what is not that."""
    known, alone = [*FILE["methods"], *FILE["mistakes"]], 0
    for entry in known:
        for answer in entry["answers"]:
            if (answer["scene"], answer["steps"]) == (scene, steps):
                numbers = float(answer["theta"]), float(answer["omega"])
                found = identify(*numbers, steps=steps, scene=scene)
                assert entry["name"] in [one.name for one in found.candidates]
                named = found.mistake.name if found.mistake else found.name
                assert named in (None, entry["name"])
                alone += named is not None
    assert alone > 80


@pytest.mark.parametrize(
    "force, what",
    [
        (lambda q: -q, "θ for sin θ"),
        (math.sin, "+(g/L) sin θ"),
        (lambda q: -9.81 * math.sin(q), "9.81 for a g/L of 1"),
        (lambda q: -1.5 * math.sin(q), "3/2 g/L for g/L"),
    ],
)
def test_wrong_equations_are_told(force, what):
    """On the linear equation all methods of order 4 with four stages are the same.

    Catches: a right name for a method on a wrong equation; the name of one method of several."""
    for step, method in ((verlet, "stormer-verlet"), (rk4, "rk4")):
        found = identify(*step(force))
        assert found.name is None and found.equation is not None
        assert all(entry.what.startswith(what) for entry in found.candidates)
        assert method in [entry.of for entry in found.candidates]
        alone = len(found.candidates) == 1
        assert alone == (found.mistake is not None) == (what != "θ for sin θ" or step is verlet)
        assert what in str(found)


@pytest.mark.parametrize(
    "force",
    [
        lambda q: -math.tan(q),
        lambda q: -0.7 * math.sin(q),
        lambda q: -1.000001 * math.sin(q),
        lambda q: -math.sin(q) - 1e-9,
    ],
)
def test_what_is_not_in_the_file_has_no_name(force):
    """Catches: the nearest name for what is another."""
    for step in (verlet, rk4):
        found = identify(*step(force))
        assert (found.name, found.mistake, found.candidates) == (None, None, ())
        assert found.distance > 1
        assert str(found).startswith("nothing agrees; the nearest is ")
    assert identify(math.nan, 0.4).name is None


def test_few_digits_have_no_false_name():
    """Catches: a name in single precision where others are as near."""
    numbers = [single(x) for x in rk4(pull)]
    assert identify(*numbers).name is None
    found = identify(*numbers, epsilon=SINGLE)
    assert found.name is None and len(found.candidates) > 1
    assert "rk4" in [entry.name for entry in found.candidates]


def test_what_cannot_be_asked_is_refused():
    with pytest.raises(ValueError, match=r"1 steps of 0\.125"):
        identify(1.0, 0.4, h=0.1)
    with pytest.raises(ValueError, match=r"'swimming'.*swinging"):
        identify(1.0, 0.4, scene="swimming")
    with pytest.raises(ValueError, match="double-pendulum"):
        check_right_hand_side("triple-pendulum", lambda z: 0.0)
    with pytest.raises(ValueError, match="usual, uneven"):
        check_right_hand_side("pendulum", lambda z: 0.0, parameters="even")
    with pytest.raises(ValueError, match="alpha1, alpha2, and not 4"):
        check_right_hand_side("double-pendulum", lambda z: [z.omega1, z.omega2, 0.0, 0.0])
    with pytest.raises(ValueError, match="of the pendulum"):
        check_energy("driven-pendulum", lambda z: 0.0)


@pytest.mark.parametrize("epsilon", [-1, 0, 2.0**-60, 0.5, 23, 53, math.inf, math.nan])
def test_what_is_no_precision_is_refused(epsilon):
    """Catches: the bits of a precision for its ε, or a number by accident, with which all that is
    wrong is right, and each name is as good as another."""
    for ask in (
        lambda: check_right_hand_side("pendulum", lambda z: -3 * z.g, epsilon=epsilon),
        lambda: check_energy("pendulum", lambda z: z.omega, epsilon=epsilon),
        lambda: identify(1.05, 0.39, epsilon=epsilon),
    ):
        with pytest.raises(ValueError, match=r"epsilon is .*: it must be .* 2\*\*-53 .* 0\.01"):
            ask()
    for allowed in (2.0**-53, 2.0**-7, 0.01):
        assert not check_right_hand_side("pendulum", lambda z: -3 * z.g, epsilon=allowed).holds


def accelerations(z, delta=None):
    sin, cos = math.sin, math.cos
    delta = z.theta1 - z.theta2 if delta is None else delta
    den = 2 * z.mass1 + z.mass2 - z.mass2 * cos(2 * delta)
    both = z.mass1 + z.mass2
    weight = z.g * (z.mass1 + both) * sin(z.theta1) + z.mass2 * z.g * sin(z.theta1 - 2 * z.theta2)
    turning = z.omega2**2 * z.length2 + z.omega1**2 * z.length1 * cos(delta)
    upper = both * (z.omega1**2 * z.length1 + z.g * cos(z.theta1))
    return (
        -(weight + 2 * z.mass2 * sin(delta) * turning) / (z.length1 * den),
        2
        * sin(delta)
        * (upper + z.omega2**2 * z.length2 * z.mass2 * cos(delta))
        / (z.length2 * den),
    )


def drive(z):
    return (
        -z.g / z.length * math.sin(z.theta)
        - 2 * z.beta * z.omega
        + z.amplitude * math.cos(z.frequency * z.t)
    )


def test_right_hand_sides():
    """Catches: parameters that are exchanged, a state that is not the file's, a drag or a drive
    where there is none, a tolerance without room for rounding."""
    for system in ("pendulum", "damped-pendulum", "driven-pendulum"):
        assert check_right_hand_side(system, drive).holds
    found = check_right_hand_side("double-pendulum", accelerations)
    found.check()
    assert found.holds and found.mistake is None and found.hidden == () and found.distance < 0.5


def test_a_mistake_has_its_name():
    wrong = check_right_hand_side(
        "double-pendulum", lambda z: accelerations(z, delta=z.theta2 - z.theta1)
    )
    assert not wrong.holds
    assert wrong.mistake is not None and wrong.mistake.name == "difference-turned-round"
    with pytest.raises(AssertionError, match="Δ = θ₂ − θ₁"):
        wrong.check()
    unknown = check_right_hand_side("double-pendulum", lambda z: accelerations(z._replace(g=9.8)))
    assert not unknown.holds and unknown.mistakes == ()
    assert "by no usual mistake" in str(unknown)
    assert not check_right_hand_side("pendulum", lambda z: math.nan).holds


@pytest.mark.parametrize("system", STATES)
@pytest.mark.parametrize("precision", [float, single])
def test_every_mistake_has_its_name(system, precision):
    """Catches: a mistake that is called right, or another."""
    known = system_of(system)
    epsilon = SINGLE if precision is single else 2.0**-52

    def program(lines):
        """What the formula says, in the order of the points."""
        left = [evaluate(lines, known.inputs(point), known.rates) for point in known.points]
        return lambda z: map(precision, left.pop(0))

    for form in known.forms.values():
        assert check_right_hand_side(system, program(form), epsilon=epsilon).holds
    for wrong in known.mistakes:
        found = check_right_hand_side(system, program(wrong.lines), epsilon=epsilon)
        assert not found.holds
        assert [term.name for term in found.mistakes] == [wrong.name]


def test_programs_with_their_own_parameters():
    """Where lengths and masses are 1 not all shows, and that is said.

    Catches: one name for mistakes that are the same there."""
    usual = check_right_hand_side(
        "double-pendulum",
        lambda z: accelerations(z._replace(length1=2.0, length2=2.0, g=19.62)),
        parameters="usual",
    )
    assert usual.holds and "lengths-exchanged" in usual.hidden and len(usual.hidden) > 10
    twice = check_right_hand_side(
        "pendulum", lambda z: 9.81 * math.sin(z.theta), parameters="usual"
    )
    assert twice.mistake is not None and twice.mistake.name == "wrong-sign"
    root = check_right_hand_side(
        "pendulum", lambda z: -(9.81**2) * math.sin(z.theta), parameters="usual"
    )
    assert [term.name for term in root.mistakes] == ["square-of-g-over-l"]


def test_the_example():
    """The one that the README of the package names: right, with a sign wrong in its denominators,
    and with what no one has done before.

    Catches: an example that does not run, or with which a wrong program passes."""
    root = Path(__file__).resolve().parents[4]
    path = root / "book/judge/known-answers/examples/test_double_pendulum.py"
    runpy.run_path(str(path))["test_accelerations"]()
    source = path.read_text(encoding="utf-8")
    assert "m2 - m2 * cos" in source
    for wrong, said in (
        ("m2 + m2 * cos", "double-pendulum: .* in both denominators"),
        ("m2 - 1.01 * m2 * cos", "by no usual mistake"),
    ):
        example = {}
        exec(source.replace("m2 - m2 * cos", wrong), example)
        with pytest.raises(AssertionError, match=said):
            example["test_accelerations"]()


def test_the_readme_says_what_is_found(capsys):
    """Catches: a sentence of the README that the package does not say."""
    page = "book/judge/python/README.md"
    run(page)
    said = capsys.readouterr().out
    told = [
        line[2:]
        for listing in listings(page)[2:]
        for line in listing.splitlines()
        if line.startswith("# ")
    ]
    assert len(told) == 2
    for words in told:
        assert words.removesuffix(" ...") in said


def test_energies():
    """Catches: a zero that is taken for a mistake; an energy that is not compared from rest."""

    def energy(z, zero=0.0, half=0.5):
        vx = z.length1 * z.omega1 * math.cos(z.theta1) + z.length2 * z.omega2 * math.cos(z.theta2)
        vy = z.length1 * z.omega1 * math.sin(z.theta1) + z.length2 * z.omega2 * math.sin(z.theta2)
        y1 = zero - z.length1 * math.cos(z.theta1)
        y2 = y1 - z.length2 * math.cos(z.theta2)
        motion = 0.5 * z.mass1 * (z.length1 * z.omega1) ** 2 + half * z.mass2 * (vx**2 + vy**2)
        return motion + z.g * (z.mass1 * y1 + z.mass2 * y2)

    assert check_energy("double-pendulum", energy).holds
    assert check_energy("double-pendulum", lambda z: energy(z, zero=2.5)).holds
    wrong = check_energy("double-pendulum", lambda z: energy(z, half=1.0)).mistake
    assert wrong is not None and wrong.name == "half-left-out-of-the-second"
    assert check_energy("double-pendulum", lambda z: energy(z, half=0.7)).mistakes == ()


@pytest.mark.parametrize("precision, zeros", [(float, [0, -7, 1e3, -1e6, 1e9]), (single, [0, 1e3])])
def test_where_the_zero_of_an_energy_is_does_not_matter(precision, zeros):
    """Each of two energies rounds by half an ε of itself, and the zero that was added to both is in
    both: by an ε of the larger. A right formula has at least so much.

    Catches: the rounding of a zero that is far away for a mistake; a mistake that it hides; a zero
    so far away that no digit is left, and everything is right."""

    def energy(zero, motion=0.5):
        def of(z):
            height = z.g * z.length * -math.cos(z.theta)
            found = z.mass * (motion * (z.length * z.omega) ** 2 + height)
            return precision(precision(found) + precision(zero))

        return of

    epsilon = SINGLE if precision is single else 2.0**-52
    for zero in zeros:
        check_energy("pendulum", energy(zero), epsilon=epsilon).check()
        wrong = check_energy("pendulum", energy(zero, motion=1.0), epsilon=epsilon)
        assert wrong.mistake is not None and wrong.mistake.name == "half-left-out", zero
    for far in (1e20, -1e30):
        with pytest.raises(ValueError, match="its zero must be nearer"):
            check_energy("pendulum", energy(far), epsilon=epsilon)
    assert not check_energy("pendulum", lambda z: math.inf).holds
