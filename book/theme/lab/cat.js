// A cat in phase space, carried by up to four methods beside the exact motion: what becomes of its
// area.
'use strict';

// As in the still figure: where the cat sits, its size (rad), the pieces between its corners.
const PLACE = { theta: 0.9, omega: 0 };
const SIZE = 0.5;
const CAT_PIECES = 8;
const AXES = { theta: [-3.2, 1.9], omega: [-6.2, 6.8] };
const HIGH = 260;
const CAT = {
    h: 0.14,
    fair: true,
    methods: ['forward-euler', 'symplectic-euler', 'rk4', 'stormer-verlet'],
};
// How far the still figure carries it (s), and this one before anything is asked of it: at the
// start all charts are alike.
const SHOWN = 1.68;
// Between two steps where little motion is asked for, and at least at other times (ms).
const SLOW = 1000;
const QUICK = 60;

figures.cat = class extends Moved {
    constructor(spot, library, number) {
        super(spot, library, number);
        const { svg, width, height } = this;
        const middle = width / 2,
            low = height - 56;
        this.legend([
            ['start', 'M4,-7h28v14h-28z', 'line fill thin'],
            ['true motion', 'M0,0h36', 'line'],
        ]);
        this.charts = [0, 1, 2, 3].map(i => {
            const [left, right] = i % 2 ? [middle + 30, width - 20] : [38, middle + 8];
            const bottom = i < 2 ? 106 + HIGH : low;
            const heading = words('', { x: left, y: bottom - HIGH - 42 });
            const box = [left, bottom - HIGH, right, bottom];
            svg.append(heading);
            const named = { omega: i % 2 === 0, theta: i > 1 };
            const plane = new Plane(svg, `${this.name}-${i}`, box, AXES, named);
            return { plane, heading };
        });
        this.scene = { ...CAT };
        this.lay();
        this.foresee();
    }

    lay() {
        const { library } = this;
        this.run = button('run', 'Play', () => this.play(!this.waiting));
        const h = this.slider('h', 'Step h', 's', { from: 0.01, to: 0.3, by: 0.01 });
        const equal = 'Equal work: with k force evaluations a step, steps of k\u00a0h';
        const fair = checkbox('fair', equal, true, on => this.change({ fair: on }));
        this.fair = fair.box;
        this.time = element('output', { class: 'note time' });
        const names = library.methods.map(({ name, title }) => [name, title]);
        const onchange = () => this.change({ methods: this.selects.map(({ value }) => value) });
        this.selects = this.charts.map(() => select({ onchange }, [['', 'no method'], ...names]));
        const step = button('step', 'One step', () => {
            this.play(false);
            this.advance();
        });
        const reset = button('reset', 'Reset', () => this.change(CAT));
        const charts = this.selects.map(
            (select, i) => markup`<label><span>Chart ${String(i + 1)}</span>${select}</label>`,
        );
        this.controls.append(
            markup`<div class="buttons">${[this.run, step, reset, this.time]}</div>`,
            markup`<div class="buttons">${[h, fair.label]}</div>`,
            markup`<div class="choices">${charts}</div>`,
            this.said,
        );
    }

    // How many steps of h a step of the method takes, so that all cost the same.
    times(method) {
        if (!this.scene.fair) return 1;
        const { exports } = this.library,
            { g, L } = PENDULUM;
        const evaluations = [1, 2].map(steps => {
            // The plain pendulum, without damping.
            const { theta, omega } = PLACE;
            exports.set(0, 0, method.number, g, L, 0, theta, omega, this.scene.h, 0, 0);
            exports.advance(0, steps);
            return exports.read(0, EVALUATIONS);
        });
        return Math.max(evaluations[1] - evaluations[0], 1) || 1;
    }

    // The cat at its place, its outline first, as one row of points.
    begin() {
        const { library, scene } = this;
        library.scene(library.methods[0], { ...PLACE, h: scene.h });
        const parts = [];
        for (let which = 1; ; which++) {
            const part = library.shape(which, SIZE, which === 1 ? CAT_PIECES : 2);
            if (!part.length) break;
            parts.push(part);
        }
        // Where each part ends.
        let end = 0;
        this.ends = parts.map(part => (end += part.length));
        this.cat = Float64Array.from(parts.flatMap(part => [...part]));
        this.size = library.area(this.outline(this.cat));
        this.taken = 0;
        for (const [i, chart] of this.charts.entries()) {
            const name = scene.methods[i];
            const method = name ? library.method(name) : null;
            const every = method ? this.times(method) : 1;
            Object.assign(chart, { method, every, cat: this.cat, at: 0 });
        }
    }

    outline(cat) {
        return cat.subarray(0, this.ends[0]);
    }

    change(some) {
        this.play(false);
        Object.assign(this.scene, some);
        this.foresee();
        this.show();
    }

    // Carries it as far as the still figure does. What is played begins at the start.
    foresee() {
        this.begin();
        const { h } = this.scene;
        while (h * (this.taken + 0.5) < SHOWN && this.carry());
        this.foreseen = true;
    }

    advance() {
        if (this.foreseen) this.begin();
        this.foreseen = false;
        if (this.carry()) this.show();
    }

    // Takes the steps of the charts whose time has come; whether there are any.
    carry() {
        const { library, scene } = this;
        const charts = this.charts.filter(chart => chart.method);
        if (!charts.length) return false;
        const due = () => charts.filter(({ every }) => this.taken % every === 0);
        // One that lets something be seen.
        do this.taken++;
        while (!due().length);
        for (const chart of due()) {
            const { every, method } = chart;
            library.scene(method, { ...PLACE, h: scene.h * every });
            chart.cat = library.carried(chart.cat, 1);
            chart.at = this.taken;
        }
        return true;
    }

    play(on) {
        clearTimeout(this.waiting);
        this.waiting = 0;
        if (on) {
            this.advance();
            const pause = Math.max(1000 * this.scene.h, QUICK);
            this.waiting = setTimeout(() => this.play(true), calm.matches ? SLOW : pause);
        }
        this.run.textContent = on ? 'Pause' : 'Play';
        if (!on && this.taken && !this.foreseen) this.say(this.summary());
    }

    summary() {
        const areas = this.charts
            .filter(({ method }) => method)
            .map(({ method, ratio }) => `${method.title} ${ratio}`);
        return `The cat’s area, relative to the start: ${areas.join(', ')}.`;
    }

    show() {
        const { library, scene } = this;
        this.settle();
        this.fair.checked = scene.fair;
        let worst = 0;
        for (const [i, chart] of this.charts.entries()) {
            const { cat, heading, method, plane } = chart;
            this.selects[i].value = method?.name ?? '';
            plane.clear();
            this.draw(plane, this.cat, null);
            if (!method) {
                heading.replaceChildren('no method');
                continue;
            }
            library.scene(method, { ...PLACE, h: scene.h });
            const truth = library.followed(this.outline(this.cat), scene.h * chart.at);
            worst = Math.max(worst, Math.abs(library.area(truth) / this.size - 1));
            chart.ratio = ratio(library.area(this.outline(cat)) / this.size);
            if (chart.at) {
                this.draw(plane, cat, method);
                plane.curve([...truth, ...truth.subarray(0, 2)]);
            }
            heading.replaceChildren(`${method.title}: area × ${chart.ratio}`);
        }
        const steps = `t = ${(scene.h * this.taken).toFixed(2)} s`;
        const error = worst < 5e-5 ? 'less than 0.01' : (100 * worst).toFixed(2);
        this.time.textContent = this.taken
            ? `${steps}; ${this.cat.length / 2} points, whose area is off by ${error} %`
            : `${steps}; ${this.cat.length / 2} points`;
    }

    draw(plane, cat, method) {
        let from = 0;
        for (const end of this.ends) {
            plane.curve(cat.subarray(from, end), { method, filled: true, thin: true });
            from = end;
        }
    }
};

// A ratio of areas: to a thousandth, or in four digits where it is large.
const ratio = x => (!Number.isFinite(x) ? '–' : Math.abs(x) < 10 ? x.toFixed(3) : measured(x));
