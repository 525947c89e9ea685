"""Libraries that integrate y' = f(t, y), with y the angle and the velocity."""


def scipy(name):
    """Fixed steps: rtol = atol = infinity, so no error is too large and none asks for a shorter
    step; max_step = |h|, and h_abs, the estimate of the next step, is held at |h|. The adapter
    checks the length of every step."""
    import numpy as np
    from scipy import integrate

    def walk(rate, t, y, h):
        method = getattr(integrate, name)(
            rate, t, y, np.inf * h, first_step=abs(h), max_step=abs(h), rtol=np.inf, atol=np.inf)
        while True:
            method.h_abs = abs(h)
            method.step()
            if method.step_size != abs((method.t_old + h) - method.t_old):
                raise RuntimeError(f"took a step of {method.step_size}")
            yield method.y

    return dict(rate=walk, state=np.array)


def desolver(name):
    """Fixed steps: the integrators are called directly, one step a call, with the control of the
    step switched off. In 5.1.0 the sense of `is_adaptive` is the wrong way round
    (integrator_types.py, lines 81 to 86): True switches it off. The adapter checks the length of
    every step. Too slow for 1e5 steps in 10 s but for the simplest; an implicit method takes 2 ms a
    step and more."""
    import warnings

    import desolver as de
    import numpy as np

    warnings.simplefilter("ignore")
    kind = de.available_methods(False)[name]
    implicit = kind in de.integrators.implicit_methods()
    tolerance = 1e-13  # of the implicit methods' inner iteration

    def walk(rate, t, y, h):
        # An implicit method asked for a step back takes a longer one, a minimum of negative
        # numbers (integrator_types.py, line 206); it is asked for a step ahead of the mirrored
        # equation, which is the same by definition.
        sign = -1.0 if implicit and h < 0 else 1.0

        def field(t, y):
            return sign * rate(sign * t, y)

        field.jac = lambda t, y: sign * np.array([[0.0, 1.0], [-rate.g_over_l * np.cos(y[0]), 0.0]])
        field = de.DiffRHS(field, equ_repr="pendulum", md_repr="pendulum")
        h = np.float64(sign * h)
        method = kind((2,), np.dtype("float64"), rtol=tolerance, atol=tolerance)
        method.is_adaptive = True  # switches the control of the step off
        i = 0
        while True:
            _, (took, change) = method(field, np.float64(i * h), y, {}, h)
            if took != h:
                raise RuntimeError(f"took a step of {took}, not {h}")
            y, i = y + change, i + 1
            yield y

    return dict(rate=walk, state=np.array)


def diffrax(name):
    """Fixed steps: solver.step under jax.jit, in a loop of XLA, from i h to (i + 1) h. Nobody
    counts evaluations in compiled code. The implicit solvers get optimistix.Newton, as their
    documentation allows, since with the default chord iteration the inner error is that of its
    tolerance."""
    import diffrax as dx
    import jax
    import jax.numpy as jnp
    import optimistix

    jax.config.update("jax_enable_x64", True)
    tolerance = 1e-13  # of the implicit methods' inner iteration

    def force(t, x, ask):
        g, a, w, _ = ask
        return a * jnp.cos(w * t) - g * jnp.sin(x)

    kind, ode, pack = getattr(dx, name), dx.ODETerm, jnp.stack
    if name == "SemiImplicitEuler":
        terms, pack = (ode(lambda t, v, ask: v), ode(force)), tuple
    elif name in ("Sil3", "KenCarp3", "KenCarp4", "KenCarp5"):
        terms = dx.MultiTerm(ode(lambda t, y, ask: jnp.stack([0.0 * t, force(t, y[0], ask)])),
                             ode(lambda t, y, ask: jnp.stack([y[1], 0.0 * t])))
    else:
        terms = ode(lambda t, y, ask: jnp.stack([y[1], force(t, y[0], ask)]))
    solver = kind()
    if issubclass(kind, dx.AbstractImplicitSolver):
        newton = optimistix.Newton(rtol=tolerance, atol=tolerance)
        solver = kind(root_finder=newton, root_find_max_steps=50)

    @jax.jit
    def first(y, ask):
        return pack(y), solver.init(terms, 0.0, ask[3], pack(y), ask), jnp.bool_(False)

    def step(i, carry, ask):
        y, state, fault = carry
        y, _, _, state, result = solver.step(
            terms, i * ask[3], (i + 1) * ask[3], y, ask, state, made_jump=False)
        return y, state, fault | (result != dx.RESULTS.successful)

    advance = in_rows(jax, step, lambda carry: jnp.stack(carry[0]))

    def run(rate, y, h, steps, every):
        ask = tuple(map(jnp.float64, (rate.g_over_l, rate.amplitude, rate.frequency, h)))
        (_, _, fault), found = advance(first(jnp.array(y), ask), steps, every, ask)
        if fault:
            raise RuntimeError("the solver's inner iteration did not converge")
        return found

    return dict(run=run)


