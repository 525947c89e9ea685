"""What programs that are no Rust crates take to come to an error: heyoka and Boost.odeint.

    python3 benches/peers/others.py

It needs cargo, for the exact ends of the motions; pip, which puts heyoka into target/peers-python;
and g++ with Boost's headers (Debian: libboost-dev). Whatever is missing is said in a line and left
out, and the exit status is then 1.

The scenes, the errors and what counts as reaching one are those of `src/front.rs`, whose table has
the library: max(|dtheta|, |domega|/omega_0) at the end, and a setting counts if the next finer one
is within the error too, and no more than three times worse, or the one after it is within the error
as well. Times are the shortest CPU time of the process over seven runs or more, in microseconds.
heyoka compiles its step for this processor, and odeint is compiled with -march=native.
"""

import os
import pathlib
import platform
import subprocess
import sys

HEYOKA = "heyoka==7.13.2"

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGET = ROOT / "target"
HERE = pathlib.Path(__file__).resolve().parent

GOALS = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
GOALS_OF_ENSEMBLE = GOALS[:-1]


class Missing(Exception):
    """What cannot be measured here, in a line."""


def command(what, words):
    """What a command prints."""
    try:
        done = subprocess.run(words, cwd=ROOT, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
    except OSError as error:
        raise Missing(f"{what}: {words[0]}: {error.strerror}") from None
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise Missing(f"{what}: {pathlib.Path(words[0]).name} failed: {last}")
    return done.stdout


def exact_ends():
    """Of each scene and of each pendulum of the ensemble: start, duration, angle, velocity."""
    lines = command("the exact motion", ["cargo", "run", "--quiet", "--profile", "peers", "-p",
                                         "pendula-peers", "--", "ends"]).splitlines()
    rows = [(line.split()[0], *map(float, line.split()[1:])) for line in lines]
    scenes = [row[1:] for row in rows if row[0] == "scene"]
    return scenes, [row[1:] for row in rows if row[0] == "ensemble"]


def setting_for(goal, tried):
    """The coarsest setting that is within the goal, and not by chance."""
    within = [error <= goal for error, _ in tried] + [False, False]
    for i in range(len(tried) - 1):
        asymptotic = tried[i + 1][0] <= 3 * tried[i][0]
        if within[i] and within[i + 1] and (asymptotic or within[i + 2]):
            return tried[i][1]
    return None


def of_odeint(scenes):
    """For each scene a list by stepper of errors and times."""
    program = TARGET / "odeint"
    TARGET.mkdir(exist_ok=True)
    command("odeint", ["g++", "-std=c++17", "-O3", "-march=native", "-o", str(program),
                       str(HERE / "odeint.cpp")])
    results = []
    for theta_0, end, theta, omega in scenes:
        words = [str(program), repr(theta_0), str(int(end)), repr(theta), repr(omega)]
        by_stepper = {}
        for line in command("odeint", words).splitlines():
            name, error, time = line.split()
            by_stepper.setdefault(name, []).append((float(error), float(time)))
        results.append(by_stepper)
    return results


def of_heyoka():
    """The same by this script, run by a Python that has heyoka."""
    environment = TARGET / "peers-python"
    python = environment / "bin" / "python"
    if not python.exists():
        command("heyoka", [sys.executable, "-m", "venv", str(environment)])
    command("heyoka", [str(python), "-m", "pip", "install", "--quiet",
                       "--disable-pip-version-check", HEYOKA])
    scenes, ensemble = [], []
    for line in command("heyoka", [str(python), __file__, "--heyoka"]).splitlines():
        kind, index, error, time = line.split()
        if kind == "ensemble":
            ensemble.append((float(error), float(time)))
        else:
            index = int(index)
            scenes.extend([] for _ in range(index + 1 - len(scenes)))
            scenes[index].append((float(error), float(time)))
    return [{"heyoka": tried} for tried in scenes], ensemble


def measure_heyoka():
    """Prints a line for each setting; runs under the Python that has heyoka."""
    import time

    import heyoka
    import numpy

    gravity = 9.81
    x, v = heyoka.make_vars("x", "v")
    equations = [(x, v), (v, -gravity * heyoka.sin(x))]
    scenes, ensemble = exact_ends()

    def shortest(run, least, most):
        times = []
        while len(times) < least or (sum(times) < 0.05 and len(times) < most):
            begun = time.process_time_ns()
            run()
            times.append(1e-9 * (time.process_time_ns() - begun))
        return min(times)

    for index, (theta_0, end, theta, omega) in enumerate(scenes):
        for quarters in range(4, 61):
            tolerance = 10 ** (-0.25 * quarters)
            series = heyoka.taylor_adaptive(equations, [theta_0, 0.0], tol=tolerance)

            def run():
                series.time = 0.0
                series.state[:] = theta_0, 0.0
                series.propagate_until(end)

            taken = shortest(run, 7, 1000)
            error = max(abs(series.state[0] - theta),
                        abs(series.state[1] - omega) / gravity**0.5)
            print("scene", index, repr(float(error)), repr(taken), flush=True)

    lanes = heyoka.recommended_simd_size()
    rows = numpy.array(ensemble)
    starts, duration = rows[:, 0].reshape(-1, lanes), rows[0, 1]
    exact = rows[:, 2:].reshape(-1, lanes, 2)
    for halves in range(2, 31):
        tolerance = 10 ** (-0.5 * halves)
        nothing = numpy.zeros((2, lanes))
        series = heyoka.taylor_adaptive_batch(equations, nothing, tol=tolerance)
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
        error = max(off[..., 0].max(), off[..., 1].max() / gravity**0.5)
        print("ensemble", lanes, repr(float(error)), repr(taken), flush=True)


def processor():
    """The processor and its vector instructions."""
    fields = {}
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            name, _, value = line.partition(":")
            fields.setdefault(name.strip(), value.strip())
    except OSError:
        pass
    flags = fields.get("flags", fields.get("Features", "")).split()
    known = [flag for flag in ("sse2", "avx", "avx2", "fma", "avx512f", "asimd") if flag in flags]
    load = "%.1f" % os.getloadavg()[0]
    return (f"{platform.machine()} with {', '.join(known) or 'instructions unknown'}; "
            f"{fields.get('model name', 'no name')}; load {load} on {os.cpu_count()} processors")


def cell(tried, goal):
    """The quickest of the steppers: its name and time."""
    times = [(setting_for(goal, settings), name) for name, settings in tried.items()]
    times = [(time, name) for time, name in times if time is not None]
    if not times:
        return "–", "–"
    time, name = min(times)
    return name, f"{1e6 * time:.1f}"


def main():
    failed = False
    results = {}
    try:
        scenes, ensemble = exact_ends()
    except Missing as missing:
        print(f"others.py: {missing}", file=sys.stderr)
        return 1
    runs = None
    try:
        results["heyoka"], runs = of_heyoka()
    except Missing as missing:
        print(f"others.py: {missing}", file=sys.stderr)
        failed = True
    try:
        results["odeint"] = of_odeint(scenes)
    except Missing as missing:
        print(f"others.py: {missing}", file=sys.stderr)
        failed = True
    print(processor())
    print("Shortest CPU times\n")
    print("| Scene | error | heyoka, µs | of Boost.odeint | µs |")
    print("|---|---|--:|---|--:|")
    for index, (theta_0, end, _, _) in enumerate(scenes):
        for goal in GOALS:
            name = f"{theta_0:g} rad, {end:g} s" if goal == GOALS[0] else "…"
            of = {peer: cell(tried[index], goal) for peer, tried in results.items()}
            heyoka = of.get("heyoka", ("–", "–"))[1]
            stepper, odeint = of.get("odeint", ("–", "–"))
            stepper = f"`{stepper}`" if stepper != "–" else stepper
            print(f"| {name} | $10^{{{goal:.0e}}}$".replace("1e-0", "-").replace("1e-", "-"),
                  f"| {heyoka} | {stepper} | {odeint} |")
    if runs:
        print(f"\n{len(ensemble)} pendulums, {ensemble[0][1]:g} s, in heyoka's batches\n")
        print("| Largest error | ms | runs a second |")
        print("|---|--:|--:|")
        for goal in GOALS_OF_ENSEMBLE:
            time = setting_for(goal, runs)
            shown = f"{1e3 * time:.1f} | {len(ensemble) / time:.0f}" if time else "– | –"
            print(f"| $10^{{{goal:.0e}}}$".replace("1e-0", "-").replace("1e-", "-"),
                  f"| {shown} |")
    return 1 if failed else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--heyoka"]:
        try:
            measure_heyoka()
        except Missing as missing:
            sys.exit(f"{missing}")
    elif sys.argv[1:]:
        sys.exit("others.py: no arguments")
    else:
        sys.exit(main())
