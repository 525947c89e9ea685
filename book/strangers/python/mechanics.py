"""Libraries that know positions, velocities and forces."""

import math

from equations import in_rows


def ase(name):
    """One atom, its x the angle, and a calculator of our own for the force."""
    import numpy as np
    from ase import Atoms
    from ase.md import verlet

    class Fall:
        """A calculator: a force along x that depends on x alone."""

        def __init__(self, force):
            self.force = force

        def get_forces(self, atoms):
            return np.array([[self.force(atoms.positions[0, 0]), 0.0, 0.0]])

    def walk(force, theta, omega, h):
        atoms = Atoms("H", positions=[[theta, 0.0, 0.0]], masses=[1.0])
        atoms.set_momenta([[omega, 0.0, 0.0]])
        atoms.calc = Fall(force)
        method, forces = getattr(verlet, name)(atoms, timestep=h), None
        while True:
            forces = method.step(forces)
            yield atoms.positions[0, 0], atoms.get_momenta()[0, 0]

    return dict(method=walk)


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

    def step(i, state, ask):
        g, h = ask
        return getattr(integrators, name)(density(g), kinetic, **options)(state, h)

    advance = in_rows(jax, step, lambda it: jnp.concatenate([it.position, it.momentum]))

    def run(rate, y, h, steps, every):
        ask = jnp.float64(rate.g_over_l), jnp.float64(h)
        state = first(jnp.array([y[0]]), jnp.array([y[1]]), ask[0])
        return advance(state, steps, every, ask)[1]

    return dict(run=run, driven=False)


def galpy(name):
    """Fixed steps: leapfrog with rtol = atol = 1e9, which makes it take the distance of the times,
    here h. Three evaluations are spent on its estimate. The C integrators know their own potentials
    only, no pendulum."""
    import numpy as np
    from galpy.util import symplecticode

    def run(rate, y, h, steps, every):
        def force(q, t=0.0):
            return np.array([rate.acceleration(q[0], t)])

        times = h * np.arange(steps + 1)
        out = getattr(symplecticode, name)(force, y, times, rtol=1e9, atol=1e9)
        return out[every::every]

    return dict(run=run, state=np.array)


def mici(name):
    """Fixed steps: integrator.step(state), with the identity as the metric. No time in the force.
    The fixed-point iterations are asked for 1e-14."""
    import numpy as np
    from mici import integrators, states, systems

    iterated = name.startswith("Implicit")
    options = {"fixed_point_solver_kwargs": dict(convergence_tol=1e-14)} if iterated else {}

    def walk(force, theta, omega, h):
        system = systems.EuclideanMetricSystem(
            neg_log_dens=lambda q: -force.g_over_l * math.cos(q[0]),
            grad_neg_log_dens=lambda q: np.array([-force(q[0])]))
        method = getattr(integrators, name)(system, step_size=h, **options)
        state = states.ChainState(pos=np.array([theta]), mom=np.array([omega]), dir=1)
        while True:
            state = method.step(state)
            yield state.pos[0], state.mom[0]

    return dict(method=walk)


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

    def walk(force, theta, omega, h):
        model = mujoco.MjModel.from_xml_string(model_of.format(name))
        data = mujoco.MjData(model)
        model.opt.gravity[:] = 0.0, 0.0, -2.0 * force.g_over_l
        model.opt.timestep = h
        data.qpos[0], data.qvel[0] = theta, omega
        while True:
            mujoco.mj_step(model, data)
            if data.warning.number.any():
                raise RuntimeError("MuJoCo warned, and may have reset the state")
            yield data.qpos[0], data.qvel[0]

    return dict(method=walk)


