"""Libraries that integrate y' = f(t, y), with y the angle and the velocity."""


def scipy(name):
    """Fixed steps: rtol = atol = infinity, so no error is too large; first_step = max_step = |h|,
    and h_abs is set to |h| before each step. The adapter checks the length of every step."""
    import numpy as np
    from scipy import integrate

    free = dict(rtol=np.inf, atol=np.inf)

    def solve(ask):
        h, y = ask.h, np.array([ask.theta, ask.omega])
        method = getattr(integrate, name)(
            lambda t, y: np.array(ask.rate(t, y)), 0.0, y, np.inf * h,
            first_step=abs(h), max_step=abs(h), **free)
        # No tolerance: the error never asks for a shorter step, and max_step is h. The solver's
        # estimate of the next step is held at h besides.

        def step(i, state):
            method.h_abs = abs(h)
            method.step()
            if method.step_size != abs((method.t_old + h) - method.t_old):
                raise RuntimeError(f"took a step of {method.step_size}")
            return method.y

        return ask.steps(y, step)

    return solve


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

    def solve(ask):
        # An implicit method asked for a step back takes a longer one, a minimum of negative
        # numbers (integrator_types.py, line 206); it is asked for a step ahead of the mirrored
        # equation, which is the same by definition.
        sign = -1.0 if implicit and ask.h < 0 else 1.0

        def field(t, y):
            return sign * np.array(ask.rate(sign * t, y))

        field.jac = lambda t, y: sign * np.array([[0.0, 1.0], [-ask.g * np.cos(y[0]), 0.0]])
        field = de.DiffRHS(field, equ_repr="pendulum", md_repr="pendulum")
        h = np.float64(sign * ask.h)
        method = kind((2,), np.dtype("float64"), rtol=tolerance, atol=tolerance)
        method.is_adaptive = True  # switches the control of the step off

        def step(i, y):
            _, (took, change) = method(field, np.float64(i * h), y, {}, h)
            if took != h:
                raise RuntimeError(f"took a step of {took}, not {h}")
            return y + change

        return ask.steps(np.array([ask.theta, ask.omega]), step)

    return solve


def diffrax(name):
    """Fixed steps: solver.step under jax.jit, in a loop of XLA, from i h to (i + 1) h. Nobody
    counts evaluations in compiled code. The implicit solvers get optimistix.Newton, as their
    documentation allows, since with the default chord iteration the inner error is that of its
    tolerance."""
    import diffrax
    import jax
    import jax.numpy as jnp
    import optimistix

    jax.config.update("jax_enable_x64", True)
    tolerance = 1e-13  # of the implicit methods' inner iteration

    def force(t, x, ask):
        g, a, w, _ = ask
        return a * jnp.cos(w * t) - g * jnp.sin(x)

    def build():
        """The solver, its terms, and how it holds (theta, omega)."""
        ode = diffrax.ODETerm
        if name == "SemiImplicitEuler":
            terms = (ode(lambda t, v, ask: v), ode(force))
            return diffrax.SemiImplicitEuler(), terms, tuple
        kind = getattr(diffrax, name)
        if name in ("Sil3", "KenCarp3", "KenCarp4", "KenCarp5"):
            terms = diffrax.MultiTerm(
                ode(lambda t, y, ask: jnp.stack([0.0 * t, force(t, y[0], ask)])),
                ode(lambda t, y, ask: jnp.stack([y[1], 0.0 * t])))
        else:
            terms = ode(lambda t, y, ask: jnp.stack([y[1], force(t, y[0], ask)]))
        if not issubclass(kind, diffrax.AbstractImplicitSolver):
            return kind(), terms, jnp.stack
        newton = optimistix.Newton(rtol=tolerance, atol=tolerance)
        return kind(root_finder=newton, root_find_max_steps=50), terms, jnp.stack

    solver, terms, pack = build()

    @jax.jit
    def first(y, ask):
        return solver.init(terms, 0.0, ask[3], pack(y), ask)

    @jax.jit
    def advance(y, state, fault, start, rows, k, ask):
        """The next `rows` states, k steps apart, from step `start` on."""
        h = ask[3]

        def step(i, carry):
            y, state, fault = carry
            y, _, _, state, result = solver.step(
                terms, i * h, (i + 1) * h, y, ask, state, made_jump=False)
            return y, state, fault | (result != diffrax.RESULTS.successful)

        def row(j, carry):
            inner, out = carry
            i = start + j * k
            inner = jax.lax.fori_loop(i, i + k, step, inner)
            return inner, out.at[j].set(jnp.stack(inner[0]))

        carry = (pack(y), state, fault), jnp.zeros((ROWS, 2))
        (y, state, fault), out = jax.lax.fori_loop(0, rows, row, carry)
        return jnp.stack(y), state, fault, out

    def solve(ask):
        values = tuple(jnp.float64(x) for x in (ask.g, ask.a, ask.w, ask.h))
        y, fault, found = jnp.array([ask.theta, ask.omega]), jnp.bool_(False), []
        state = first(y, values)
        for done, rows in pieces(ask):
            y, state, fault, out = advance(y, state, fault, done * ask.k, rows, ask.k, values)
            found += out[:rows].tolist()
        if fault:
            raise RuntimeError("the solver's inner iteration did not converge")
        return found

    return solve


