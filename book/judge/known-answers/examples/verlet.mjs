import { readFileSync } from "node:fs";
function step(force, theta, omega, t, h) {  // yours; here kick, drift, kick
  const half = omega + h / 2 * force(theta, t), there = theta + h * half;
  return [there, half + h / 2 * force(there, t + h)];
}
const known = JSON.parse(readFileSync("known-answers.json"));
for (const answer of known.methods.find(m => m.name === "stormer-verlet").answers) {
  const [g, a, w, t, h, ...start] = ["g_over_l", "amplitude", "frequency", "t", "h", "theta",
    "omega"].map(key => Number(known.scenes[answer.scene][key]));
  const force = (theta, t) => a * Math.cos(w * t) - g * Math.sin(theta);
  let state = start, right = [Number(answer.theta), Number(answer.omega)];
  for (let n = 0; n < answer.steps; n++) state = step(force, ...state, t + n * h, h);
  const bound = answer.tolerance * 2 ** -52 * Math.max(...right.map(Math.abs));
  const good = state.every((x, i) => Math.abs(x - right[i]) <= bound);
  if (!good) throw Error(`${answer.scene}, ${answer.steps} steps: ${state}, not ${right}`);
}
