"""Solvers of Python's libraries that choose their steps, as strangers, protocol 1:

    python3 solver.py LIBRARY-SOLVER

An adapter is a class: of a solver's name it makes an object with `solve(run)`, which returns the
states at `run.grid` as pairs (theta, omega), and, where the library looks for events by itself,
`crossings(run)`, which returns (t, theta, omega) for each. It imports what it needs itself, as only
one library is loaded.
"""

import math
import os
import sys

# Allowed in one run, where a library stops after 500 steps or 10,000.
STEPS = 10**6


class Run:
    """One request: theta'' = -g sin(theta) + a cos(w t), from t0 on, or back."""

    def __init__(self, words):
        self.events = words[0] == "crossings"
        self.driven = words[0] == "driven-solve"
        values = [float(x) for x in words[1:]]
        if not self.driven:
            values[1:1] = [0.0, 0.0]
        self.g, self.a, self.w, theta, omega, self.t0 = values[:6]
        if self.events:
            end, self.tol = values[6:]
            self.asked = [end]
        else:
            self.tol, self.asked = values[6], values[7:]
        self.start = (theta, omega)
        # The tolerance of theta and of omega, for a library that takes two.
        self.each = [self.tol, self.tol * math.sqrt(abs(self.g))]
        # Where the run begins, and then each of the times once.
        self.grid = [self.t0]
        for t in self.asked:
            if t != self.grid[-1]:
                self.grid.append(t)
        # No library answers these with a reason: with an endless time most never return, and times
        # that turn round, or are none, are another error in each.
        if not self.asked or not all(map(math.isfinite, self.grid)):
            raise ValueError("the times are none, or not finite")
        steps = [b > a for a, b in zip(self.grid, self.grid[1:])]
        if len(set(steps)) > 1:
            raise ValueError("the times turn round")
        # The evaluations of the force; none where nobody counts them.
        self.count = 0

    def force(self, t, x):
        """The angular acceleration, counted."""
        self.count += 1
        fall = -self.g * math.sin(x)
        return self.a * math.cos(self.w * t) + fall if self.driven else fall

    def rate(self, t, y):
        """The derivatives of angle and velocity, as a list."""
        return [y[1], self.force(t, y[0])]

    def refuse(self, *bad):
        """Refuses a tolerance that the library itself does not refuse, but hangs with, or takes for
        none. Any other it is handed as it is, so that its own behaviour shows."""
        if any(self.tol == x or (math.isnan(x) and math.isnan(self.tol)) for x in bad):
            raise ValueError(f"the library has no use for a tolerance of {self.tol}")


NAN, INF = math.nan, math.inf


class SciPy:
    """solve_ivp. Its t_eval interpolates even the last time, so a single one is asked for without.
    A relative tolerance under 100 epsilons it raises to that itself; a negative absolute one it
    refuses. With 0, infinity or NaN the explicit solvers hang; LSODA answers the last two, with
    nonsense, and refuses 0; Radau and BDF refuse all three."""

    def __init__(self, name):
        from scipy.integrate import solve_ivp

        bad = {"Radau": (), "BDF": (), "LSODA": (INF, NAN)}.get(name, (0.0, INF, NAN))

        def call(run, **more):
            run.refuse(*bad)
            found = solve_ivp(
                run.rate, (run.grid[0], run.grid[-1]), run.start, method=name,
                rtol=run.tol, atol=run.each, **more)
            if not found.success:
                raise RuntimeError(found.message)
            return found

        self.call = call

    def solve(self, run):
        if len(run.grid) == 2:
            return [run.start, self.call(run).y[:, -1]]
        return self.call(run, t_eval=run.grid).y.T

    def crossings(self, run):
        found = self.call(run, events=lambda t, y: y[0])
        return [(t, *y) for t, y in zip(found.t_events[0], found.y_events[0])]


