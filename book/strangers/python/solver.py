"""Solvers of Python's libraries that choose their steps, as programs for `pendula verify`:

    python3 solver.py LIBRARY-SOLVER

It needs the package pendula (`book/judge/python`) and what `solvers-requirements.txt` names. For
each library a function makes, of a solver's name, what solves and, where the library looks for
events by itself, what finds passages through zero; it imports what it needs itself, as only one is
loaded. States come from where the library's documentation says that they do. Nothing is repaired,
and a tolerance is handed on as it is, unless the library hangs with it, or takes it for none.
"""

import math
import sys

import pendula

# Allowed in one run, where a library stops after 500 steps or 10,000.
STEPS = 10**6
NAN, INF = math.nan, math.inf


def refuse(tolerance, *bad):
    """Refuses a tolerance with which the library hangs, or which it takes for none."""
    if any(tolerance == x or (x != x and tolerance != tolerance) for x in bad):
        raise ValueError(f"the library has no use for a tolerance of {tolerance}")


def held(good, why="it did not reach the end"):
    if not good:
        raise RuntimeError(why)


# --------------------------------------------------------------------------------------------------
# SciPy, and what looks like it
# --------------------------------------------------------------------------------------------------


def like_scipy(solve_ivp, method, bad=(), **usual):
    """A function like SciPy's solve_ivp. Its t_eval interpolates even the last time, so a single
    one is asked for without."""

    def call(rate, y0, times, tolerance, **more):
        refuse(tolerance, *bad)
        found = solve_ivp(rate, (times[0], times[-1]), y0, method=method, rtol=tolerance,
                          atol=rate.absolute, **usual, **more)
        held(found.success, found.message)
        return found

    def solver(rate, y0, times, tolerance):
        if len(times) == 2:
            return [call(rate, y0, times, tolerance).y[:, -1]]
        return call(rate, y0, times, tolerance, t_eval=times[1:]).y.T

    def crossings(rate, y0, times, tolerance):
        found = call(rate, y0, times, tolerance, events=lambda t, y: y[0])
        return [(t, *y) for t, y in zip(found.t_events[0], found.y_events[0])]

    return solver, crossings


def scipy(name):
    """A relative tolerance under 100 epsilons it raises to that itself; a negative absolute one it
    refuses. With 0, infinity or NaN the explicit solvers hang; LSODA answers the last two, with
    nonsense, and refuses 0; Radau and BDF refuse all three."""
    from scipy.integrate import solve_ivp

    bad = {"Radau": (), "BDF": (), "LSODA": (INF, NAN)}.get(name, (0.0, INF, NAN))
    return like_scipy(solve_ivp, name, bad)


def extensisq(name):
    """More methods for SciPy's solve_ivp."""
    import extensisq
    from scipy.integrate import solve_ivp

    return like_scipy(solve_ivp, getattr(extensisq, name), (0.0, INF, NAN))


def scipy_ode(name):
    """The older `ode`, begun anew at each time asked for: there a step of Hairer's codes ends, and
    vode and lsoda interpolate. One absolute tolerance, as 1.17 takes no sequence, contrary to its
    documentation. Hairer's take a negative one as its magnitude, and an infinite one as none."""
    from scipy.integrate import ode

    name, _, kind = name.partition(".")
    more = {"method": kind} if kind else {}

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, INF, -INF, *(() if name.startswith("dop") else (0.0, NAN)))
        code = ode(rate).set_integrator(name, rtol=tolerance, atol=tolerance, nsteps=STEPS, **more)
        code.set_initial_value(y0, times[0])
        found = []
        for t in times[1:]:
            found.append(code.integrate(t).copy())
            held(code.successful(), f"{name} returned {code.get_return_code()}")
        return found

    return solver, None


def scipy_odeint(_):
    """LSODA by its oldest door, which interpolates even the end. It only warns of a failure, which
    is an error here."""
    from scipy.integrate import odeint

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, INF, NAN)
        found, told = odeint(rate, y0, times, tfirst=True, rtol=tolerance, atol=rate.absolute,
                             mxstep=STEPS, full_output=True)
        held(told["message"] == "Integration successful.", told["message"])
        return found[1:]

    return solver, None