def openmm(name):
    """One particle in a CustomExternalForce -g cos(x), on the Reference platform, which is in
    double precision."""
    import openmm
    from openmm import unit

    def run(rate, y, h, steps, every):
        system = openmm.System()
        system.addParticle(1.0)
        field = openmm.CustomExternalForce("-g*cos(x)")
        field.addGlobalParameter("g", rate.g_over_l)
        field.addParticle(0, [])
        system.addForce(field)
        method = getattr(openmm, name)(h)
        context = openmm.Context(system, method, openmm.Platform.getPlatform("Reference"))
        context.setPositions([[y[0], 0.0, 0.0]])

        # The documentation: "positions and velocities stored in the context are offset from each
        # other by half a time step". The start is half a step back, and what is answered is on the
        # step.
        def half(x):
            return 0.5 * h * -rate.g_over_l * math.sin(x)

        context.setVelocities([[y[1] - half(y[0]), 0.0, 0.0]])
        for _ in range(steps // every):
            method.step(every)
            state = context.getState(positions=True, velocities=True)
            x = state.getPositions()[0].value_in_unit(unit.nanometer)[0]
            v = state.getVelocities()[0].value_in_unit(unit.nanometer / unit.picosecond)[0]
            yield x, v + half(x)

    return dict(run=run, driven=False)


def pyhamsys(name):
    """Fixed steps: SymplecticIntegrator(name, h), a step a call. (integrate() changes h to a
    divisor of the interval of its own, and cannot go back.) Kicks that follow each other at one
    place are counted as the library asks for them, twice."""
    from pyhamsys.pyhamsys import SymplecticIntegrator

    def walk(force, theta, omega, t, h):
        def kick(h, t, y):
            return y[0], y[1] + float(h) * force(y[0], t)

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

        method, y, i = SymplecticIntegrator(name, h), (theta, omega), 0
        while True:
            y, i = method._integrate_onestep(i * h, y, chi, chi_star)[1], i + 1
            yield y

    return dict(method=walk)


def rebound(name):
    """The pendulum: one particle without gravity, its x the angle, and the force a function of
    additional_forces. ias15 with epsilon = 0; leapfrog:4 is leapfrog with order = 4. EOS supports
    the BASIC gravity routine only, as it warns; WHFast and SABA split off Kepler's orbits, SEI an
    epicycle; BS chooses its own steps."""
    import rebound

    integrator, _, order = name.partition(":")

    def run(rate, y, h, steps, every):
        sim = rebound.Simulation()
        sim.G, sim.gravity, sim.integrator = 0.0, "none", integrator
        if order:
            sim.integrator.order = int(order)
        if integrator == "ias15":
            sim.integrator.epsilon = 0.0
        sim.add(m=1.0, x=y[0], vx=y[1])
        one = sim.particles[0]

        def push(_):
            one.ax += rate.acceleration(one.x, sim.t)

        sim.additional_forces, sim.dt = push, h
        for _ in range(steps // every):
            sim.steps(every)
            if sim.dt != h:
                raise RuntimeError(f"the step became {sim.dt}")
            sim.synchronize()
            yield one.x, one.vx

    return dict(run=run)


def symplecta(name):
    """Fixed steps: solve_symplectic_ivp with n_steps. symplectic_euler:pq and :qp are its two
    variants. shake and rattle are for constraints."""
    import numpy as np
    from symplecta import solve_symplectic_ivp

    method, _, variant = name.partition(":")
    options = {"variant": variant} if variant else {}
    if method == "implicit_midpoint":
        options["tol"] = 1e-14

    def run(rate, y, h, steps, every):
        system = dict(force=lambda t, q: np.array([rate.acceleration(q[0], t)]))
        if method == "implicit_midpoint":
            system = dict(dHdq=lambda t, q, p: np.array([-rate.acceleration(q[0], t)]),
                          dHdp=lambda t, q, p: p)
        result = solve_symplectic_ivp((0.0, steps * h), y[:1], y[1:], n_steps=steps,
                                      method=method, **system, **options)
        if not result.success:
            raise RuntimeError(result.message)
        return list(zip(result.q[0], result.p[0]))[every::every]

    return dict(run=run)
