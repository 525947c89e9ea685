// Solvers of JavaScript's libraries that choose their steps, as strangers, protocol 1 of `pendula
// verify`:
//
//     node solver.mjs LIBRARY SOLVER
//
// An adapter makes an object with `solve(run)`, which returns the states at the times of `run.grid`
// after its first, the start, and, where the library looks for events, `crossings(run)`, which
// returns [t, theta, omega] for each.
import { createInterface } from "node:readline";

const [library, name] = process.argv.slice(2);

// Allowed in one run, where a library stops after 1000 steps or 10,000.
const STEPS = 1e6;

// One request: theta'' = -g sin theta + a cos(w t), from the first time of the grid on, or back.
class Run {
  constructor([verb, ...words]) {
    const x = words.map((word) => (/^-?inf/.test(word) ? Number(word.replace("inf", "Infinity")) : Number(word)));
    const [g, a, w] = verb === "driven-solve" ? x.splice(0, 3) : [...x.splice(0, 1), 0, 0];
    const [theta, omega, t0] = x.splice(0, 3);
    if (verb === "crossings") x.reverse(); // The end stands before the tolerance.
    const [tol, ...asked] = x;
    if (asked.length === 0) throw new Error("numbers are missing");
    Object.assign(this, { g, a, w, tol, asked, start: [theta, omega], count: 0 });
    // The tolerance of theta and of omega, for a library that takes two.
    this.each = [tol, tol * Math.sqrt(Math.abs(g))];
    // Where the run begins, and then each of the times once.
    this.grid = [t0];
    for (const t of asked) if (t !== this.grid.at(-1)) this.grid.push(t);
    // A library that hangs with these, or takes them for others, is not asked.
    if (!this.grid.every(Number.isFinite)) throw new Error("a time is not finite");
    const forward = this.grid[1] > this.grid[0];
    if (this.grid.some((t, i) => i > 1 && t > this.grid[i - 1] !== forward)) throw new Error("the times turn round");
    this.end = this.grid.at(-1);
    // A thousandth of the time of a radian of small swings, for a library that takes a first step.
    this.first = (forward ? 1e-3 : -1e-3) / Math.sqrt(Math.abs(g));
  }

  // The derivatives of angle and velocity, counted.
  rate(t, y) {
    this.count++;
    return [y[1], this.a * Math.cos(this.w * t) - this.g * Math.sin(y[0])];
  }
}

const ADAPTERS = {
  // Interpolates all times.
  async dopri() {
    const { Dopri } = await import("dopri");
    return {
      solve(run) {
        const rate = (t, y, dy) => [dy[0], dy[1]] = run.rate(t, y);
        const code = new Dopri(rate, 2, { atol: run.tol, rtol: run.tol, maxSteps: STEPS });
        code.initialise(run.grid[0], run.start);
        const at = code.run(run.end);
        return at(run.grid.slice(1));
      },
    };
  },

  // A single time is the end of the last step; others are interpolated. It goes forward alone. An event, which
  // is a passage upwards, ends a run, so the next one begins there and waits for one downwards.
  async numeric() {
    const numeric = (await import("numeric")).default;
    const call = (run, t0, y0, event) => numeric.dopri(t0, run.end, y0, (t, y) => run.rate(t, y), run.tol, STEPS, event);
    const ended = (run, found) => found.x.at(-1) === run.end;
    return {
      solve(run) {
        const found = call(run, run.grid[0], run.start);
        if (!ended(run, found)) throw new Error(`it ended at ${found.x.at(-1)}: ${found.msg}`);
        return run.grid.length === 2 ? [found.y.at(-1)] : run.grid.slice(1).map((t) => found.at(t));
      },
      crossings(run) {
        let [t, y] = [run.grid[0], run.start];
        let sign = y[0] > 0 || (y[0] === 0 && y[1] > 0) ? -1 : 1;
        for (const rows = []; ; sign = -sign) {
          const found = call(run, t, y, (t, y) => sign * y[0]);
          [t, y] = [found.x.at(-1), found.y.at(-1)];
          if (found.events === undefined || found.events === "") {
            if (ended(run, found)) return rows;
            throw new Error(`it ended at ${t}: ${found.msg}`);
          }
          rows.push([t, ...y]);
        }
      },
    };
  },

  // RK23 and RK45. It has no outputs but the ends of its steps, so a run goes from each time to the next.
  async mathjs() {
    const { solveODE } = await import("mathjs");
    return {
      solve(run) {
        let y = run.start;
        return run.grid.slice(1).map((t, i) => {
          const options = { method: name, tol: run.tol, maxIter: STEPS };
          y = solveODE((t, y) => run.rate(t, y), [run.grid[i], t], y, options).y.at(-1);
          return y;
        });
      },
    };
  },

  // Its tolerance is that of each component, relative to its magnitude and its change in the step.
  async "ode45-cash-karp"() {
    const create = (await import("ode45-cash-karp")).default;
    return {
      solve(run) {
        const rate = (dy, y, t) => [dy[0], dy[1]] = run.rate(t, y);
        const code = create([...run.start], rate, run.grid[0], run.first, { tol: run.tol, verbose: false });
        return run.grid.slice(1).map((t) => {
          code.steps(Infinity, t);
          return [...code.y];
        });
      },
    };
  },

  // The end of a run is that of a step; several times are interpolated.
  async odex() {
    const { Outcome, Solver } = (await import("odex")).default;
    return {
      solve(run) {
        const code = new Solver(2);
        Object.assign(code, { absoluteTolerance: run.each, relativeTolerance: [run.tol, run.tol], maxSteps: STEPS });
        Object.assign(code, { initialStepSize: Math.abs(run.first), denseOutput: run.grid.length > 2 });
        const rows = [];
        const forward = run.end > run.grid[0];
        const told = (_, from, to, y, dense) => {
          for (let t = run.grid[rows.length + 1]; forward ? t <= to : t >= to; t = run.grid[rows.length + 1])
            rows.push([0, 1].map((i) => dense(i, t)));
        };
        const found = code.solve((t, y) => run.rate(t, y), run.grid[0], run.start, run.end, code.denseOutput ? told : undefined);
        if (found.outcome !== Outcome.Converged) throw new Error(Outcome[found.outcome]);
        return code.denseOutput ? rows : [found.y];
      },
    };
  },
};

function answer(words, solver) {
  const [verb] = words;
  const known = { solve: solver.solve, "driven-solve": solver.solve, crossings: solver.crossings };
  if (verb === "hello") return `hello 1 ${name}\n`;
  if (!known[verb]) return "unsupported\n";
  try {
    const run = new Run(words);
    // A run of no length is left to no library.
    let rows = run.grid.length > 1 ? known[verb](run) : [];
    if (verb !== "crossings") {
      const states = [run.start, ...rows];
      let at = 0;
      rows = run.asked.map((t) => states[t === run.grid[at] ? at : ++at]);
    }
    return [...rows.map((row) => row.join(" ")), `done ${run.count}`, ""].join("\n");
  } catch (error) {
    return `error ${String(error.message ?? error).replace(/\s+/g, " ")}\n`;
  }
}

// What a library prints goes to the standard error.
console.log = console.error;
const solver = await ADAPTERS[library]();
createInterface({ input: process.stdin }).on("line", (line) => {
  const words = line.trim().split(/\s+/);
  if (words[0] === "bye") process.exit(0);
  process.stdout.write(answer(words, solver));
});