def cyrk(name):
    """pysolve_ivp, which is like SciPy's, but for a column for each event."""
    import numpy as np
    from CyRK import pysolve_ivp

    def solve_ivp(rate, span, y0, events=None, t_eval=None, **more):
        if t_eval is not None:
            more["t_eval"] = np.array(t_eval)
        if events is not None:
            more["events"] = (events,)
        found = pysolve_ivp(lambda t, y: np.array(rate(t, y)), span, np.array(y0),
                            max_num_steps=STEPS, **more)
        held(found.success, found.message)
        return found

    solver, _ = like_scipy(solve_ivp, name, (0.0, INF, NAN))

    def crossings(rate, y0, times, tolerance):
        found = solve_ivp(rate, (times[0], times[1]), y0, lambda t, y: y[0], method=name,
                          rtol=tolerance, atol=rate.absolute)
        return zip(found.t_events[0], *found.y_events[0])

    return solver, crossings


def cyrk_numba(name):
    """nbsolve_ivp, for functions that numba compiles."""
    import numba
    import numpy as np
    from CyRK import nbsolve_ivp

    @numba.njit
    def force(t, y, g, a, w, count):
        count[0] += 1.0
        return np.array([y[1], a * math.cos(w * t) - g * math.sin(y[0])])

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, NAN)
        count = np.zeros(1)
        more = {"t_eval": np.array(times[1:])} if len(times) > 2 else {}
        found = nbsolve_ivp(force, (times[0], times[-1]), np.array(y0),
                            (rate.g_over_l, rate.amplitude, rate.frequency, count),
                            rtol=tolerance, atols=np.array(rate.absolute), warnings=False,
                            rk_method=["RK23", "RK45", "DOP853"].index(name), **more)
        held(found.success, found.message)
        rate.evaluations = int(count[0])
        return found.y.T if more else [found.y[:, -1]]

    return solver, None


# --------------------------------------------------------------------------------------------------
# JAX
# --------------------------------------------------------------------------------------------------


def padded(times):
    """The times, filled up to a power of two by the last, so that few numbers are compiled for."""
    return times + [times[-1]] * ((1 << (len(times) - 1).bit_length()) - len(times))


