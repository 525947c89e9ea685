// The library, compiled to WebAssembly by book/lab/build; runs of it, and what is kept of them to
// be drawn.
'use strict';

// The root of the book.
const ROOT = new URL('../../', document.currentScript.src);

// What the library says of a pendulum, numbered as in book/lab/src/simulation.rs.
const [
    THETA,
    OMEGA,
    TIME,
    STEPS,
    EVALUATIONS,
    ENERGY,
    ERROR,
    LOWEST,
    HIGHEST,
    LARGEST,
    LIMIT,
    PERIOD,
    INITIAL,
    LOWER_THETA,
    LOWER_OMEGA,
] = Array(15).keys();

// The compiled module, loaded by a script: a page opened from disk cannot fetch files.
// Once for all that is on a page.
let once;
function compiled() {
    once ??= new Promise((resolve, reject) => {
        const script = document.createElement('script');
        script.src = new URL('assets/lab.wasm.js', ROOT);
        script.addEventListener('load', () => {
            const bytes = Uint8Array.from(atob(globalThis.pendulaLab), letter =>
                letter.charCodeAt(0),
            );
            resolve(WebAssembly.compile(bytes));
        });
        script.addEventListener('error', () => reject(new Error('lab.wasm.js is missing')));
        document.head.append(script);
    });
    return once;
}

// The methods of the library: number, name, title.
function methodsOf(library) {
    const text = (method, which) => {
        const at = library.text_at(method, which),
            length = library.text_length(method, which);
        return new TextDecoder().decode(new Uint8Array(library.memory.buffer, at, length));
    };
    return Array.from({ length: library.methods() }, (_, number) => ({
        number,
        name: text(number, 0),
        title: text(number, 1),
    }));
}

// Sets a pendulum to the start of the scene; returns whether the library accepts it.
function place(library, number, method, scene) {
    const { number: kind, keys } = SYSTEMS[scene.system];
    return Boolean(
        library.set(
            number,
            kind,
            method.number,
            scene.g,
            scene.L,
            scene.beta,
            scene.theta0,
            scene.omega0,
            scene.dt,
            ...keys.slice(-2).map(key => scene[key]),
        ),
    );
}

// The time of a step (ns), measured on a separate run for a few milliseconds: the run on the
// page takes too few steps to be timed.
function timed(stopwatch, method, scene) {
    if (!place(stopwatch, 0, method, scene)) return NaN;
    const began = performance.now();
    let steps = 0,
        passed = 0,
        more = true;
    while (more && passed < 3) {
        const taken = stopwatch.advance(0, 50);
        more = taken === 50;
        steps += taken;
        passed = performance.now() - began;
    }
    // Browsers make their clocks coarse on purpose: a shorter time is not used.
    return passed > 1 ? (1e6 * passed) / steps : NaN;
}

// A trajectory is drawn with at most this many bins; when they are full, pairs are merged.
const BINS = 512;
// The number of points of a trajectory that are kept.
const TRAIL = 4096;
// The most samples a frame for the closed form and the phase portrait.
const SAMPLES = 64;
// For how long (ms) something long is computed before the page has its turn.
const SLICE = 10;

const wrapped = theta => theta - 2 * Math.PI * Math.round(theta / (2 * Math.PI));

// The record of one quantity: its extremes in bins of `width` steps.
class Series {
    constructor() {
        this.low = new Float64Array(BINS);
        this.high = new Float64Array(BINS);
        this.last = new Float64Array(BINS);
        this.width = 1;
        this.length = 0;
        this.steps = 0;
    }

    // Adds the sample after `steps` steps, with the extremes from the one before to this.
    add(steps, value, low = value, high = value) {
        this.steps = steps;
        while (this.bin(steps) >= BINS) this.widen();
        const bin = this.bin(steps);
        if (bin < this.length) {
            low = Math.min(this.low[bin], low);
            high = Math.max(this.high[bin], high);
        }
        // The steps since the last sample are those of the bins between, too.
        for (let i = Math.min(this.length, bin); i <= bin; i++) {
            this.low[i] = low;
            this.high[i] = high;
            this.last[i] = value;
        }
        this.length = bin + 1;
    }

    // The bin of a step.
    bin(step) {
        return Math.floor(Math.max(step - 1, 0) / this.width);
    }

    widen() {
        const half = Math.ceil(this.length / 2);
        for (let i = 0; i < half; i++) {
            const j = Math.min(2 * i + 1, this.length - 1);
            this.low[i] = Math.min(this.low[2 * i], this.low[j]);
            this.high[i] = Math.max(this.high[2 * i], this.high[j]);
            this.last[i] = this.last[j];
        }
        this.length = half;
        this.width *= 2;
    }

    // The same record, whatever comes later.
    copy() {
        return Object.assign(new Series(), structuredClone(this));
    }

