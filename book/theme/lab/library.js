// The library, compiled to WebAssembly by book/lab/build, and the lab's pendulums, which it
// computes.
(theLab => {
    'use strict';

    // The root of the book.
    const ROOT = new URL('../../', document.currentScript.src);

    // Numbered as in book/lab/src/simulation.rs.
    const QUANTITY = {
        THETA: 0,
        OMEGA: 1,
        TIME: 2,
        STEPS: 3,
        EVALUATIONS: 4,
        ENERGY: 5,
        ERROR: 6,
        LOWEST: 7,
        HIGHEST: 8,
        LARGEST: 9,
        LIMIT: 10,
        PERIOD: 11,
        INITIAL: 12,
    };
    const { THETA, OMEGA, TIME, STEPS, LOWEST, HIGHEST } = QUANTITY;

    // A trajectory is drawn with at most this many bins; when they are full, pairs are merged.
    const BINS = 512;
    // The number of points of a trajectory that the phase portrait keeps.
    const TRAIL = 4096;

    const wrapped = theta => theta - 2 * Math.PI * Math.round(theta / (2 * Math.PI));

    // The compiled module, loaded by a script: a page opened from disk cannot fetch files.
    function compiled() {
        return new Promise((resolve, reject) => {
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
        return Boolean(
            library.set(
                number,
                method.number,
                scene.g,
                scene.L,
                scene.beta,
                scene.theta0,
                scene.omega0,
                scene.dt,
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

    // The record of one quantity: its extremes in bins of `width` steps.
    class Series {
        constructor() {
            this.low = new Float64Array(BINS);
            this.high = new Float64Array(BINS);
            this.width = 1;
            this.length = 0;
        }

        // Adds the sample after `steps` steps, with the extremes since the last one.
        add(steps, low, high) {
            let bin = Math.floor(Math.max(steps - 1, 0) / this.width);
            while (bin >= BINS) {
                this.widen();
                bin = Math.floor(Math.max(steps - 1, 0) / this.width);
            }
            if (bin < this.length) {
                this.low[bin] = Math.min(this.low[bin], low);
                this.high[bin] = Math.max(this.high[bin], high);
                return;
            }
            this.low[bin] = low;
            this.high[bin] = high;
            this.length = bin + 1;
        }

        widen() {
            const half = Math.ceil(this.length / 2);
            for (let i = 0; i < half; i++) {
                const j = Math.min(2 * i + 1, this.length - 1);
                this.low[i] = Math.min(this.low[2 * i], this.low[j]);
                this.high[i] = Math.max(this.high[2 * i], this.high[j]);
            }
            this.length = half;
            this.width *= 2;
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
            this.trail = new Float32Array(2 * TRAIL);
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
            this.energy.add(steps, level + this.read(LOWEST), level + this.read(HIGHEST));
            this.library.look(this.place);
            if (!Number.isNaN(exact)) {
                this.lapse = theta - exact;
                this.angle.add(steps, this.lapse, this.lapse);
            }
            const at = 2 * (this.points++ % TRAIL);
            this.trail[at] = wrapped(theta);
            this.trail[at + 1] = this.read(OMEGA);
        }
    }

    Object.assign(theLab, {
        Pendulum,
        QUANTITY,
        ROOT,
        TRAIL,
        compiled,
        methodsOf,
        place,
        timed,
        wrapped,
    });
})((globalThis.theLab ??= {}));