def diffrax(name):
    """diffeqsolve with a PIDController. A single time is asked for as the end (t1), where a step
    ends; others are interpolated. Evaluations in compiled code are counted as one for each stage of
    each step, taken or not, and one more, which is their number for the explicit solvers; an
    implicit one's inner iteration is left out. An event ends a run, so the next run begins at that
    crossing and waits for one of the other direction. KenCarp's are for sums: the force is their
    implicit part. A tolerance of 0 or NaN runs to the limit of steps; an infinite one is none to
    Dopri5, and Kvaerno5 does not come back with it; a negative one is its magnitude."""
    import diffrax
    import jax
    import jax.numpy as jnp
    import optimistix

    jax.config.update("jax_enable_x64", True)
    solver = getattr(diffrax, name)()
    split = name.startswith("KenCarp")
    table = getattr(solver, "tableau", None)
    table = table.tableaus[1] if split else table
    stages = table.num_stages - (1 if table.fsal else 0) if table else 1

    def velocity(t, y, ask):
        return jnp.stack([y[1], 0.0])

    def force(t, y, ask):
        return jnp.stack([0.0, ask[1] * jnp.cos(ask[2] * t) - ask[0] * jnp.sin(y[0])])

    def both(t, y, ask):
        return velocity(t, y, ask) + force(t, y, ask)

    term = diffrax.ODETerm(both)
    if split:
        term = diffrax.MultiTerm(diffrax.ODETerm(velocity), diffrax.ODETerm(force))

    def run(save, event, t0, t1, y, tolerance, absolute, ask):
        found = diffrax.diffeqsolve(
            term, solver, t0, t1, None, y, args=ask, saveat=save, event=event, max_steps=STEPS,
            stepsize_controller=diffrax.PIDController(rtol=tolerance, atol=absolute), throw=False)
        ended = found.result == diffrax.RESULTS.event_occurred
        good = ended | (found.result == diffrax.RESULTS.successful)
        return found.ts, found.ys, found.stats["num_steps"], good, ended

    def passage(up):
        def find(*rest):
            finder = optimistix.Newton(rtol=rest[3], atol=rest[3])
            watch = diffrax.Event(lambda t, y, args, **_: y[0], finder, direction=up)
            return run(diffrax.SaveAt(t1=True), watch, *rest)
        return jax.jit(find)

    at = jax.jit(lambda ts, *rest: run(diffrax.SaveAt(ts=ts), None, *rest))
    end = jax.jit(lambda *rest: run(diffrax.SaveAt(t1=True), None, *rest))
    up, down = passage(True), passage(False)

    def call(kind, rate, t0, t1, y, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)
        ask = tuple(jnp.float64(x) for x in (rate.g_over_l, rate.amplitude, rate.frequency))
        t, y, steps, good, ended = kind(
            t0, t1, jnp.array(y), tolerance, jnp.array(rate.absolute), ask)
        held(good)
        rate.evaluations += int(steps) * stages + 1
        return t.tolist(), y.tolist(), bool(ended)

    def solve(rate, y0, times, tolerance):
        if len(times) == 2:
            return call(end, rate, *times, y0, tolerance)[1]
        ts = jnp.array(padded(times[1:]))
        kind = lambda *rest: at(ts, *rest)
        return call(kind, rate, times[0], times[-1], y0, tolerance)[1][:len(times) - 1]

    def crossings(rate, y, times, tolerance):
        (t, until), found = times, []
        ahead = math.copysign(1.0, until - t)
        rises = y[0] < 0.0 or (y[0] == 0.0 and y[1] * ahead < 0.0)
        while True:
            (t,), (y,), ended = call(up if rises else down, rate, t, until, y, tolerance)
            if not ended:
                return found
            found.append((t, *y))
            rises = not rises

    return solve, crossings


def jax_odeint(_):
    """jax.experimental.ode.odeint, Dormand and Prince's method, which interpolates even the end;
    one absolute tolerance, and the times have to increase. It is compiled for each tolerance, and
    does not say that it gave up."""
    import jax
    import jax.numpy as jnp
    from jax.experimental.ode import odeint

    jax.config.update("jax_enable_x64", True)

    def force(y, t, g, a, w):
        return jnp.stack([y[1], a * jnp.cos(w * t) - g * jnp.sin(y[0])])

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)
        ask = (jnp.float64(x) for x in (rate.g_over_l, rate.amplitude, rate.frequency))
        return odeint(force, jnp.array(y0), jnp.array(padded(times)), *ask, rtol=tolerance,
                      atol=tolerance, mxstep=STEPS)[1:len(times)].tolist()

    return solver, None


# --------------------------------------------------------------------------------------------------
# PyTorch
# --------------------------------------------------------------------------------------------------


def torchdiffeq(name):
    """odeint. It interpolates even the end, by a quartic, and takes a run back as the mirrored
    equation. It refuses a tolerance of 0, infinity or NaN; a negative one is its magnitude."""
    import torch
    from torchdiffeq import odeint

    def real(x):
        return torch.tensor(x, dtype=torch.float64)

    def solver(rate, y0, times, tolerance):
        def force(t, y):
            rate.evaluations += 1
            pull = rate.amplitude * torch.cos(rate.frequency * t)
            return torch.stack([y[1], pull - rate.g_over_l * torch.sin(y[0])])

        return odeint(force, real(y0), real(times), method=name, rtol=tolerance,
                      atol=real(rate.absolute))[1:].tolist()

    return solver, None


