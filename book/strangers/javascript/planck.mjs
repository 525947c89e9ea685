// planck 1.5.0. One body without damping or gravity; its x is the angle. A step that is not positive
// does nothing (World.step: `timeStep > 0.0`), so the way back cannot be asked.
import { CircleShape, Settings, Vec2, World } from "planck";
import { serve } from "./protocol.mjs";

Settings.maxTranslation = 1e9; // the default stops a body at 2 units a step

function world(pendulum, theta, omega, h, n, kept) {
  if (h < 0) throw new Error("planck does not step back");
  const world = new World({ gravity: new Vec2(0, 0), allowSleep: false });
  const body = world.createBody({ type: "dynamic", position: new Vec2(theta, 0), linearVelocity: new Vec2(omega, 0), linearDamping: 0 });
  body.createFixture(new CircleShape(1), { density: 1 });
  for (let i = 0; i < n; i++) {
    body.applyForceToCenter(new Vec2(body.getMass() * pendulum.force(body.getPosition().x, i * h), 0), true);
    world.step(h);
    kept(body.getPosition().x, body.getLinearVelocity().x);
  }
}

serve({ "World.step": world }, { drives: true });
