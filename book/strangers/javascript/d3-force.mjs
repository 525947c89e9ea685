// d3-force 3.0.1. The simulation's unit of time is one tick, so velocities are per tick (omega h)
// and the force adds h^2 times the acceleration; no decay, no alpha.
import { forceSimulation } from "d3-force";
import { serve } from "./protocol.mjs";

function simulation(pendulum, theta, omega, h, n, kept) {
  const node = { x: theta, y: 0, vx: omega * h, vy: 0 };
  let t = 0;
  const simulation = forceSimulation([node])
    .stop()
    .velocityDecay(0)
    .alphaDecay(0)
    .force("pendulum", () => {
      node.vx += h * h * pendulum.force(node.x, t);
    });
  for (let i = 0; i < n; i++) {
    t = i * h;
    simulation.tick();
    kept(node.x, node.vx / h);
  }
}

serve({ forceSimulation: simulation }, { drives: true });
