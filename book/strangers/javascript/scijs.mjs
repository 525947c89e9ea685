// ode-euler 1.0.6, ode-midpoint 1.0.6, ode-rk4 1.1.3 and ode45-cash-karp 1.1.0, which is held to
// fixed steps by a tolerance that nothing exceeds and by setting dt before each step.
// Claims, as quoted from that version:
//   ode-euler: order=1 name=forward-euler. “Integrate a system of ODEs using the Euler method”
//     (ode-euler/README.md:3)
//   ode-midpoint: order=2 name=explicit-midpoint. “Integrate a system of ODEs using the Second Order
//     Runge-Kutta (Midpoint) method” (ode-midpoint/README.md:3)
//   ode-rk4: order=4 name=rk4. “Integrate a system of ODEs using the Fourth Order Runge-Kutta (RK-4) method”
//     (ode-rk4/README.md:3)
//   ode45-cash-karp: order=5. “Integrate a system of Ordinary Differential Equations using the Fifth Order
//     Adaptive Cash-Karp method” (ode45-cash-karp/README.md:3)
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