    // The value after a step, twice, or the extremes of the several steps that are one bin;
    // null if there is none.
    at(step) {
        const bin = Math.min(this.bin(step), this.length - 1);
        if (bin < 0) return null;
        return this.width === 1
            ? [this.last[bin], this.last[bin]]
            : [this.low[bin], this.high[bin]];
    }

    get lowest() {
        return this.low.subarray(0, this.length).reduce((a, b) => Math.min(a, b), 0);
    }

    get highest() {
        return this.high.subarray(0, this.length).reduce((a, b) => Math.max(a, b), 0);
    }

    // The largest absolute value recorded.
    get largest() {
        return Math.max(this.highest, -this.lowest);
    }
}

// The pendulum of one method, in one place of the library.
class Pendulum {
    constructor(library, place, method) {
        Object.assign(this, {
            library,
            place,
            method,
            energy: new Series(),
            angle: new Series(),
            lapse: 0,
        });
        // The measured times of a step (ns).
        this.times = [];
        // Of all points that there were, those that are kept.
        this.trail = [];
        this.points = 0;
    }

    read(quantity) {
        return this.library.read(this.place, quantity);
    }

    // Takes up to `steps` steps, a whole number, and returns how many the library took.
    advance(steps) {
        return this.library.advance(this.place, steps);
    }

    // Records the angle against the exact one at the pendulum's own time, the extremes of the
    // energy error plus `level`, and the point in phase space.
    note(level) {
        const steps = this.read(STEPS),
            theta = this.read(THETA),
            exact = this.library.exact_theta(this.place, this.read(TIME));
        // An implicit method whose equations could not be solved gives NaN from then on.
        this.lost = Number.isNaN(theta);
        if (this.lost) return;
        const [error, lowest, highest] = [ERROR, LOWEST, HIGHEST].map(
            quantity => level + this.read(quantity),
        );
        this.energy.add(steps, error, lowest, highest);
        this.library.look(this.place);
        if (!Number.isNaN(exact)) {
            this.lapse = theta - exact;
            this.angle.add(steps, this.lapse);
        }
        const [omega, lower] = [this.read(OMEGA), this.read(LOWER_THETA)];
        this.trail[this.points++ % TRAIL] = { steps, theta: wrapped(theta), omega, lower };
    }

    // The k-th point of all that there were, if it is kept: steps, θ, ω, and θ of the lower bob.
    point(k) {
        return this.trail[k % TRAIL];
    }

    // The first point that is kept.
    get oldest() {
        return Math.max(0, this.points - TRAIL);
    }

    // The point nearest to a step, or null.
    near(step) {
        const steps = k => this.point(k).steps;
        let k = this.oldest;
        while (k + 1 < this.points && steps(k + 1) - step <= step - steps(k)) k++;
        return k < this.points ? this.point(k) : null;
    }
}

// The pendulums of a scene, which take their steps together.
class Run {
    constructor(library, known) {
        Object.assign(this, { library, known, pendulums: [], taken: 0, time: 0 });
    }

    // Sets every pendulum to its start; returns the methods that the library refuses.
    set(scene) {
        const refused = [];
        this.scene = scene;
        this.pendulums = [];
        for (const name of scene.methods) {
            const method = this.known.find(known => known.name === name),
                number = this.pendulums.length;
            const stands = place(this.library, number, method, scene);
            if (stands) this.pendulums.push(new Pendulum(this.library, number, method));
            else refused.push(method);
        }
        const last = scene.until ? Math.round(scene.until / scene.dt) : Infinity;
        this.limit = Math.min(last, ...this.pendulums.map(pendulum => pendulum.read(LIMIT)));
        // Whether there were steps at which the angle was not looked at.
        this.sampled = false;
        this.sight();
        return refused;
    }

    // Records the quantities at the present step, which is the one the library says it is.
    sight() {
        const any = this.pendulums.length > 0;
        this.taken = any ? this.library.read(0, STEPS) : 0;
        this.time = any ? this.library.read(0, TIME) : 0;
        this.exact = any ? this.library.exact_theta(0, this.time) : NaN;
        // Where the energy is not conserved it has no error: it is shown itself.
        const level = any && !conserves(this.scene) ? this.library.read(0, INITIAL) : 0;
        for (const pendulum of this.pendulums) pendulum.note(level);
    }

    // Takes up to `n` steps with every method, in pieces small enough to draw, for as long as
    // there is time; returns whether there are more to take.
    advance(n, deadline = Infinity) {
        const end = Math.min(this.taken + n, this.limit);
        let piece = 1;
        while (this.taken + piece * SAMPLES < end) piece *= 2;
        while (this.taken < end && performance.now() < deadline) {
            const next = Math.min(piece - (this.taken % piece), end - this.taken);
            if (next > 1) this.sampled = true;
            const took = this.pendulums.map(pendulum => pendulum.advance(next));
            this.sight();
            if (took.some(steps => steps < next)) {
                // The library has no more.
                this.limit = this.taken;
                break;
            }
        }
        return this.taken < this.limit;
    }
}
