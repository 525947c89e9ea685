"""The forms of a function, and what happens where one fails."""

import inspect
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pendula
import pytest

LEAPFROG = "order=2 symplectic symmetric name=stormer-verlet"


def verlet(force, theta, omega, h):
    omega += h / 2 * force(theta)
    theta += h * omega
    return theta, omega + h / 2 * force(theta)


def timed(force, theta, omega, t, h):
    omega += h / 2 * force(theta, t)
    theta += h * omega
    return theta, omega + h / 2 * force(theta, t + h)


def generator(force, theta, omega, h):
    kick = h / 2 * force(theta)
    while True:
        omega += kick
        theta += h * omega
        kick = h / 2 * force(theta)
        omega += kick
        yield theta, omega


class Stepper:
    def __init__(self, force, theta, omega, h):
        self.force, self.theta, self.omega, self.h = force, theta, omega, h
        self.kick = h / 2 * force(theta)

    def step(self):
        self.omega += self.kick
        self.theta += self.h * self.omega
        self.kick = self.h / 2 * self.force(self.theta)
        self.omega += self.kick
        return self.theta, self.omega


def whole_run(force, theta, omega, h):
    thetas, omegas, kick = [], [], h / 2 * force(theta)
    for _ in range(force.steps):
        omega += kick
        theta += h * omega
        kick = h / 2 * force(theta)
        omega += kick
        thetas.append(theta)
        omegas.append(omega)
    return zip(thetas, omegas)


