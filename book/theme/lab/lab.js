// The lab: pendulums that the reader can set and drag. The library itself computes their motion,
// compiled to WebAssembly by book/lab/build; this file and those loaded before it only handle
// input, drawing and text. In print, without scripts and in the book as one page, the content of an
// element of class `lab` stays as it is.
(theLab => {
    'use strict';

    const {
        Drawing,
        Page,
        Pendulum,
        PRESETS,
        QUANTITY,
        address,
        addressed,
        presetScene,
        takeHands,
    } = theLab;
    const { compiled, methodsOf, place } = theLab;
    const { INITIAL, LIMIT } = QUANTITY;

    // The most samples a frame for the closed form and the phase portrait.
    const SAMPLES = 64;
    // The time for the steps of a frame, out of 1/60 s (ms).
    const BUDGET = 7;

    const calm = matchMedia('(prefers-reduced-motion: reduce)');

    class Lab {
        constructor(spot, library, stopwatch) {
            // The stopwatch is another instance of the library, on which steps are timed.
            Object.assign(this, {
                spot,
                library,
                stopwatch,
                places: library.places(),
                known: methodsOf(library),
            });
            // A lab on its own page has all controls; one within a chapter shows its lesson.
            this.whole = spot.classList.contains('whole');
            this.preset = spot.dataset.preset;
            this.pendulums = [];
            this.running = this.held = false;
            // The steps that a frame has time for, and the number of frames so far.
            this.most = Infinity;
            this.frames = 0;
            this.drawing = new Drawing(this);
            this.page = new Page(this);
            spot.append(this.page.live);
            takeHands(this);
            this.scene = presetScene(this.preset);
            if (this.whole) {
                this.arrived = this.follow();
                addEventListener('hashchange', () => {
                    if (!this.follow()) return;
                    spot.scrollIntoView({ block: 'start' });
                    this.go();
                });
            }
            if (!this.arrived) this.begin();
            spot.classList.add('on');
            let wide = 0;
            new ResizeObserver(
                ([
                    {
                        contentRect: { width },
                    },
                ]) => {
                    // A change of height, as when the table grows, must not clear the trails.
                    if (width !== wide) this.drawing.layout();
                    wide = width;
                },
            ).observe(this.page.live);
            new MutationObserver(() => this.drawing.layout()).observe(document.documentElement, {
                attributes: true,
                attributeFilter: ['class'],
            });
            document.fonts.ready.then(() => this.drawing.layout());
        }

        // ----------------------------------------------------------------------------------- the
        // scene

        // Goes to the scene in the page's address; returns whether there is one.
        follow() {
            const scene = addressed(
                location.hash,
                this.known.map(method => method.name),
                this.places,
            );
            if (scene) this.begin(scene);
            return Boolean(scene);
        }

        lesson(name) {
            history.replaceState(null, '', `#${name}`);
            this.begin(presetScene(name));
            this.go();
        }

        // Changes some of the scene and restarts it.
        change(some, quietly = false) {
            this.begin({ ...this.scene, ...some });
            if (!quietly) this.remember();
        }

        // Changes how the scene is shown, without a restart.
        adjust(some) {
            Object.assign(this.scene, some);
            this.page.settle();
            this.show();
            this.remember();
        }

        // Writes the scene to the page's address, once changes pause.
        remember() {
            if (!this.whole) return;
            clearTimeout(this.pending);
            this.pending = setTimeout(() => {
                history.replaceState(null, '', `#${address(this.scene)}`);
            }, 200);
        }

        // Sets every pendulum to its start.
        begin(scene = this.scene) {
            const { library } = this;
            this.scene = scene;
            this.pendulums = [];
            const refused = [];
            for (const name of scene.methods) {
                const method = this.known.find(known => known.name === name),
                    number = this.pendulums.length;
                const stands = place(library, number, method, scene);
                if (stands) this.pendulums.push(new Pendulum(library, number, method));
                else refused.push(method.title);
            }
            this.taken = this.time = this.clock = 0;
            const last = scene.until ? Math.round(scene.until / scene.dt) : Infinity;
            this.limit = Math.min(last, ...this.pendulums.map(pendulum => pendulum.read(LIMIT)));
            this.running &&= this.pendulums.length > 0;
            const why =
                scene.beta > 0 ? 'Not for a damped pendulum' : 'Beyond what can be computed';
            this.notice = refused.length ? `${why}: ${refused.join(', ')}.` : '';
            this.sight();
            this.page.say('');
            this.page.settle();
            this.page.show();
            this.drawing.layout();
        }

        // Records the quantities at the present step.
        sight() {
            const any = this.pendulums.length > 0;
            this.exact = any ? this.library.exact_theta(0, this.time) : NaN;
            // With damping there is no energy error: the energy itself is shown.
            const level = any && this.scene.beta > 0 ? this.library.read(0, INITIAL) : 0;
            for (const pendulum of this.pendulums) pendulum.note(this.exact, level);
        }

        // Takes up to `n` steps with every method, in pieces small enough to draw; returns whether
        // it took all `n`.
        advance(n) {
            const steps = Math.min(n, this.limit - this.taken);
            let piece = 1;
            while (piece * SAMPLES < steps) piece *= 2;
            const end = this.taken + steps;
            while (this.taken < end) {
                const next = Math.min(piece - (this.taken % piece), end - this.taken);
                for (const pendulum of this.pendulums) pendulum.advance(next);
                this.taken += next;
                this.time = this.taken * this.scene.dt;
                this.sight();
            }
            return steps === n;
        }

        // ----------------------------------------------------------------------------------------
        // time

        // Runs, from the start if the end has been reached; or pauses.
        run(on) {
            if (on && this.taken >= this.limit) this.begin();
            this.running = on && this.pendulums.length > 0;
            this.show();
            this.page.say(this.running ? '' : this.page.summary());
            if (!this.running) return;
            this.before = performance.now();
            this.clock = this.time;
            this.next();
        }

        // Runs, unless the reader prefers reduced motion.
        go() {
            this.run(!calm.matches);
        }

        oneStep() {
            this.running = false;
            this.advance(1);
            this.run(false);
        }

        again() {
            this.running = false;
            this.begin();
            this.run(false);
        }

        show() {
            this.drawing.all();
            this.page.show();
        }

        // With reduced motion, two frames a second.
        next() {
            clearTimeout(this.waiting);
            cancelAnimationFrame(this.asked);
            if (calm.matches) this.waiting = setTimeout(() => this.frame(performance.now()), 500);
            else this.asked = requestAnimationFrame(now => this.frame(now));
        }

        frame(now) {
            if (!this.running) return;
            const began = performance.now(),
                { dt, speed } = this.scene;
            const passed =
                Math.min(Math.max(now - this.before, 0), calm.matches ? 600 : 100) / 1000;
            this.before = now;
            this.clock += passed * speed;
            const due = Math.floor(this.clock / dt + 1e-9) - this.taken;
            const n = Math.max(0, Math.min(due, this.most));
            // Steps for which there is no time are dropped, not caught up.
            if (due > n) this.clock = (this.taken + n) * dt;
            const more = this.advance(n);
            const cost = performance.now() - began;
            this.most =
                cost > BUDGET
                    ? Math.max(1, Math.floor((n * BUDGET) / cost))
                    : Math.max(this.most * 1.1, 64);
            this.page.slow.hidden = due <= n;
            if (!more) {
                this.run(false);
                return;
            }
            this.drawing.pendulums();
            this.drawing.portrait();
            // Curves and numbers are updated less often, as nobody can read them sixty times a
            // second.
            this.frames++;
            if (calm.matches || this.frames % 3 === 0) this.drawing.plots();
            if (calm.matches || this.frames % 12 === 0) this.page.show();
            this.next();
        }
    }

    const spots = document.querySelectorAll('.lab');
    // A page without WebAssembly is as in print.
    if (
        spots.length &&
        !/\/print\.html$/.test(location.pathname) &&
        typeof WebAssembly === 'object'
    ) {
        compiled()
            .then(async module => {
                for (const spot of spots) {
                    if (!Object.hasOwn(PRESETS, spot.dataset.preset))
                        throw new Error(`no preset ${spot.dataset.preset}`);
                    const [library, stopwatch] = [
                        await WebAssembly.instantiate(module),
                        await WebAssembly.instantiate(module),
                    ];
                    spot.lab = new Lab(spot, library.exports, stopwatch.exports);
                    // When the browser scrolled to the address, the lab was not on the page yet.
                    if (spot.lab.arrived) spot.scrollIntoView({ block: 'start' });
                }
            })
            .catch(error => console.error(`lab: ${error.message}`));
    }
})((globalThis.theLab ??= {}));
