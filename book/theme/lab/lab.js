// The lab: pendulums that the reader can set and drag. The library itself computes their motion,
// compiled to WebAssembly by book/lab/build; this file and those loaded before it only handle
// input, drawing and text. In print, without scripts and in the book as one page, the content of an
// element of class `lab` stays as it is.
'use strict';

// The time for the steps of a frame, out of 1/60 s (ms), and the steps of a first frame, of
// which nobody knows yet how long they take.
const BUDGET = 7;
const FIRST_STEPS = 64;

// How much of its first scene the lab's own page shows when it opens (s).
const OPENING = 20;

// When the page has nothing else to do.
const idle = globalThis.requestIdleCallback ?? (work => setTimeout(work, 1));

const calm = matchMedia('(prefers-reduced-motion: reduce)');

// A run with a clock, on a page.
class Lab extends Run {
    // Further instances of the library are for timing steps, for what is pinned, and for the
    // numbers that are saved.
    constructor(spot, library, stopwatch, pinned, spare) {
        super(library, methodsOf(library));
        Object.assign(this, { spot, stopwatch, spare, places: library.places() });
        this.lessons = lessonsOf(document);
        const names = this.known.map(method => method.name);
        this.addresses = new Addresses(names, this.places, this.lessons);
        // A lab on its own page has all controls; one within a chapter shows its lesson.
        this.whole = spot.classList.contains('whole');
        this.hero = spot.classList.contains('hero');
        // Whether the reader has taken a bob.
        this.grasped = false;
        this.preset = spot.dataset.preset;
        this.running = this.held = false;
        // Whether the reader has touched it; until then one within a chapter moves by itself.
        this.touched = this.whole;
        this.frames = 0;
        // The step that is read out, and its time (s).
        this.cursor = null;
        this.pin = new Pin(this, pinned);
        this.drawing = new Drawing(this);
        this.drawing.stage.trails = !calm.matches;
        this.page = new Page(this);
        spot.append(this.page.live);
        takeHands(this);
        this.scene = this.addresses.step(this.preset, 1);
        if (this.whole) {
            this.arrived = this.follow();
            addEventListener('hashchange', () => {
                if (!this.follow()) return;
                spot.scrollIntoView({ block: 'start' });
                this.go();
            });
        }
        if (!this.arrived) {
            this.begin();
            if (this.whole) this.finished();
        }
        if (!this.whole) this.unasked();
        spot.classList.add('on');
        let wide = 0;
        new ResizeObserver(([{ contentRect }]) => {
            // A change of height, as when the table grows, must not clear the trails.
            if (contentRect.width !== wide) this.drawing.layout();
            wide = contentRect.width;
        }).observe(this.page.live);
        new MutationObserver(() => this.drawing.layout()).observe(document.documentElement, {
            attributes: true,
            attributeFilter: ['class'],
        });
        document.fonts.ready.then(() => this.drawing.layout());
    }

    // A run to look at, for who comes with no scene in mind.
    finished() {
        const steps = Math.round(OPENING / this.scene.dt);
        while (this.taken < steps && this.advance(Math.min(steps - this.taken, 64)));
        this.show();
    }

    // Begins where there is something to see, and moves while it is seen, until the reader
    // takes over; then its numbers are shown, too.
    unasked() {
        const { live } = this.page;
        live.classList.add('unasked');
        const take = () => {
            this.touched = true;
            this.seen?.disconnect();
            live.classList.remove('unasked');
        };
        for (const event of ['pointerdown', 'keydown', 'click'])
            live.addEventListener(event, take, { once: true, capture: true });
        this.approach(Math.round(PRESETS[this.preset].from / this.scene.dt));
    }

    // Takes the first steps while the page rests, in pieces of which each step is drawn, and then
    // moves while it is seen.
    approach(start) {
        if (this.touched) return;
        const end = performance.now() + BUDGET;
        let more = this.taken < start;
        while (more && performance.now() < end)
            more = this.advance(Math.min(start - this.taken, 64)) && this.taken < start;
        if (more) {
            idle(() => this.approach(start));
            return;
        }
        this.clock = this.time;
        this.show();
        // What was seen while the page was busy comes together: the last of it is true now.
        const seen = new IntersectionObserver(
            entries => this.run(entries.at(-1).isIntersecting && !calm.matches),
            { threshold: 0.3 },
        );
        seen.observe(this.spot);
        this.seen = seen;
    }

