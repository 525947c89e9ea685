"""Rows of a run are told what made them, and what is wrong with them."""

import math

import pytest
from pendula import identify_run


def verlet(rows, h=0.05, theta=1.0, omega=0.0):
    for n in range(rows):
        yield h * n, theta, omega
        omega -= h / 2 * 9.8 * math.sin(theta)
        theta += h * omega
        omega -= h / 2 * 9.8 * math.sin(theta)


def test_a_run_is_told_its_method():
    """Catches: columns exchanged, digits lost on the way, a number of the report misnamed."""
    run = identify_run(*zip(*verlet(200)))
    assert (run.method, run.steps_per_row) == ("stormer-verlet", 1)
    assert math.isclose(run.step, 0.05)
    assert abs(run.k - 9.8) <= run.k_known_to < 1e-6
    assert run.faults == [] and "stormer-verlet" in str(run)


def test_faults_are_sentences():
    """Catches: faults that are dropped."""
    rows = list(verlet(100))
    del rows[40]
    assert identify_run(*zip(*rows)).faults == ["A row is missing after row 40."]


def test_what_is_no_run_is_refused():
    """Catches: an answer to nothing, columns of different lengths cut to the shortest."""
    with pytest.raises(ValueError, match="one row"):
        identify_run([0.0], [1.0])
    with pytest.raises(ValueError, match="not as many"):
        identify_run([0.0, 1.0], [1.0])
