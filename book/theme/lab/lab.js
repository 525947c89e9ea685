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
    const { TIME, STEPS, INITIAL, LIMIT } = QUANTITY;

    // The most samples a frame for the closed form and the phase portrait.
    const SAMPLES = 64;
    // The time for the steps of a frame, out of 1/60 s (ms), and the steps of a first frame, of
    // which nobody knows yet how long they take.
    const BUDGET = 7;
    const FIRST = 64;

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

        // Goes to the scene in an address, the page's own; returns whether there is one.
        follow(hash = location.hash) {
            const scene = addressed(
                hash,
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
            this.clock = 0;
            // The steps that a frame has time for: another scene may take longer.
            this.most = FIRST;
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

        // Records the quantities at the present step, which is the one the library says it is.
        sight() {
            const any = this.pendulums.length > 0;
            this.taken = any ? this.library.read(0, STEPS) : 0;
            this.time = any ? this.library.read(0, TIME) : 0;
            this.exact = any ? this.library.exact_theta(0, this.time) : NaN;
            // With damping there is no energy error: the energy itself is shown.
            const level = any && this.scene.beta > 0 ? this.library.read(0, INITIAL) : 0;
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
            const before = this.taken,
                due = Math.max(0, Math.floor(this.clock / dt + 1e-9) - before);
            // The budget is an estimate; the deadline holds if steps get longer under way.
            const more = this.advance(Math.min(due, this.most), began + 2 * BUDGET);
            const n = this.taken - before,
                cost = performance.now() - began;
            // Steps for which there is no time are dropped, not caught up.
            if (due > n) this.clock = this.time;
            if (cost > BUDGET) this.most = Math.max(1, Math.floor((n * BUDGET) / cost));
            else if (due > n)
                this.most = Math.ceil(this.most * (cost < BUDGET / 2 ? 2 : 1.1));
            this.page.slow.hidden = due <= n || cost < BUDGET / 2;
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
