// ode-euler 1.0.6, ode-midpoint 1.0.6, ode-rk4 1.1.3 and ode45-cash-karp 1.1.0, which is held to
// fixed steps by a tolerance that nothing exceeds and by setting dt before each step.
import cashKarp from "ode45-cash-karp";
import euler from "ode-euler";
import midpoint from "ode-midpoint";
import rk4 from "ode-rk4";
import { serve } from "./protocol.mjs";

const fixed = (create) => (pendulum, theta, omega, h, n, kept) => {
  const derivative = (dy, y, t) => {
    dy[0] = y[1];
    dy[1] = pendulum.force(y[0], t);
  };
  const integrator = create([theta, omega], derivative, 0, h, { tol: Infinity, verbose: false });
  for (let i = 0; i < n; i++) {
    integrator.dt = h;
    integrator.step();
    kept(integrator.y[0], integrator.y[1]);
  }
};

serve(
  {
    "ode-euler": fixed(euler),
    "ode-midpoint": fixed(midpoint),
    "ode-rk4": fixed(rk4),
    "ode45-cash-karp": fixed(cashKarp),
  },
  { drives: true },
);