ROWS = 4096  # states that a call of compiled code gives back at most


def pieces(ask):
    """Of all states that are asked for, so many at a time: how many are done, and the next."""
    total = ask.n // ask.k
    return [(done, min(ROWS, total - done)) for done in range(0, total, ROWS)]


def heyoka(name):
    """Fixed steps: the Taylor series is computed by step(write_tc=True) and summed at h by
    update_d_output; taylor-P is the order P that heyoka takes for a certain tolerance. Nobody
    counts evaluations: there are none."""
    import heyoka as hy

    x, v = hy.make_vars("x", "v")

    def adaptive(equations, **options):
        return hy.taylor_adaptive(equations, [0.0, 0.0], **options)

    def tolerance(order):
        """A tolerance for which heyoka chooses this order."""
        for exponent in range(1, 161):
            tol = 10 ** (-exponent / 10)
            if adaptive([(x, v), (v, -x)], tol=tol).order == order:
                return tol
        raise ValueError(f"no tolerance gives order {order}")

    g, a, w = hy.par[0], hy.par[1], hy.par[2]
    fall = a * hy.cos(w * hy.time) - g * hy.sin(x)
    method = adaptive(
        [(x, v), (v, fall)], pars=[1.0, 0.0, 1.0],
        tol=tolerance(int(name.removeprefix("taylor"))))

    def solve(ask):
        h = ask.h
        method.pars[:] = ask.g, ask.a, ask.w
        method.state[:] = ask.theta, ask.omega
        method.time = 0.0

        def step(i, _):
            # The Taylor series at i h, summed at (i + 1) h, whatever step the tolerance would like.
            start = i * h
            method.time = start
            method.step(max_delta_t=h, write_tc=True)
            method.state[:] = method.update_d_output(h - (method.time - start), rel_time=True)
            return method.state

        return ask.steps(None, step)

    return solve


def gala(name):
    """Fixed steps: integrator(w0, dt=h, n_steps=n). DOPRI853Integrator is SciPy's and chooses its
    own steps."""
    import numpy as np
    from gala import integrate

    def solve(ask):
        method = getattr(integrate, name)(lambda t, w: np.array([w[1], [ask.force(t, w[0, 0])]]))
        orbit = method(np.array([ask.theta, ask.omega]), dt=ask.h, n_steps=ask.n)
        x, v = orbit.pos.xyz.value.ravel(), orbit.vel.d_xyz.value.ravel()
        return list(zip(x, v))[ask.k::ask.k]

    return solve
