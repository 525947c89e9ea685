// matter-js 0.20.0. One body without air friction, collisions or gravity; its x is the angle.
// The engine counts time in ms; its velocities are per 1000/60 ms. A step that is not positive moves
// nothing (Engine.update: `delta > 0`), so the way back cannot be asked.
import Matter from "matter-js";
import { serve } from "./protocol.mjs";

const { Bodies, Body, Composite, Common, Engine, Events } = Matter;
const base = 1 / 60;
Common.logLevel = 0;

function engine(pendulum, theta, omega, h, n, kept) {
  if (h < 0) throw new Error("matter-js does not step back");
  const engine = Engine.create({ gravity: { scale: 0 } });
  const body = Bodies.circle(theta, 0, 1, { frictionAir: 0, mass: 1 });
  Body.setVelocity(body, { x: omega * base, y: 0 });
  Composite.add(engine.world, body);
  let t = 0;
  Events.on(engine, "beforeUpdate", () => {
    body.force.x = (pendulum.force(body.position.x, t) * body.mass) / 1e6;
  });
  for (let i = 0; i < n; i++) {
    t = i * h;
    Engine.update(engine, 1000 * h);
    kept(body.position.x, Body.getVelocity(body).x / base);
  }
}

serve({ "Engine.update": engine }, { drives: true });