def torchode(name):
    """solve_ivp with its usual PIDController, of a batch of one. It interpolates even the end."""
    import torch
    import torchode

    def real(x):
        return torch.tensor(x, dtype=torch.float64)

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)

        def force(t, y):
            rate.evaluations += 1
            pull = rate.amplitude * torch.cos(rate.frequency * t)
            return torch.stack([y[:, 1], pull - rate.g_over_l * torch.sin(y[:, 0])], dim=1)

        term = torchode.ODETerm(force)
        control = torchode.PIDController(term=term, atol=tolerance, rtol=tolerance,
                                         pcoeff=0.2, icoeff=0.5, dcoeff=0.0)
        found = torchode.solve_ivp(term, real([y0]), real(times), method=name, controller=control,
                                   max_steps=STEPS)
        held(int(found.status[0]) == 0, f"status {int(found.status[0])}")
        return found.ys[0, 1:].tolist()

    return solver, None


# --------------------------------------------------------------------------------------------------
# SUNDIALS
# --------------------------------------------------------------------------------------------------


def sundae(name):
    """scikit-sundae's CVODE, and IDA, whose residual is y' less the rate. The last time is its
    stop, where a step ends; others are interpolated. It refuses what is no tolerance."""
    if name == "IDA":
        from sksundae.ida import IDA as kind
        more = {}
    else:
        from sksundae.cvode import CVODE as kind
        more = {"method": name}

    def call(rate, y0, times, tolerance, **watch):
        def rates(t, y, out):
            out[:] = rate(t, y)

        def residual(t, y, slope, out):
            out[:] = slope - rate(t, y)

        code = kind(residual if name == "IDA" else rates, rtol=tolerance, atol=rate.absolute,
                    max_num_steps=STEPS, **more, **watch)
        slope = [rate(times[0], y0)] if name == "IDA" else []
        found = code.solve(times, y0, *slope)
        held(found.success, found.message)
        return found

    def solver(rate, y0, times, tolerance):
        found = call(rate, y0, times, tolerance).y
        # Of two times it returns all its steps between.
        return found[1:] if len(times) > 2 else [found[-1]]

    def crossings(rate, y0, times, tolerance):
        def zero(t, y, out):
            out[0] = y[0]

        def zero_of_ida(t, y, slope, out):
            out[0] = y[0]

        zero = zero_of_ida if name == "IDA" else zero
        zero.terminal = [False]
        found = call(rate, y0, times, tolerance, eventsfn=zero, num_events=1)
        if found.t_events is None:
            return []
        return [(t, *y) for t, y in zip(found.t_events, found.y_events)]

    return solver, crossings


def casadi(name):
    """integrator("cvodes"), with Adams or BDF, "idas", "erk" and "rosenbrock", with one absolute
    tolerance. It refuses what is no tolerance; "idas" hangs with NaN."""
    import casadi

    y, t, p = (casadi.SX.sym(*x) for x in (("y", 2), ("t",), ("p", 3)))
    force = p[1] * casadi.cos(p[2] * t) - p[0] * casadi.sin(y[0])
    problem = {"x": y, "t": t, "p": p, "ode": casadi.vertcat(y[1], force)}
    plugin, more = name.lower(), {}
    if name in ("Adams", "BDF"):
        plugin, more = "cvodes", {"linear_multistep_method": plugin}

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, *([NAN] if plugin == "idas" else []))
        code = casadi.integrator("code", plugin, problem, times[0], times[1:], {
            "reltol": tolerance, "abstol": tolerance, "max_num_steps": STEPS, **more})
        ask = [rate.g_over_l, rate.amplitude, rate.frequency]
        found = code(x0=y0, p=ask)["xf"].full().T
        told = code.stats()
        rate.evaluations = told["nfevals"] if "nfevals" in told else told["n_rhs"]
        return found

    return solver, None


# --------------------------------------------------------------------------------------------------
# Others
# --------------------------------------------------------------------------------------------------