def rk4(rate, t, y, h):
    k1 = rate(t, y)
    k2 = rate(t + h / 2, y + h / 2 * k1)
    k3 = rate(t + h / 2, y + h / 2 * k2)
    k4 = rate(t + h, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


@pytest.mark.parametrize(
    ("method", "claims"),
    [
        (verlet, f"{LEAPFROG} evaluations=2"),
        (timed, f"{LEAPFROG} evaluations=2"),
        (generator, f"{LEAPFROG} evaluations=1"),
        (Stepper, f"{LEAPFROG} evaluations=1"),
        (whole_run, f"{LEAPFROG} evaluations=1"),
    ],
)
def test_each_form_is_the_method(method, claims):
    """Catches: a form that is taken for another; a state of one question in the next; a count that
    misses the force at the start, or is carried on; a time that is not that of the step."""
    report = pendula.judge(method, claims)
    report.check()
    assert report["stage-times"].verdict == ("holds" if method is timed else "not measured")


def test_a_method_of_first_order_has_states_or_arrays():
    """Catches: a time that is wrong in a drive; arithmetic of states that is another than that of
    arrays."""
    numpy = pytest.importorskip("numpy")
    claims = "order=4 name=rk4 evaluations=4"
    reports = [pendula.judge_rate(rk4, claims, state=it) for it in (pendula.State, numpy.array)]
    for report in reports:
        report.check()
        assert report["stage-times"].verdict == "holds"
    assert reports[0]["order"] == reports[1]["order"]


def test_a_report_has_what_the_command_has():
    """Catches: a report that says less, or something else, than the command."""
    report = pendula.judge(verlet, "order=3")
    assert (report.holds, report.verdict, report.method) == (False, "fails", "stormer-verlet")
    assert report["order"].verdict == "fails" and "2.00" in report["order"].measured
    assert str(report).startswith("property") and str(report).endswith("A claim fails: order.")
    assert "<svg" in report.html and "iframe" in report._repr_html_()
    with pytest.raises(KeyError, match="no-such; there are equation, output, order"):
        report["no-such"]
    with pytest.raises(ValueError, match="nothing is claimed"):
        pendula.judge(verlet).check()
    with pytest.raises(pendula.NotJudged, match="order=two"):
        pendula.judge(verlet, "order=two")


def test_claims_may_be_listed():
    """Catches: a list that is read as less than its words, or as other ones."""
    listed = pendula.judge(verlet, ["order=2", "symplectic", "evaluations=2"])
    assert listed.holds and listed.claims == "order=2 symplectic evaluations=2"
    with pytest.raises(pendula.NotJudged, match="order=two"):
        pendula.judge(verlet, ("order=two",))


def test_a_report_shows_itself_in_two_lines():
    """Catches: a page of text where an interpreter shows a value."""
    first, second = repr(pendula.judge(verlet, "order=3")).splitlines()
    assert first == "<Report: A claim fails: order."
    assert second.startswith(" Störmer–Verlet (stormer-verlet): eight steps agree to ")
    assert second.endswith("; print() shows all of it>")


# Ten seconds each: `.ci/python --wheel` takes them all.
SLOW = pytest.mark.slow


@pytest.mark.parametrize(
    ("form", "shape"),
    [
        pytest.param("steps", (), marks=SLOW),
        ("steps", (1, 1)),
        ("rows", (1,)),
        ("rates", ()),
        pytest.param("rates", (1, 1), marks=SLOW),
    ],
)
def test_numbers_may_be_alone_in_arrays(form, shape):
    """Catches: an array of one number that is no number, here or in the force."""
    numpy = pytest.importorskip("numpy")

    def boxed(force, theta, omega, h):
        theta, omega = (numpy.reshape(float_of(x), shape) for x in (theta, omega))
        omega = omega + h / 2 * force(theta)
        theta = theta + h * omega
        return theta, omega + h / 2 * force(theta)

    def float_of(x):
        return numpy.ravel(x).astype(float)[0]

    def walk(force, theta, omega, h):
        while True:
            theta, omega = boxed(force, theta, omega, h)
            yield theta, omega

    def midpoint(rate, t, y, h):
        y = numpy.reshape(y, (2, *shape))
        slope = numpy.reshape(rate(t, y), y.shape)
        return y + h * numpy.reshape(rate(t + h / 2, y + h / 2 * slope), y.shape)

    if form == "rates":
        pendula.judge_rate(midpoint, "order=2 evaluations=2", state=numpy.array).check()
    else:
        method = boxed if form == "steps" else walk
        pendula.judge(method, f"{LEAPFROG} evaluations=2").check()


def failing(force, theta, omega, h):
    return theta + h * omega, omgea  # noqa: F821


def nothing(force, theta, omega, h):
    force(theta)


def three(force, theta, omega, h):
    return theta, omega, 0.0


def short(force, theta, omega, h):
    yield theta, omega


@pytest.mark.parametrize(
    ("method", "because"),
    [
        (failing, "failing raised NameError: name 'omgea' is not defined\n"
                  "The question was: pendulum 9.81 1.0 0.0 0.01 200 200"),
        (nothing, "nothing returned None: not a pair of numbers"),
        (three, "not a pair of numbers"),
        (short, "short yielded 1 states of 200"),
    ],
)  # fmt: skip
def test_a_mistake_ends_it_with_its_own_traceback(method, because):
    """Catches: a mistake that becomes a verdict; one whose line is not told."""
    with pytest.raises(pendula.NotJudged, match=re.escape(because)) as told:
        pendula.judge(method, "order=2")
    if method is failing:
        cause = told.value.__cause__
        assert isinstance(cause, NameError)
        trace = cause.__traceback__
        while trace.tb_next:
            trace = trace.tb_next
        assert trace.tb_frame.f_code.co_name == "failing"


@pytest.mark.parametrize(
    ("ask", "because"),
    [
        (lambda: pendula.judge(None, "order=2"), "judge takes a function, and not NoneType"),
        (lambda: pendula.judge_rate("rk4"), "judge_rate takes a function, and not str"),
        (lambda: pendula.judge_solver(2), "judge_solver takes a function, and not int"),
        (lambda: pendula.judge_solver(verlet, crossings=1), r"crossings\) takes a function"),
        (lambda: pendula.serve(2), "serve takes a function, and not int"),
        (lambda: pendula.serve(run=0), "serve takes a function, and not int"),
        (lambda: pendula.serve(), "there is nothing to serve"),
        (lambda: pendula.judge(verlet, {"order": 2}), "the claims are a text, .* and not {'order'"),
        (lambda: pendula.judge(verlet, ["order=2", 3]), "the claims are a text, .* and not \\["),
        (lambda: pendula.judge(verlet, None), "the claims are a text, .* and not None"),
        (lambda: pendula.judge(verlet, b"order=2"), "the claims are a text, .* and not b'order"),
    ],
)
def test_what_is_no_function_and_what_are_no_claims(ask, because):
    """Catches: a report on nothing; a sentence of Python's about paths or files."""
    with pytest.raises(TypeError, match=because):
        ask()


@pytest.mark.skipif(os.name == "nt", reason="Windows has other programs")
@pytest.mark.parametrize("program", ["true", "false", "cat", "ls", "yes", "no-such-program", "."])
def test_another_program_is_told(program, monkeypatch):
    """Catches: whatever another program says, or does not, taken for a report; a wait for it."""
    monkeypatch.setenv("PENDULA_PROGRAM", shutil.which(program) or program)
    with pytest.raises(RuntimeError, match=f"{program} is not the program pendula, which") as told:
        pendula.judge(verlet)
    assert not isinstance(told.value, pendula.NotJudged)


def test_the_help_names_commands_that_there_are():
    """This program is made without the book.

    Catches: a command in its help that it does not have."""
    told = subprocess.run([pendula.program(), "--help"], capture_output=True, encoding="utf-8")
    further = re.search("Further commands: (.*)", told.stdout).group(1).split(", ")
    assert "serve" in further
    for command in further:
        subprocess.run([pendula.program(), command, "--help"], capture_output=True, check=True)


def slow_ones(force, theta, omega, h):
    if force.g_over_l > 100:
        raise ValueError("too fast")
    return verlet(force, theta, omega, h)


def test_a_question_may_be_refused():
    """Catches: a refusal that ends it all, or is left out of the report or of the check."""
    report = pendula.judge(slow_ones, "order=2")
    assert (report.verdict, report["order"].verdict) == ("not measured", "holds")
    assert report["units"].why == "ValueError: too fast"
    question, refusal = report.refused[0]
    assert question.startswith("pendulum ") and isinstance(refusal, ValueError)
    with pytest.raises(AssertionError, match="units not measured: ValueError: too fast") as told:
        report.check()
    assert told.value.__cause__ is refusal


def explodes(force, theta, omega, h):
    return theta + h * omega**3, omega + h * theta**5


def test_numbers_that_overflow_are_told():
    """Catches: an overflow, which Python raises, that ends it as a mistake does."""
    report = pendula.judge(explodes, "order=1")
    assert not report.holds
    assert isinstance(report.refused[0][1], OverflowError)


def endless(force, theta, omega, h):
    while True:
        pass


def hang(force, theta, omega, h):
    try:
        while True:
            pass
    except:  # noqa: E722
        return theta, omega


def stubborn(force, theta, omega, h):
    yield from (hang(force, theta, omega, h) for _ in range(3))


def asleep(force, theta, omega, h):
    time.sleep(1000)


def back_asleep(force, theta, omega, h):
    if h < 0:
        time.sleep(1000)
    return verlet(force, theta, omega, h)


def fast_asleep(force, theta, omega, h):
    if force.g_over_l > 100:
        time.sleep(1000)
    return verlet(force, theta, omega, h)


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="nothing wakes what sleeps")
def test_what_sleeps_is_woken():
    """It would sleep for longer than any test takes.

    Catches: a sleep that is waited for; a late answer that costs more than its property; a signal
    whose handler stays."""
    before = signal.getsignal(signal.SIGURG)
    with pytest.raises(pendula.NotJudged, match="asleep gave no answer to"):
        pendula.judge(asleep, LEAPFROG, patience=2)
    report = pendula.judge(fast_asleep, LEAPFROG, patience=2)
    assert report.verdict == "not measured" and report["name"].verdict == "holds"
    late = [one.name for one in report.properties if one.claimed and one.verdict != "holds"]
    assert late == ["units"]
    assert re.fullmatch('no answer to "pendulum .*" within 2 s', report["units"].why)
    assert isinstance(report.refused[0][1], TimeoutError)
    with pytest.raises(AssertionError, match="units not measured: no answer to"):
        report.check()
    pendula.judge(back_asleep, "order=2 symplectic forward-only", patience=2).check()
    assert signal.getsignal(signal.SIGURG) == before


