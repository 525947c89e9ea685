"""What programs that are no Rust crates take to come to an error: heyoka and Boost.odeint.

    python3 -m venv target/peers-python
    target/peers-python/bin/pip install heyoka==7.13.2
    target/peers-python/bin/python benches/peers/others.py

It needs cargo, for the exact ends of the motions, and g++ with Boost's headers (Debian:
libboost-dev).

The scenes, the errors and what counts as reaching one are those of `src/main.rs`, whose table has
the library: max(|dtheta|, |domega|/omega_0) at the end, and a setting counts if the next finer one
is within the error too, and no more than three times worse, or the one after it is within the error
as well. Times are the shortest CPU time of the process over seven runs or more, in microseconds.
heyoka compiles its step for this processor, and odeint is compiled with -march=native.
"""

import pathlib
import subprocess
import time

import heyoka
import numpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
GOALS = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
GRAVITY = 9.81
ANGLE, VELOCITY = heyoka.make_vars("x", "v")
EQUATIONS = [(ANGLE, VELOCITY), (VELOCITY, -GRAVITY * heyoka.sin(ANGLE))]


def printed(*words):
    """The lines that a command prints, as lists of words."""
    done = subprocess.run(words, cwd=ROOT, text=True, stdout=subprocess.PIPE, check=True)
    return [line.split() for line in done.stdout.splitlines()]


def exact_ends():
    """Of each scene and of each pendulum of the ensemble: start, duration, angle, velocity."""
    crate = ["--quiet", "--release", "--manifest-path", "benches/peers/Cargo.toml"]
    ends = {"scene": [], "ensemble": []}
    for kind, *numbers in printed("cargo", "run", *crate, "--", "ends"):
        ends[kind].append([float(x) for x in numbers])
    return ends["scene"], ends["ensemble"]


def setting_for(goal, tried):
    """The time of the coarsest setting that is within the goal, and not by chance; or None."""
    within = [error <= goal for error, _ in tried] + [False, False]
    for i in range(len(tried) - 1):
        asymptotic = tried[i + 1][0] <= 3 * tried[i][0]
        if within[i] and within[i + 1] and (asymptotic or within[i + 2]):
            return tried[i][1]
    return None


def shortest(run, least, most):
    """The shortest time (s) of so many runs at least, and of as many as fit into 0.05 s."""
    times = []
    while len(times) < least or (sum(times) < 0.05 and len(times) < most):
        begun = time.process_time_ns()
        run()
        times.append(1e-9 * (time.process_time_ns() - begun))
    return min(times)


def of_odeint(program, theta_0, end, theta, omega):
    """By stepper the error and the time of each setting."""
    tried = {}
    words = [program, repr(theta_0), str(int(end)), repr(theta), repr(omega)]
    for name, error, seconds in printed(*words):
        tried.setdefault(name, []).append((float(error), float(seconds)))
    return tried


def of_heyoka(theta_0, end, theta, omega):
    """The error and the time of each tolerance, four to a decade."""
    tried = []
    for quarters in range(4, 61):
        tolerance = 10 ** (-0.25 * quarters)
        series = heyoka.taylor_adaptive(EQUATIONS, [theta_0, 0.0], tol=tolerance)

        def run():
            series.time = 0.0
            series.state[:] = theta_0, 0.0
            series.propagate_until(end)

        taken = shortest(run, 7, 1000)
        off = abs(series.state[0] - theta), abs(series.state[1] - omega) / GRAVITY**0.5
        tried.append((max(off), taken))
    return tried


def of_batches(ensemble):
    """The same of the ensemble, in batches as wide as the processor's registers."""
    lanes = heyoka.recommended_simd_size()
    rows = numpy.array(ensemble)
    starts, duration = rows[:, 0].reshape(-1, lanes), rows[0, 1]
    exact = rows[:, 2:].reshape(-1, lanes, 2)
    tried = []
    for halves in range(2, 31):
        tolerance = 10 ** (-0.5 * halves)
        nothing = numpy.zeros((2, lanes))
        series = heyoka.taylor_adaptive_batch(EQUATIONS, nothing, tol=tolerance)
        ends = numpy.empty((len(starts), 2, lanes))

        def run():
            for start, end in zip(starts, ends):
                series.set_time(0.0)
                series.state[0] = start
                series.state[1] = 0.0
                series.propagate_until(duration)
                end[:] = series.state

        taken = shortest(run, 3, 3)
        off = numpy.abs(ends.transpose(0, 2, 1) - exact)
        tried.append((max(off[..., 0].max(), off[..., 1].max() / GRAVITY**0.5), taken))
    return tried


def power(goal):
    return f"$10^{{{round(numpy.log10(goal))}}}$"


def main():
    scenes, ensemble = exact_ends()
    program = str(ROOT / "target/odeint")
    compiler = ["g++", "-std=c++17", "-O3", "-march=native", "-o", program]
    printed(*compiler, str(HERE / "odeint.cpp"))
    print("Shortest CPU times\n")
    print("| Scene | error | heyoka, µs | of Boost.odeint | µs |")
    print("|---|---|--:|---|--:|")
    for scene in scenes:
        series, steppers = of_heyoka(*scene), of_odeint(program, *scene)
        for goal in GOALS:
            name = f"{scene[0]:g} rad, {scene[1]:g} s" if goal == GOALS[0] else "…"
            own = setting_for(goal, series)
            times = [(setting_for(goal, tried), stepper) for stepper, tried in steppers.items()]
            quickest = min((pair for pair in times if pair[0]), default=None)
            cells = [name, power(goal), f"{1e6 * own:.1f}" if own else "–"]
            cells += [f"`{quickest[1]}`", f"{1e6 * quickest[0]:.1f}"] if quickest else ["–"] * 2
            print(f"| {' | '.join(cells)} |")
    print(f"\n{len(ensemble)} pendulums, {ensemble[0][1]:g} s, in heyoka's batches\n")
    print("| Largest error | ms | runs a second |")
    print("|---|--:|--:|")
    tried = of_batches(ensemble)
    for goal in GOALS[:-1]:
        taken = setting_for(goal, tried)
        cells = f"{1e3 * taken:.1f} | {len(ensemble) / taken:.0f}" if taken else "– | –"
        print(f"| {power(goal)} | {cells} |")


main()