class SciPyOde:
    """The older `ode`: Hairer's codes, begun anew at each time asked for. A step ends at each, and
    nothing is interpolated. One absolute tolerance, as 1.17 takes no sequence, contrary to its
    documentation. They take a negative one as its magnitude, and an infinite one as none."""

    def __init__(self, name):
        from scipy.integrate import ode

        self.ode, self.name = ode, name

    def solve(self, run):
        run.refuse(INF, -INF)
        code = self.ode(run.rate).set_integrator(
            self.name, rtol=run.tol, atol=run.tol, nsteps=STEPS)
        code.set_initial_value(run.start, run.t0)
        found = [run.start]
        for t in run.grid[1:]:
            found.append(code.integrate(t).copy())
            if not code.successful():
                raise RuntimeError(f"{self.name} returned {code.get_return_code()}")
        return found


class diffrax:
    """diffeqsolve with a PIDController, compiled once for a number of times, which are filled up to
    a power of two by the last. A single time is asked for as the end (t1), where a step ends;
    others are interpolated. Evaluations in compiled code are counted as one for each stage of each
    step, taken or not, and one more, which is their number for the explicit solvers; an implicit
    one's inner iteration is left out. An event ends a run, so the next run begins at that crossing
    and waits for one of the other direction. A tolerance of 0 or NaN runs to the
    limit of steps; an infinite one is none to Dopri5, and Kvaerno5 does not come back with it; a
    negative one is its magnitude."""

    def __init__(self, name):
        import diffrax
        import jax
        import jax.numpy as jnp
        import optimistix

        jax.config.update("jax_enable_x64", True)
        solver = getattr(diffrax, name)()
        table = solver.tableau
        self.stages = table.num_stages - (1 if table.fsal else 0)
        self.jnp = jnp

        def rate(t, y, ask):
            g, a, w, *_ = ask
            return jnp.stack([y[1], a * jnp.cos(w * t) - g * jnp.sin(y[0])])

        def run(save, event, t0, t1, y, tol, each, ask):
            found = diffrax.diffeqsolve(
                diffrax.ODETerm(rate), solver, t0, t1, None, y, args=ask, saveat=save,
                stepsize_controller=diffrax.PIDController(rtol=tol, atol=each),
                event=event, max_steps=STEPS, throw=False)
            ended = found.result == diffrax.RESULTS.event_occurred
            good = ended | (found.result == diffrax.RESULTS.successful)
            return found.ts, found.ys, found.stats["num_steps"], good, ended

        def at(ts, *rest):
            return run(diffrax.SaveAt(ts=ts), None, *rest)

        def end(_, *rest):
            return run(diffrax.SaveAt(t1=True), None, *rest)

        def event(up):
            def next_crossing(_, *rest):
                tol = rest[3]
                finder = optimistix.Newton(rtol=tol, atol=tol)
                watch = diffrax.Event(lambda t, y, args, **_: y[0], finder, direction=up)
                return run(diffrax.SaveAt(t1=True), watch, *rest)
            return next_crossing

        self.at, self.end = jax.jit(at), jax.jit(end)
        self.up, self.down = jax.jit(event(True)), jax.jit(event(False))

    def call(self, kind, run, t0, y, ts=None):
        run.refuse(0.0, INF, -INF, NAN)
        ask = tuple(self.jnp.float64(x) for x in (run.g, run.a, run.w))
        t, y, steps, good, ended = kind(
            ts, t0, run.grid[-1], self.jnp.array(y), run.tol, self.jnp.array(run.each), ask)
        if not good:
            raise RuntimeError("diffrax did not reach the end")
        run.count += int(steps) * self.stages + 1
        return t.tolist(), y.tolist(), bool(ended)

    def solve(self, run):
        if len(run.grid) == 2:
            return [run.start, *self.call(self.end, run, run.t0, run.start)[1]]
        size = 1 << (len(run.grid) - 1).bit_length()
        ts = self.jnp.array(run.grid + [run.grid[-1]] * (size - len(run.grid)))
        return self.call(self.at, run, run.t0, run.start, ts)[1][:len(run.grid)]

    def crossings(self, run):
        t, y, found = run.t0, run.start, []
        ahead = 1.0 if run.grid[-1] > run.t0 else -1.0
        up = y[0] < 0.0 or (y[0] == 0.0 and y[1] * ahead < 0.0)
        while True:
            (t,), (y,), ended = self.call(self.up if up else self.down, run, t, y)
            if not ended:
                return found
            found.append((t, *y))
            up = not up