@pytest.mark.parametrize("method", [endless, stubborn])
@pytest.mark.parametrize("in_a_thread", [False, True])
def test_patience_ends(method, in_a_thread):
    """Catches: a function that hangs and keeps its caller; an exception that comes later, to what
    is not to blame."""
    told = []

    def ask():
        with pytest.raises(pendula.NotJudged, match=r'gave no answer to "pend.*" within 0\.5 s'):
            pendula.judge(method, patience=0.5)
        told.append(pendula.judge(verlet, LEAPFROG).holds)

    if in_a_thread:
        thread = threading.Thread(target=ask)
        thread.start()
        thread.join()
    else:
        ask()
    assert told == [True]


def test_threads_judge_side_by_side():
    """Catches: a state that judges share."""
    held = []
    methods = [(verlet, LEAPFROG), (generator, LEAPFROG), (Stepper, LEAPFROG)]
    threads = [
        threading.Thread(target=lambda it=it: held.append(pendula.judge(*it).holds))
        for it in methods
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert held == [True] * 3


@pytest.mark.skipif(os.name == "nt", reason="Windows has another control-C")
def test_control_c_ends_at_once(tmp_path):
    """Catches: an interrupt that waits for the judge, or is taken for a refusal."""
    script = tmp_path / "script.py"
    # A shell has what it runs in the background ignore the signal, and Python leaves that as it is.
    script.write_text(
        "import pendula, signal, time\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def slow(force, theta, omega, h):\n"
        "    print('ready', flush=True)\n"
        "    time.sleep(1000)\n"
        "pendula.judge(slow, patience=1000)\n"
    )
    process = subprocess.Popen(
        [sys.executable, str(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n"
    process.send_signal(signal.SIGINT)
    try:
        # It would sleep for longer, and wait for the judge.
        errors = process.communicate(timeout=600)[1]
    finally:
        process.kill()
    assert errors.endswith("KeyboardInterrupt\n") and process.returncode != 0


def noisy(force, theta, omega, h):
    print("a step")
    sys.stdout.flush()
    os.write(1, b"another\n")
    return verlet(force, theta, omega, h)


def test_what_it_prints_disturbs_nobody(tmp_path, capfd):
    """Catches: printed lines that are taken for answers, here and in a script that is served."""
    assert pendula.judge(noisy, LEAPFROG).holds
    assert "a step\nanother\n" in capfd.readouterr().out
    folder = tmp_path / "a blank and an ü"
    folder.mkdir()
    script = folder / "noisy.py"
    functions = "".join(inspect.getsource(one) + "\n" for one in (verlet, noisy))
    script.write_text(f"import os, sys, pendula\n{functions}pendula.serve(noisy)\n")
    told = subprocess.run(
        [pendula.program(), "verify", "--claims", LEAPFROG, "--", sys.executable, str(script)],
        capture_output=True, encoding="utf-8",
    )  # fmt: skip
    assert told.returncode == 0, told.stderr
    assert told.stdout.endswith("Every claim holds.\n")


def at_rest(rate, y0, times, tolerance):
    """No solver, but quick."""
    if not tolerance > 0:
        raise ValueError("no tolerance")
    return [y0] * (len(times) - 1)


def test_a_solver_is_asked_for_what_is_possible():
    """Catches: a solver that is asked for what hangs it, unless that is wanted; one that is not
    asked for it though it is."""
    report = pendula.judge_solver(at_rest, "order=1")
    assert report["refusal"].verdict == "not measured" and not report.refused
    report = pendula.judge_solver(at_rest, "order=1", impossible=True)
    assert report["refusal"].verdict == "unclaimed" and report.refused == []
    report = pendula.judge_solver(at_rest, "order=1 refuses")
    assert report["refusal"].verdict == "holds" and report.refused == []


def with_start(rate, y0, times, tolerance):
    return [(0.0, 0.0) for _ in times]


def test_a_solver_that_hands_out_the_start_is_told():
    """Catches: rows that are one early."""
    with pytest.raises(pendula.NotJudged, match=re.escape("times[0], is not asked for")):
        pendula.judge_solver(with_start)


def test_it_can_be_installed_anywhere():
    """Catches: a program that is looked for where it is not."""
    path = Path(pendula.program())
    assert path.is_file() and path.stem == "pendula"


def test_a_script_that_is_served_refuses_and_goes_on(tmp_path):
    """Catches: a script that ends at an exception, or at a line that it does not know."""
    script = tmp_path / "script.py"
    script.write_text(
        "import pendula\n"
        "def steps(rate, y, h, steps, every):\n"
        "    if h < 0:\n"
        "        raise NameError('no way back')\n"
        "    return [y] * (1 if h > 1 else steps // every)\n"
        "pendula.serve(run=steps, driven=False, name='some\\tsteps')\n"
    )
    asked = {
        "hello 1": ["hello 1 some steps"],
        "pendulum 9.81 1.0 0.0 -0.1 4 2": ["error NameError: no way back"],
        "pendulum 9.81 1.0 0.0 2.0 4 2": ["error some steps returned 1 states of 2"],
        "pendulum 9.81 1.0 0.0": ["error the question cannot be read"],
        "pendulum 9.81 1.0 0.0 0.1 4 3": ["error k does not divide n"],
        "pendulum 9.81 1.0 nan 0.1 4 4": ["error state 1 of 1 is not finite: [1.0, nan]"],
        "driven 9.81 0.5 2.0 1.0 0.0 0.1 4 2": ["unsupported"],
        "solve 9.81 2.0 0.0 0.0 1e-8 2.5 5.0": ["unsupported"],
        "pendulum 9.81 1.0 0.5 0.1 4 2": ["1.0 0.5", "1.0 0.5", "done"],
    }
    told = subprocess.run(
        [sys.executable, str(script)],
        input="\n".join([*asked, "bye", "hello 1"]) + "\n",
        capture_output=True,
        check=True,
        encoding="utf-8",
    ).stdout
    assert told.splitlines() == [line for answer in asked.values() for line in answer]
