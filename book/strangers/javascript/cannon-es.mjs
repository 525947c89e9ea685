// cannon-es 0.20.0. One body of mass 1 without damping or gravity; its x is the angle.
import { Body, Vec3, World } from "cannon-es";
import { serve } from "./protocol.mjs";

function world(pendulum, theta, omega, h, n, kept) {
  const world = new World();
  const body = new Body({ mass: 1, linearDamping: 0, position: new Vec3(theta, 0, 0), velocity: new Vec3(omega, 0, 0) });
  world.addBody(body);
  for (let i = 0; i < n; i++) {
    body.force.x = pendulum.force(body.position.x, i * h);
    world.step(h);
    kept(body.position.x, body.velocity.x);
  }
}

serve({ "World.step": world }, { drives: true });
