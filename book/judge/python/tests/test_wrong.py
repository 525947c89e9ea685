"""Wrong programs, as people write them, are told from right ones, and readably.

They are those of tests/verify/equations.rs."""

import math

import pendula
import pytest


def linear(force, theta, omega, h):
    omega -= h * force.g_over_l * theta
    return theta + h * omega, omega


def degrees_in(force, theta, omega, h):
    omega += h * force(math.radians(theta))
    return theta + h * omega, omega


def degrees_out(force, theta, omega, h):
    while True:
        omega += h * force(theta)
        theta += h * omega
        yield math.degrees(theta), math.degrees(omega)


def friction(force, theta, omega, h):
    omega += h * (force(theta) - 0.1 * omega)
    return theta + h * omega, omega


def fixed_g(force, theta, omega, h):
    omega -= h * 9.81 * math.sin(theta)
    return theta + h * omega, omega


def fixed_step(force, theta, omega, h):
    omega += 0.01 * force(theta)
    return theta + 0.01 * omega, omega


def upside_down(force, theta, omega, h):
    omega -= h * force(theta)
    return theta + h * omega, omega


def rod(force, theta, omega, h):
    omega += h * 1.5 * force(theta)
    return theta + h * omega, omega


def wrapped(force, theta, omega, h):
    while True:
        omega += h * force(theta)
        theta += h * omega
        yield math.atan2(math.sin(theta), math.cos(theta)), omega


def wrapped_state(force, theta, omega, h):
    omega += h * force(theta)
    return (theta + h * omega + math.pi) % math.tau - math.pi, omega


def drag_each_step(force, theta, omega, h):
    omega = 0.999 * (omega + h * force(theta))
    return theta + h * omega, omega


def divides(force, theta, omega, h):
    return theta + omega / h, omega + force(theta) / h


def step_squared(force, theta, omega, h):
    a = force(theta)
    return theta + h * omega + h * h / 2 * a, omega + h * h * a


def no_kick(force, theta, omega, h):
    a = force(theta)
    new = theta + h * omega + 0.5 * h * h * a
    return new, omega + 0*5 * (a + force(new)) * h  # fmt: skip


def row_late(force, theta, omega, h):
    while True:
        yield theta, omega
        omega += h * force(theta)
        theta += h * omega


def six_decimals(force, theta, omega, h):
    while True:
        omega += h / 2 * force(theta)
        theta += h * omega
        omega += h / 2 * force(theta)
        yield float(f"{theta:.6f}"), float(f"{omega:.6f}")


def backward_velocity(force, theta, omega, h):
    before = theta - h * omega + h * h / 2 * force(theta)
    while True:
        before, theta = theta, 2 * theta - before + h * h * force(theta)
        yield theta, (theta - before) / h


def rk4_first_order(force, theta, omega, h):
    k1 = h * force(theta)
    k2 = h * force(theta + k1 / 2)
    omega += (k1 + 2 * k2 + 2 * h * force(theta + k2 / 2) + h * force(theta + k2)) / 6
    return theta + h * omega, omega


def rk4_time_added(force, theta, omega, h):
    omega += h * (force(theta) + 4 * force(theta + h / 2) + force(theta + h)) / 6
    return theta + h * omega, omega


@pytest.mark.parametrize(
    ("method", "kind"),
    [
        (linear, "force"),
        (degrees_in, "sine-of-degrees"),
        (degrees_out, "degrees-out"),
        (friction, "damping"),
        (fixed_g, "fixed-gravity"),
        (fixed_step, "fixed-step"),
        (upside_down, "sign"),
        (rod, "gravity"),
        (wrapped, "wrapped"),
        (wrapped_state, "wrapped"),
        (drag_each_step, "drag-each-step"),
        (divides, "divided-by-step"),
        (step_squared, "squared-step"),
        (no_kick, "no-kick"),
        (row_late, "rows-late"),
        (six_decimals, "decimals"),
        (backward_velocity, None),
        (rk4_first_order, "units"),
        (rk4_time_added, "units"),
    ],
)
def test_a_wrong_program_is_told(method, kind):
    report = pendula.judge(method, "order=1")
    assert not report.holds
    assert (report.json["departure"] or {}).get("kind") == kind
    with pytest.raises(AssertionError) as told:
        report.check()
    lines = str(told.value).splitlines()
    # The verdict, what to look at, and each property that fails, in a line each.
    assert lines[0] == report.summary
    assert [f"look at: {line}" for line in report.look_at] == [
        line.strip() for line in lines[1 : 1 + len(report.look_at)]
    ]
    fails = [one.name for one in report.properties if one.verdict == "fails"]
    first_words = [line.split()[:2] for line in lines]
    assert fails and all([name, "fails:"] in first_words for name in fails)