def in_rows(jax, step, row, most=4096):
    """Of `step(i, carry, ask)` a function of the carry at the start, n, k and what is asked, which
    returns the carry at the end and `row(carry)` after k, 2k, ... n steps. Compiled once: a call of
    compiled code gives back `most` rows."""

    @jax.jit
    def rows(carry, start, count, k, ask):
        def one(j, both):
            inner, out = both
            i = start + j * k
            inner = jax.lax.fori_loop(i, i + k, lambda i, carry: step(i, carry, ask), inner)
            return inner, out.at[j].set(row(inner))

        return jax.lax.fori_loop(0, count, one, (carry, jax.numpy.zeros((most, 2))))

    def advance(carry, n, k, ask):
        found = []
        while len(found) < n // k:
            count = min(most, n // k - len(found))
            carry, out = rows(carry, len(found) * k, count, k, ask)
            found += out[:count].tolist()
        return carry, found

    return advance


def heyoka(name):
    """Fixed steps: the Taylor series is computed by step(write_tc=True) and summed at h by
    update_d_output; taylor-P is the order P that heyoka takes for a certain tolerance. Nobody
    counts evaluations: there are none."""
    import heyoka as hy

    x, v = hy.make_vars("x", "v")
    order = int(name.removeprefix("taylor"))
    # A tolerance for which it chooses this order.
    tol = next(tol for tol in (10 ** (-exponent / 10) for exponent in range(1, 161))
               if hy.taylor_adaptive([(x, v), (v, -x)], [0.0, 0.0], tol=tol).order == order)
    g, a, w = hy.par[0], hy.par[1], hy.par[2]
    fall = a * hy.cos(w * hy.time) - g * hy.sin(x)
    method = hy.taylor_adaptive([(x, v), (v, fall)], [0.0, 0.0], pars=[1.0, 0.0, 1.0], tol=tol)

    def walk(rate, t, y, h):
        method.pars[:] = rate.g_over_l, rate.amplitude, rate.frequency
        method.state[:] = y
        i = 0
        while True:
            # The Taylor series at i h, summed at (i + 1) h, whatever step the tolerance would like.
            start = i * h
            method.time = start
            method.step(max_delta_t=h, write_tc=True)
            method.state[:] = method.update_d_output(h - (method.time - start), rel_time=True)
            i += 1
            yield method.state

    return dict(rate=walk)


def gala(name):
    """Fixed steps: integrator(w0, dt=h, n_steps=n). DOPRI853Integrator is SciPy's and chooses its
    own steps."""
    import numpy as np
    from gala import integrate

    def run(rate, y, h, steps, every):
        def field(t, w):
            return np.array([w[1], [rate.acceleration(w[0, 0], t)]])

        orbit = getattr(integrate, name)(field)(y, dt=h, n_steps=steps)
        states = zip(orbit.pos.xyz.value.ravel(), orbit.vel.d_xyz.value.ravel())
        return list(states)[every::every]

    return dict(run=run, state=np.array)
