"""Libraries that know positions, velocities and forces."""

import math

from equations import ROWS, pieces


def ase(name):
    """One atom, its x the angle, and a calculator of our own for the force."""
    import numpy as np
    from ase import Atoms
    from ase.md import verlet

    class Fall:
        """A calculator: a force along x that depends on x alone."""

        def __init__(self, ask):
            self.ask = ask

        def get_forces(self, atoms):
            return np.array([[self.ask.force(0.0, atoms.positions[0, 0]), 0.0, 0.0]])

    def solve(ask):
        atoms = Atoms("H", positions=[[ask.theta, 0.0, 0.0]], masses=[1.0])
        atoms.set_momenta([[ask.omega, 0.0, 0.0]])
        atoms.calc = Fall(ask)
        method, forces = getattr(verlet, name)(atoms, timestep=ask.h), None

        def step(i, _):
            nonlocal forces
            forces = method.step(forces)
            return atoms.positions[0, 0], atoms.get_momenta()[0, 0]

        return ask.steps(None, step)

    return solve


def blackjax(name):
    """Fixed steps: one_step(state, h) under jax.jit; minus the potential is the log density. No
    time in the force, and nobody counts evaluations in compiled code. The fixed-point iteration is
    asked for 1e-14."""
    import jax
    import jax.numpy as jnp
    from blackjax.mcmc import integrators

    jax.config.update("jax_enable_x64", True)
    iterated = name == "implicit_midpoint"
    options = dict(convergence_tol=1e-14, max_iters=100) if iterated else {}

    def density(g):
        return lambda x: g * jnp.cos(x[0])

    def kinetic(momentum, position=None):
        return 0.5 * jnp.dot(momentum, momentum)

    @jax.jit
    def first(x, v, g):
        return integrators.new_integrator_state(density(g), x, v)

    @jax.jit
    def advance(state, rows, k, g, h):
        one_step = getattr(integrators, name)(density(g), kinetic, **options)

        def row(j, carry):
            state, out = carry
            state = jax.lax.fori_loop(0, k, lambda i, s: one_step(s, h), state)
            pair = jnp.concatenate([state.position, state.momentum])
            return state, out.at[j].set(pair)

        return jax.lax.fori_loop(0, rows, row, (state, jnp.zeros((ROWS, 2))))

    def solve(ask):
        g, h, found = jnp.float64(ask.g), jnp.float64(ask.h), []
        state = first(jnp.array([ask.theta]), jnp.array([ask.omega]), g)
        for _, rows in pieces(ask):
            state, out = advance(state, rows, ask.k, g, h)
            found += out[:rows].tolist()
        return found

    return solve


def galpy(name):
    """Fixed steps: leapfrog with rtol = atol = 1e9, which makes it take the distance of the times,
    here h. Three evaluations are spent on its estimate. The C integrators know their own potentials
    only, no pendulum."""
    import numpy as np
    from galpy.util import symplecticode

    def solve(ask):
        times = ask.h * np.arange(ask.n + 1)
        out = getattr(symplecticode, name)(
            lambda q, t=0.0: np.array([ask.force(t, q[0])]),
            np.array([ask.theta, ask.omega]), times, rtol=1e9, atol=1e9)
        return out[ask.k::ask.k].tolist()

    return solve


def mici(name):
    """Fixed steps: integrator.step(state), with the identity as the metric. No time in the force.
    The fixed-point iterations are asked for 1e-14."""
    import numpy as np
    from mici import integrators, states, systems

    iterated = name.startswith("Implicit")
    options = {"fixed_point_solver_kwargs": dict(convergence_tol=1e-14)} if iterated else {}

    def solve(ask):
        system = systems.EuclideanMetricSystem(
            neg_log_dens=lambda q: -ask.g * math.cos(q[0]),
            grad_neg_log_dens=lambda q: np.array([-ask.force(0.0, q[0])]))
        method = getattr(integrators, name)(system, step_size=ask.h, **options)
        state = states.ChainState(pos=np.array([ask.theta]), mom=np.array([ask.omega]), dir=1)

        def step(i, _):
            nonlocal state
            state = method.step(state)
            return state.pos[0], state.mom[0]

        return ask.steps(None, step)

    return solve


def mujoco(name):
    """A hinge with a point mass, MuJoCo's own joint angle, which is not wrapped; contacts and
    constraints are off. Nobody counts evaluations."""
    import mujoco

    # A point of mass 1 on a hinge, at distance 1, with a moment of inertia of its own of 1:
    # 2 theta'' = -gravity sin(theta), so gravity is twice g/L.
    model_of = """<mujoco>
      <option integrator="{}" gravity="0 0 -9.81"><flag contact="disable"
        constraint="disable" eulerdamp="disable"/></option>
      <worldbody><body><joint type="hinge" axis="0 1 0" armature="0"/>
        <inertial pos="0 0 -1" mass="1" diaginertia="1 1 1"/></body></worldbody>
    </mujoco>"""

    def solve(ask):
        model = mujoco.MjModel.from_xml_string(model_of.format(name))
        data = mujoco.MjData(model)
        model.opt.gravity[:] = 0.0, 0.0, -2.0 * ask.g
        model.opt.timestep = ask.h
        data.qpos[0], data.qvel[0] = ask.theta, ask.omega

        def step(i, _):
            mujoco.mj_step(model, data)
            if data.warning.number.any():
                raise RuntimeError("MuJoCo warned, and may have reset the state")
            return data.qpos[0], data.qvel[0]

        return ask.steps(None, step)

    return solve