def heyoka(_):
    """taylor_adaptive: the tolerance, which is one number, decides the order, and so is compiled
    in. A single time is the end of a step; others are values of the series. It does not evaluate a
    force. It takes a tolerance of 0 for epsilon, and refuses what is none."""
    import heyoka

    x, v, (g, a, w) = *heyoka.make_vars("x", "v"), (heyoka.par[i] for i in range(3))
    rates = [(x, v), (v, a * heyoka.cos(w * heyoka.time) - g * heyoka.sin(x))]
    done, made = heyoka.taylor_outcome.time_limit, {}

    def begin(rate, y0, t0, tolerance, watch):
        """The integrator for a tolerance, and the crossings that it finds."""
        if (tolerance, watch) not in made:
            found = []

            def seen(code, t, sign):
                code.update_d_output(t)
                found.append((t, *code.d_output))

            more = {"nt_events": [heyoka.nt_event(x, callback=seen)]} if watch else {}
            made[tolerance, watch] = heyoka.taylor_adaptive(
                rates, [0.0, 0.0], tol=tolerance, pars=[0.0] * 3, **more), found
        code, found = made[tolerance, watch]
        found.clear()
        code.time, code.state[:] = t0, y0
        code.pars[:] = rate.g_over_l, rate.amplitude, rate.frequency
        return code, found

    def solver(rate, y0, times, tolerance):
        code, _ = begin(rate, y0, times[0], tolerance, False)
        if len(times) == 2:
            told = code.propagate_until(times[1])[0]
            held(told == done, str(told))
            return [code.state.copy()]
        told, *_, found = code.propagate_grid(times)
        held(told == done, str(told))
        return found[1:]

    def crossings(rate, y0, times, tolerance):
        code, found = begin(rate, y0, times[0], tolerance, True)
        told = code.propagate_until(times[1])[0]
        held(told == done, str(told))
        return found

    return solver, crossings


def numbalsoda(name):
    """lsoda, which interpolates even the end, and dop853, both with one absolute tolerance. Run
    back, lsoda fails, and dop853 returns memory that was never written and says that all is
    well. lsoda answers a tolerance of 0, infinity and NaN with the start, with nonsense and with
    NaN."""
    import numba
    import numbalsoda
    import numpy as np

    @numba.cfunc(numbalsoda.lsoda_sig)
    def force(t, y, out, ask):
        out[0] = y[1]
        out[1] = ask[1] * math.cos(ask[2] * t) - ask[0] * math.sin(y[0])
        ask[3] += 1.0

    code = getattr(numbalsoda, name)

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, NAN)
        ask = np.array([rate.g_over_l, rate.amplitude, rate.frequency, 0.0])
        found, good = code(force.address, np.array(y0), np.array(times), ask, rtol=tolerance,
                           atol=tolerance, mxstep=STEPS)
        held(good)
        rate.evaluations = int(ask[3])
        return found[1:]

    return solver, None


def desolver(name):
    """OdeSystem. A single time is the end of a step; others are interpolated (dense_output). A
    first step must be given. A negative tolerance is its magnitude, an infinite one none; with 0 it
    takes steps all the same."""
    import warnings

    import desolver
    import numpy as np

    warnings.simplefilter("ignore")

    def call(rate, y0, times, tolerance, dense):
        refuse(tolerance, 0.0, INF, -INF)
        force = desolver.DiffRHS(lambda t, y, **_: np.array(rate(t, y)))
        code = desolver.OdeSystem(
            force, y0=np.array(y0), t=(times[0], times[-1]), dt=(times[-1] - times[0]) / 1000,
            rtol=tolerance, atol=np.array(rate.absolute), dense_output=dense)
        code.method = name
        return code

    def solver(rate, y0, times, tolerance):
        code = call(rate, y0, times, tolerance, len(times) > 2)
        code.integrate()
        held(code.success, code.integration_status)
        return [code.sol(t) for t in times[1:]] if len(times) > 2 else [code.y[-1]]

    def crossings(rate, y0, times, tolerance):
        code = call(rate, y0, times, tolerance, True)
        code.integrate(events=[lambda t, y, **_: y[0]])
        held(code.success, code.integration_status)
        return [(it.t, *it.y) for it in code.events]

    return solver, crossings