    // Goes to the scene in an address, the page's own; returns whether there is one. What of it was
    // not understood is said, in our own words: the address may be anybody's.
    follow(hash = location.hash) {
        const scene = this.addresses.scene(hash);
        if (scene) this.begin(scene);
        const doubts = this.addresses.doubts(hash);
        if (doubts.length) {
            this.notice = [
                `Not understood in the address, and left as usual: ${doubts.join(', ')}.`,
                this.notice,
            ]
                .filter(Boolean)
                .join(' ');
            this.page.say('');
        }
        return Boolean(scene);
    }

    // Goes to a step of a lesson; what the reader pinned stays, unless the step has its own.
    lesson(name, step) {
        const scene = this.addresses.step(name, step);
        const { lesson, step: last, pin } = this.scene;
        if (name === lesson && pin !== this.addresses.step(lesson, last).pin) scene.pin ||= pin;
        this.begin(scene);
        this.write();
        this.go();
    }

    // Whether the scene is that of its step.
    isStep() {
        const { lesson, step } = this.scene;
        const own = this.addresses.step(lesson, step);
        return address({ ...own, pin: '' }) === address({ ...this.scene, pin: '' });
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
        this.pending = setTimeout(() => this.write(), 200);
    }

    // A step of a lesson has a short address.
    write() {
        clearTimeout(this.pending);
        const { lesson, step } = this.scene;
        const own = this.addresses.step(lesson, step);
        const short = step > 1 ? `${lesson}/${step}` : lesson;
        const same = address(own) === address(this.scene);
        history.replaceState(null, '', `#${same ? short : address(this.scene)}`);
    }

    // Sets every pendulum to its start.
    begin(scene = this.scene) {
        const refused = this.set(scene).map(method => method.title);
        this.clock = 0;
        // The steps that a frame has time for: another scene may take longer.
        this.most = FIRST_STEPS;
        this.running &&= this.pendulums.length > 0;
        this.cursor = null;
        const why = conserves(scene)
            ? 'Cannot be computed'
            : 'Does not suit this system, or cannot be computed';
        this.notice = refused.length ? `${why}: ${refused.join(', ')}.` : '';
        this.page.say('');
        this.page.settle();
        this.page.show();
        this.page.reading.put(null);
        this.drawing.layout();
    }

    // Runs, from the start if the end has been reached; or pauses.
    run(on) {
        if (on && this.taken >= this.limit) this.begin();
        this.running = on && this.pendulums.length > 0;
        this.show();
        this.page.say(this.running || !this.touched ? '' : this.page.summary());
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
        const passed = Math.min(Math.max(now - this.before, 0), calm.matches ? 600 : 100) / 1000;
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
        else if (due > n) this.most = Math.ceil(this.most * (cost < BUDGET / 2 ? 2 : 1.1));
        this.page.slow.hidden = due <= n || cost < BUDGET / 2;
        if (!more) {
            this.run(false);
            return;
        }
        this.drawing.stage.draw();
        this.drawing.phase.draw();
        // Curves and numbers are updated less often, as nobody can read them sixty times a
        // second.
        this.frames++;
        if (calm.matches || this.frames % 3 === 0) this.drawing.plots();
        if (calm.matches || this.frames % 12 === 0) {
            this.page.show();
            this.page.reading.show();
        }
        this.next();
    }
}

async function come(spot) {
    if (!Object.hasOwn(PRESETS, spot.dataset.preset))
        throw new Error(`no preset ${spot.dataset.preset}`);
    const module = await compiled();
    const instances = [];
    for (let i = 0; i < (spot.classList.contains('whole') ? 4 : 2); i++)
        instances.push((await WebAssembly.instantiate(module)).exports);
    spot.lab = new Lab(spot, ...instances);
    // When the browser scrolled to the address, the lab was not on the page yet.
    if (spot.lab.arrived) spot.scrollIntoView({ block: 'start' });
}

// What the tests in book/browser read, as nothing else here is a name of the page.
globalThis.theLab = { THETA, OMEGA, TIME, STEPS, LOWER_THETA, LOWER_OMEGA, address };

// A page without WebAssembly is as in print.
if (!/\/print\.html$/.test(location.pathname) && typeof WebAssembly === 'object')
    for (const spot of document.querySelectorAll('.lab'))
        come(spot).catch(error => console.error(`lab: ${error.message}`));
