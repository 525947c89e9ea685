// The judge's text protocol, version 1: one integrator a program.
import { createInterface } from "node:readline";

// theta'' = -gl sin theta + a cos(w t); `forces` counts its evaluations.
class Pendulum {
  forces = 0;
  constructor(gl, a = 0, w = 0) {
    Object.assign(this, { gl, a, w });
  }
  force(theta, t) {
    this.forces++;
    const f = -this.gl * Math.sin(theta);
    return this.a === 0 ? f : f + this.a * Math.cos(this.w * t);
  }
}

function answer(words, integrate, drives) {
  const [verb, ...numbers] = words;
  const driven = verb === "driven" && drives;
  if (verb !== "pendulum" && !driven) return "unsupported\n";
  const x = numbers.map(Number);
  if (x.length !== (driven ? 8 : 6) || x.some(Number.isNaN)) return "error wrong numbers\n";
  const pendulum = new Pendulum(...(driven ? x.splice(0, 3) : x.splice(0, 1)));
  const [theta, omega, h, n, k] = x;
  if (!(n > 0 && k > 0 && n % k === 0)) return "error k must divide n\n";
  let text = "";
  let step = 0;
  try {
    // `kept` is to be called once after each step.
    integrate(pendulum, theta, omega, h, n, (theta, omega) => {
      if (++step % k === 0) text += `${theta} ${omega}\n`;
    });
  } catch (error) {
    return `error ${error.message}\n`;
  }
  return `${text}done ${pendulum.forces}\n`;
}

// integrators: from names to functions (pendulum, theta, omega, h, n, kept).
// drives: do they know the time of their stages?
export function serve(integrators, { drives }) {
  const name = process.argv[2];
  const integrate = integrators[name];
  if (!integrate) {
    console.log(Object.keys(integrators).join("\n"));
    process.exit(2);
  }
  createInterface({ input: process.stdin }).on("line", (line) => {
    const words = line.trim().split(/\s+/);
    if (words[0] === "bye") process.exit(0);
    process.stdout.write(words[0] === "hello" ? `hello 1 ${name}\n` : answer(words, integrate, drives));
  });
}
