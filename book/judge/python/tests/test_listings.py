"""What stands in the README, in the book and in the examples of the program."""

import subprocess
import sys

import pendula
import pytest
from listings import ROOT, listings, run

PAGES = ["README.md", "book/src/judging.md", "book/judge/python/README.md"]


@pytest.mark.parametrize("page", PAGES)
def test_a_page_begins_with_what_is_so(page):
    """Catches: a listing that does not run, or claims what does not hold."""
    names = run(page)
    assert names["report"].holds and names["report"].method == "stormer-verlet"


def test_a_page_says_what_is_found_in_a_changed_listing():
    """Catches: findings of the book that the judge does not make."""
    first = listings("book/src/judging.md")[0]
    changed = first.replace("h / 2", "0.50001 * h", 1).replace("report.check()", "")
    names = {}
    exec(changed, names)
    report = names["report"]
    assert [it.name for it in report.properties if it.verdict == "fails"] == [
        "equation",
        "order",
        "reversal",
        "loss",
    ]
    told = (ROOT / "book/src/judging.md").read_text(encoding="utf-8")
    words = " ".join(told.split())
    for line in report.look_at:
        assert line in words


def test_the_solver_of_a_page_holds():
    """Catches: as above."""
    pytest.importorskip("scipy")
    assert "pendula.judge_solver" in listings("README.md")[1]
    run("README.md", "scipy")


def test_the_example_of_the_command_holds():
    """Catches: an example that does not run."""
    example = subprocess.run(
        [pendula.program(), "verify", "--example", "python"], capture_output=True, check=True
    ).stdout
    told = subprocess.run(
        [sys.executable, "-"], input=example, capture_output=True, check=True
    ).stdout
    assert told.decode("utf-8").strip().endswith("Every claim holds.")


def test_the_solvers_of_scipy_are_judged():
    """Catches: as above. (Two of them take their time.)"""
    solve_ivp = pytest.importorskip("scipy.integrate").solve_ivp
    listing = listings("book/judge/python/README.md")[1]
    names = {"pendula": pendula}
    exec(listing.split("for name in")[0], names)
    assert names["solve_ivp"] is solve_ivp
    pendula.judge_solver(names["scipy"]("DOP853"), "order=8 estimate=8").check()
    pendula.judge_solver(names["scipy"]("LSODA"), "free-outputs").check()