def pathsim(name):
    """A Simulation with one block, ODE, run from each time to the next; an event is approached by
    shorter steps."""
    import numpy as np
    import pathsim
    from pathsim.blocks import ODE
    from pathsim.events import ZeroCrossing

    def begin(rate, y0, t0, tolerance, **more):
        block = ODE(lambda y, u, t: np.array(rate(t, y)), np.array(y0))
        events = [ZeroCrossing(func_evt=lambda t: block.engine.state[0], **it)
                  for it in more.values()]
        code = pathsim.Simulation(
            [block], [], events, dt=None, log=False, Solver=getattr(pathsim.solvers, name),
            tolerance_lte_abs=np.array(rate.absolute), tolerance_lte_rel=tolerance)
        code.reset(t0)
        return code, block

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)
        code, block = begin(rate, y0, times[0], tolerance)
        found = []
        for t in times[1:]:
            code.run(t - code.time)
            found.append(block.engine.state.copy())
        return found

    def crossings(rate, y0, times, tolerance):
        found = []

        def seen(t):
            found.append((t, *block.engine.state))

        code, block = begin(rate, y0, times[0], tolerance,
                            zero={"func_act": seen, "tolerance": tolerance})
        code.run(times[1] - times[0])
        return found

    return solver, crossings


def rebound_bs(_):
    """REBOUND's Gragg–Bulirsch–Stoer, by its interface for equations of any kind; one absolute
    tolerance. Each time asked for is the end of a step (exact_finish_time)."""
    import rebound

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)

        def rates(_, out, y, t):
            out[0], out[1] = rate(t, y)

        code = rebound.Simulation()
        code.integrator = "bs"
        code.integrator.eps_rel = code.integrator.eps_abs = tolerance
        code.t = times[0]
        equation = code.create_ode(length=2, needs_nbody=False)
        equation.derivatives = rates
        equation.y[0], equation.y[1] = y0
        found = []
        for t in times[1:]:
            code.integrate(t)
            found.append((equation.y[0], equation.y[1]))
        return found

    return solver, None


def rebound_ias15(_):
    """REBOUND's integrator of order 15, of a particle whose place is the angle. Its tolerance is
    epsilon, which bounds the last term of the force's series and not an error. Each time asked for
    is the end of a step."""
    import rebound

    def solver(rate, y0, times, tolerance):
        refuse(tolerance, 0.0, INF, -INF, NAN)
        code = rebound.Simulation()
        code.integrator, code.gravity = "ias15", "none"
        code.integrator.epsilon = tolerance
        code.t = times[0]
        code.add(m=1.0, x=y0[0], vx=y0[1])
        place = code.particles[0]

        def force(_):
            place.ax = rate(code.t, [place.x, place.vx])[1]

        code.additional_forces = force
        found = []
        for t in times[1:]:
            code.integrate(t)
            found.append((place.x, place.vx))
        return found

    return solver, None


# Of a library's name; a solver's name follows it, if it has several.
LIBRARIES = {
    "SciPy": scipy, "SciPy-ode": scipy_ode, "SciPy-odeint": scipy_odeint, "extensisq": extensisq,
    "CyRK": cyrk, "CyRK-numba": cyrk_numba, "diffrax": diffrax, "JAX-odeint": jax_odeint,
    "torchdiffeq": torchdiffeq, "torchode": torchode,
    "scikit-sundae": sundae, "CasADi": casadi, "heyoka": heyoka, "numbalsoda": numbalsoda,
    "desolver": desolver, "pathsim": pathsim, "REBOUND-BS": rebound_bs,
    "REBOUND-IAS15": rebound_ias15,
}


def main():
    name = sys.argv[1]
    library, _, method = (name, "", "") if name in LIBRARIES else name.rpartition("-")
    solver, crossings = LIBRARIES[library](method)
    pendula.serve(solver=solver, crossings=crossings, name=name)


if __name__ == "__main__":
    main()
