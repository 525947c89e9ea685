// p2-es 1.2.3. One body of mass 1 without damping or gravity; its x is the angle. The library keeps
// its vectors in single precision unless the global P2_ARRAY_TYPE is Array before it is loaded.
import { serve } from "./protocol.mjs";

if (process.argv[2] === "World.step/Array") globalThis.P2_ARRAY_TYPE = Array;
const { Body, World } = await import("p2-es");

function world(pendulum, theta, omega, h, n, kept) {
  const world = new World({ gravity: [0, 0] });
  world.applyDamping = false;
  const body = new Body({ mass: 1, position: [theta, 0], velocity: [omega, 0], damping: 0, angularDamping: 0 });
  world.addBody(body);
  for (let i = 0; i < n; i++) {
    body.force[0] = pendulum.force(body.position[0], i * h);
    world.step(h);
    kept(body.position[0], body.velocity[0]);
  }
}

serve({ "World.step": world, "World.step/Array": world }, { drives: true });