class torchdiffeq:
    """odeint. It interpolates even the end, by a quartic, and takes a run back as the mirrored
    equation. It refuses a tolerance of 0, infinity or NaN; a negative one is its magnitude."""

    def __init__(self, name):
        import torch
        from torchdiffeq import odeint

        def real(x):
            return torch.tensor(x, dtype=torch.float64)

        def solve(run):
            def rate(t, y):
                run.count += 1
                return torch.stack(
                    [y[1], run.a * torch.cos(run.w * t) - run.g * torch.sin(y[0])])

            return odeint(rate, real(run.start), real(run.grid), method=name,
                          rtol=run.tol, atol=real(run.each)).tolist()

        self.solve = solve


class CVODE:
    """scikit-sundae's. The last time is its stop, where a step ends; others are interpolated. It
    refuses what is no tolerance."""

    def __init__(self, name):
        from sksundae.cvode import CVODE

        self.kind, self.name = CVODE, name

    def call(self, run, grid, **more):
        def rate(t, y, out):
            out[0], out[1] = run.rate(t, y)

        found = self.kind(rate, method=self.name, rtol=run.tol, atol=run.each,
                          max_num_steps=STEPS, **more).solve(grid, run.start)
        if not found.success:
            raise RuntimeError(found.message)
        return found

    def solve(self, run):
        found = self.call(run, run.grid).y
        # Of two times it returns all its steps between.
        return found if len(run.grid) > 2 else [run.start, found[-1]]

    def crossings(self, run):
        def zero(t, y, out):
            out[0] = y[0]

        zero.terminal = [False]
        found = self.call(run, run.grid, eventsfn=zero, num_events=1)
        if found.t_events is None:
            return []
        return [(t, *y) for t, y in zip(found.t_events, found.y_events)]


class heyoka:
    """taylor_adaptive: the tolerance, which is one number, decides the order, and so is compiled
    in. A single time is the end of a step; others are values of the series. It does not evaluate a
    force. It takes a tolerance of 0 for epsilon, and refuses what is none."""

    def __init__(self, _):
        import heyoka

        self.lib, self.made = heyoka, {}

    def begin(self, run):
        """The integrator for a tolerance, with the crossings it finds."""
        key = run.tol, run.events
        if key not in self.made:
            lib, found = self.lib, []
            x, v, (g, a, w) = *lib.make_vars("x", "v"), (lib.par[i] for i in range(3))

            def seen(code, t, sign):
                code.update_d_output(t)
                found.append((t, *code.d_output))

            watch = {"nt_events": [lib.nt_event(x, callback=seen)]} if run.events else {}
            rates = [(x, v), (v, a * lib.cos(w * lib.time) - g * lib.sin(x))]
            code = lib.taylor_adaptive(rates, [0.0, 0.0], tol=run.tol, pars=[0.0] * 3, **watch)
            self.made[key] = code, found
        code, found = self.made[key]
        found.clear()
        code.time, code.state[:], code.pars[:] = run.t0, run.start, (run.g, run.a, run.w)
        return code, found

    def until(self, code, t):
        told = code.propagate_until(t)[0]
        if told != self.lib.taylor_outcome.time_limit:
            raise RuntimeError(str(told))

    def solve(self, run):
        code, _ = self.begin(run)
        if len(run.grid) == 2:
            self.until(code, run.grid[-1])
            return [run.start, code.state.copy()]
        found = code.propagate_grid(run.grid)
        if found[0] != self.lib.taylor_outcome.time_limit:
            raise RuntimeError(str(found[0]))
        return found[-1]

    def crossings(self, run):
        code, found = self.begin(run)
        self.until(code, run.grid[-1])
        return found


class CasADi:
    """integrator("cvodes") with Adams or BDF and one absolute tolerance. It refuses what is no
    tolerance."""

    def __init__(self, name):
        import casadi

        y, t, p = (casadi.SX.sym(*x) for x in (("y", 2), ("t",), ("p", 3)))
        force = p[1] * casadi.cos(p[2] * t) - p[0] * casadi.sin(y[0])
        problem = {"x": y, "t": t, "p": p, "ode": casadi.vertcat(y[1], force)}

        def solve(run):
            code = casadi.integrator("code", "cvodes", problem, run.t0, run.grid[1:], {
                "linear_multistep_method": name.lower(), "reltol": run.tol, "abstol": run.tol,
                "max_num_steps": STEPS})
            found = code(x0=run.start, p=[run.g, run.a, run.w])["xf"].full().T
            run.count = code.stats()["nfevals"]
            return [run.start, *found]

        self.solve = solve


