// Integrators of JavaScript's libraries as strangers, protocol 1 of `pendula verify`:
//
//     node stranger.mjs LIBRARY INTEGRATOR
//
// An adapter starts a run: of theta'' = -gl sin theta + a cos(w t), from a state and with a step h,
// it makes a function that takes step i, from i h to (i + 1) h, and returns the state.
import { createInterface } from "node:readline";

const [library, name] = process.argv.slice(2);

const ADAPTERS = {
  // One body of mass 1 without damping or gravity; its x is the angle.
  async "cannon-es"() {
    const { Body, Vec3, World } = await import("cannon-es");
    return ({ force, theta, omega, h }) => {
      const world = new World();
      const place = { position: new Vec3(theta, 0, 0), velocity: new Vec3(omega, 0, 0) };
      const body = new Body({ mass: 1, linearDamping: 0, ...place });
      world.addBody(body);
      return (i) => {
        body.force.x = force(body.position.x, i * h);
        world.step(h);
        return [body.position.x, body.velocity.x];
      };
    };
  },

  // The simulation's unit of time is one tick, so velocities are per tick (omega h) and the force
  // adds h^2 times the acceleration; no decay, no alpha.
  async "d3-force"() {
    const { forceSimulation } = await import("d3-force");
    return ({ force, theta, omega, h }) => {
      const node = { x: theta, y: 0, vx: omega * h, vy: 0 };
      const simulation = forceSimulation([node]).stop().velocityDecay(0).alphaDecay(0);
      let t = 0;
      simulation.force("pendulum", () => {
        node.vx += h * h * force(node.x, t);
      });
      return (i) => {
        t = i * h;
        simulation.tick();
        return [node.x, node.vx / h];
      };
    };
  },

  // One body without air friction, collisions or gravity; its x is the angle. The engine counts
  // time in ms; its velocities are per 1000/60 ms. A step that is not positive moves nothing
  // (Engine.update: `delta > 0`), so the way back cannot be asked.
  async "matter-js"() {
    const { Bodies, Body, Composite, Common, Engine, Events } = (await import("matter-js")).default;
    const base = 1 / 60;
    Common.logLevel = 0;
    return ({ force, theta, omega, h }) => {
      if (h < 0) throw new Error("matter-js does not step back");
      const engine = Engine.create({ gravity: { scale: 0 } });
      const body = Bodies.circle(theta, 0, 1, { frictionAir: 0, mass: 1 });
      Body.setVelocity(body, { x: omega * base, y: 0 });
      Composite.add(engine.world, body);
      let t = 0;
      Events.on(engine, "beforeUpdate", () => {
        body.force.x = (force(body.position.x, t) * body.mass) / 1e6;
      });
      return (i) => {
        t = i * h;
        Engine.update(engine, 1000 * h);
        return [body.position.x, Body.getVelocity(body).x / base];
      };
    };
  },

  // One body of mass 1 without damping or gravity; its x is the angle. The library keeps its
  // vectors in single precision unless the global P2_ARRAY_TYPE is Array before it is loaded.
  async "p2-es"() {
    if (name === "World.step/Array") globalThis.P2_ARRAY_TYPE = Array;
    const { Body, World } = await import("p2-es");
    return ({ force, theta, omega, h }) => {
      const world = new World({ gravity: [0, 0] });
      world.applyDamping = false;
      const place = { position: [theta, 0], velocity: [omega, 0] };
      const body = new Body({ mass: 1, damping: 0, angularDamping: 0, ...place });
      world.addBody(body);
      return (i) => {
        body.force[0] = force(body.position[0], i * h);
        world.step(h);
        return [body.position[0], body.velocity[0]];
      };
    };
  },

  // One body without damping or gravity; its x is the angle. A step that is not positive does
  // nothing (World.step: `timeStep > 0.0`), so the way back cannot be asked.
  async planck() {
    const { CircleShape, Settings, Vec2, World } = await import("planck");
    Settings.maxTranslation = 1e9; // the default stops a body at 2 units a step
    return ({ force, theta, omega, h }) => {
      if (h < 0) throw new Error("planck does not step back");
      const world = new World({ gravity: new Vec2(0, 0), allowSleep: false });
      const place = { position: new Vec2(theta, 0), linearVelocity: new Vec2(omega, 0) };
      const body = world.createBody({ type: "dynamic", linearDamping: 0, ...place });
      body.createFixture(new CircleShape(1), { density: 1 });
      return (i) => {
        const push = body.getMass() * force(body.getPosition().x, i * h);
        body.applyForceToCenter(new Vec2(push, 0), true);
        world.step(h);
        return [body.getPosition().x, body.getLinearVelocity().x];
      };
    };
  },

  // ode-euler, ode-midpoint, ode-rk4, and ode45-cash-karp, which is held to fixed steps by a
  // tolerance that nothing exceeds and by setting dt before each step.
  async scijs() {
    const create = (await import(name)).default;
    return ({ force, theta, omega, h }) => {
      const rate = (dy, y, t) => {
        dy[0] = y[1];
        dy[1] = force(y[0], t);
      };
      const integrator = create([theta, omega], rate, 0, h, { tol: Infinity, verbose: false });
      return () => {
        integrator.dt = h;
        integrator.step();
        return integrator.y;
      };
    };
  },
};

function answer([verb, ...numbers], start) {
  if (verb === "hello") return `hello 1 ${name}\n`;
  const driven = verb === "driven";
  if (verb !== "pendulum" && !driven) return "unsupported\n";
  const x = numbers.map(Number);
  if (x.length !== (driven ? 8 : 6) || x.some(Number.isNaN)) return "error wrong numbers\n";
  const [gl, a, w] = driven ? x.splice(0, 3) : [...x.splice(0, 1), 0, 0];
  const [theta, omega, h, n, k] = x;
  if (!(n > 0 && k > 0 && n % k === 0)) return "error k must divide n\n";
  let forces = 0;
  const force = (theta, t) => {
    forces++;
    const f = -gl * Math.sin(theta);
    return a === 0 ? f : f + a * Math.cos(w * t);
  };
  let text = "";
  try {
    const step = start({ force, theta, omega, h });
    for (let i = 0; i < n; i++) {
      const [theta, omega] = step(i);
      if ((i + 1) % k === 0) text += `${theta} ${omega}\n`;
    }
  } catch (error) {
    return `error ${error.message}\n`;
  }
  return `${text}done ${forces}\n`;
}

const start = await ADAPTERS[library]();
createInterface({ input: process.stdin }).on("line", (line) => {
  const words = line.trim().split(/\s+/);
  if (words[0] === "bye") process.exit(0);
  process.stdout.write(answer(words, start));
});
