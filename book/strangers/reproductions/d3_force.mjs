// d3-force: x'' = -x from x = 1, v = 0. A tick is the unit of time, so the force is h^2 times -x.
import { readFileSync } from "node:fs";
import { forceSimulation } from "d3-force";

const at = new URL(".", import.meta.resolve("d3-force"));
console.log("d3-force", JSON.parse(readFileSync(new URL("../package.json", at))).version);
for (const n of [10, 20, 40]) {
  const h = 1 / n;
  const node = { x: 1, y: 0, vx: 0, vy: 0 };
  const force = () => (node.vx -= h * h * node.x);
  forceSimulation([node]).stop().velocityDecay(0).alphaDecay(0).force("spring", force).tick(n);
  let [x, v] = [1, 0];
  for (let i = 0; i < n; i++) {
    v -= (h / 2) * x;
    x += h * v;
    v -= (h / 2) * x;
  }
  const show = (x, v) => `x ${x.toFixed(6)} v ${v.toFixed(6)}`;
  console.log(`${n} steps: theirs ${show(node.x, node.vx / h)}, velocity Verlet ${show(x, v)}`);
}
console.log(`right: x ${Math.cos(1).toFixed(6)} v ${(-Math.sin(1)).toFixed(6)}`);