def openmm(name):
    """One particle in a CustomExternalForce -g cos(x), on the Reference platform, which is in
    double precision."""
    import openmm
    from openmm import unit

    def solve(ask):
        system = openmm.System()
        system.addParticle(1.0)
        field = openmm.CustomExternalForce("-g*cos(x)")
        field.addGlobalParameter("g", ask.g)
        field.addParticle(0, [])
        system.addForce(field)
        method = getattr(openmm, name)(ask.h)
        context = openmm.Context(system, method, openmm.Platform.getPlatform("Reference"))
        context.setPositions([[ask.theta, 0.0, 0.0]])

        # The documentation: "positions and velocities stored in the context are offset from each
        # other by half a time step". The start is half a step back, and what is answered is on the
        # step.
        def half(x):
            return 0.5 * ask.h * -ask.g * math.sin(x)

        context.setVelocities([[ask.omega - half(ask.theta), 0.0, 0.0]])
        found = []
        for _ in range(ask.n // ask.k):
            method.step(ask.k)
            state = context.getState(positions=True, velocities=True)
            x = state.getPositions()[0].value_in_unit(unit.nanometer)[0]
            v = state.getVelocities()[0].value_in_unit(unit.nanometer / unit.picosecond)[0]
            found.append((x, v + half(x)))
        return found

    return solve


def pyhamsys(name):
    """Fixed steps: SymplecticIntegrator(name, h), a step a call. (integrate() changes h to a
    divisor of the interval of its own, and cannot go back.) Kicks that follow each other at one
    place are counted as the library asks for them, twice."""
    from pyhamsys.pyhamsys import SymplecticIntegrator

    def solve(ask):
        def kick(h, t, y):
            return y[0], y[1] + float(h) * ask.force(t, y[0])

        def drift(h, y):
            return y[0] + float(h) * y[1], y[1]

        # H = A(p) + B(q), A the drift and B the kick. The documentation asks for exp(h X_B)
        # exp(h X_A) with these: the kick acts first; with the others the drift. `chi` is told the
        # time at its end, `chi_star` that at its start; the time itself moves on with the drift.
        if name in ("VEFRL", "RKN4b", "RKN6b"):
            def chi(h, t, y):
                return drift(h, kick(h, t - h, y))

            def chi_star(h, t, y):
                return kick(h, t + h, drift(h, y))
        else:
            def chi(h, t, y):
                return kick(h, t, drift(h, y))

            def chi_star(h, t, y):
                return drift(h, kick(h, t, y))

        method = SymplecticIntegrator(name, ask.h)

        def step(i, y):
            return method._integrate_onestep(i * ask.h, y, chi, chi_star)[1]

        return ask.steps((ask.theta, ask.omega), step)

    return solve


def rebound(name):
    """The pendulum: one particle without gravity, its x the angle, and the force a function of
    additional_forces. ias15 with epsilon = 0; leapfrog:4 is leapfrog with order = 4. EOS supports
    the BASIC gravity routine only, as it warns; WHFast and SABA split off Kepler's orbits, SEI an
    epicycle; BS chooses its own steps."""
    import rebound

    integrator, _, order = name.partition(":")

    def solve(ask):
        sim = rebound.Simulation()
        sim.G = 0.0
        sim.integrator = integrator
        if order:
            sim.integrator.order = int(order)
        if integrator == "ias15":
            sim.integrator.epsilon = 0.0
        sim.gravity = "none"
        sim.add(m=1.0, x=ask.theta, vx=ask.omega)
        one = sim.particles[0]

        def push(_):
            one.ax += ask.force(sim.t, one.x)

        sim.additional_forces = push
        sim.dt = ask.h
        found = []
        for _ in range(ask.n // ask.k):
            sim.steps(ask.k)
            if sim.dt != ask.h:
                raise RuntimeError(f"the step became {sim.dt}")
            sim.synchronize()
            found.append((one.x, one.vx))
        return found

    return solve


def symplecta(name):
    """Fixed steps: solve_symplectic_ivp with n_steps. symplectic_euler:pq and :qp are its two
    variants. shake and rattle are for constraints."""
    import numpy as np
    from symplecta import solve_symplectic_ivp

    method, _, variant = name.partition(":")
    options = {"variant": variant} if variant else {}
    if method == "implicit_midpoint":
        options["tol"] = 1e-14

    def solve(ask):
        if method == "implicit_midpoint":
            system = dict(dHdq=lambda t, q, p: np.array([-ask.force(t, q[0])]),
                          dHdp=lambda t, q, p: p)
        else:
            system = dict(force=lambda t, q: np.array([ask.force(t, q[0])]))
        result = solve_symplectic_ivp(
            (0.0, ask.n * ask.h), [ask.theta], [ask.omega], n_steps=ask.n, method=method,
            **system, **options)
        if not result.success:
            raise RuntimeError(result.message)
        return list(zip(result.q[0], result.p[0]))[ask.k::ask.k]

    return solve