class numbalsoda:
    """lsoda, which interpolates even the end, and dop853, both with one absolute tolerance. Run
    back, lsoda fails, and dop853 returns memory that was never written and says that all is
    well."""

    def __init__(self, name):
        import numba
        import numbalsoda
        import numpy as np

        @numba.cfunc(numbalsoda.lsoda_sig)
        def rate(t, y, out, ask):
            out[0] = y[1]
            out[1] = ask[1] * math.cos(ask[2] * t) - ask[0] * math.sin(y[0])
            ask[3] += 1.0

        code, address = getattr(numbalsoda, name), rate.address

        def solve(run):
            run.refuse(0.0, INF, NAN)  # lsoda answers with the start, with nonsense and with NaN
            ask = np.array([run.g, run.a, run.w, 0.0])
            found, good = code(address, np.array(run.start), np.array(run.grid), ask,
                               rtol=run.tol, atol=run.tol, mxstep=STEPS)
            if not good:
                raise RuntimeError(f"{name} did not reach the end")
            run.count = int(ask[3])
            return found

        self.solve = solve
        self.rate = rate  # lives as long as its address is called


class desolver:
    """OdeSystem. A single time is the end of a step; others are interpolated (dense_output). A
    negative tolerance is its magnitude, an infinite one none; with 0 it takes steps all the
    same."""

    def __init__(self, name):
        import warnings

        import desolver
        import numpy as np

        warnings.simplefilter("ignore")

        def call(run, dense):
            run.refuse(0.0, INF, -INF)
            def rate(t, y, **_):
                return np.array(run.rate(t, y))

            # A first step must be given.
            length = run.grid[-1] - run.t0
            code = desolver.OdeSystem(
                desolver.DiffRHS(rate), y0=np.array(run.start), t=(run.t0, run.grid[-1]),
                dt=length / 1000, rtol=run.tol, atol=np.array(run.each), dense_output=dense)
            code.method = name
            code.integrate()
            if not code.success:
                raise RuntimeError(code.integration_status)
            return code

        def solve(run):
            if len(run.grid) == 2:
                return [run.start, call(run, False).y[-1]]
            found = call(run, True)
            return [found.sol(t) for t in run.grid]

        self.solve = solve


ADAPTERS = {
    "SciPy": SciPy, "SciPy-ode": SciPyOde, "diffrax": diffrax, "torchdiffeq": torchdiffeq,
    "CVODE": CVODE, "heyoka": heyoka, "CasADi": CasADi, "numbalsoda": numbalsoda,
    "desolver": desolver,
}


def line(values):
    return " ".join(repr(float(x)) for x in values)


def answer(words, name, adapter):
    """The lines of an answer."""
    try:
        if words == ["hello", "1"]:
            return [f"hello 1 {name}"]
        if words[0] == "crossings" and hasattr(adapter, "crossings"):
            run = Run(words)
            rows = adapter.crossings(run) if len(run.grid) > 1 else []
        elif words[0] in ("solve", "driven-solve"):
            run = Run(words)
            # A run of no length is left to no library.
            states = adapter.solve(run) if len(run.grid) > 1 else [run.start]
            found = dict(zip(run.grid, states, strict=True))
            rows = [found[t] for t in run.asked]
        else:
            return ["unsupported"]
        return [*map(line, rows), f"done {run.count}" if run.count else "done"]
    except Exception as fault:
        why = " ".join(f"{type(fault).__name__}: {fault}".split())
        return [f"error {why[:300]}"]


def main():
    name = sys.argv[1]
    # What a library prints goes to the standard error, not to our reader.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    library, _, solver = name.rpartition("-")
    adapter = ADAPTERS[library or solver](solver)
    for said in sys.stdin:
        words = said.split()
        if words == ["bye"]:
            break
        if words:
            print("\n".join(answer(words, name, adapter)), file=answers, flush=True)


main()
