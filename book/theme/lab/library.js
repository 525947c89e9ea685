// The library, compiled to WebAssembly by book/lab/build.
(theLab => {
    'use strict';

    const { SYSTEMS } = theLab;

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
        LOWER_THETA: 13,
        LOWER_OMEGA: 14,
    };

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

    Object.assign(theLab, { QUANTITY, ROOT, compiled, methodsOf, place, timed });
})((globalThis.theLab ??= {}));
