// One step of a method taken apart: the reader moves the start and the step, and sees the parts of
// the step, its end beside the true motion's, and what becomes of a square. And the level curve of
// symplectic Euler's modified energy, built term by term under a slider, with the points of the
// method.
'use strict';

// Numbered as in book/dynamics/src/parts.rs.
const SLOPE = 0;
const NAMES = ['slope', 'kick', 'drift'];
// The axes of the still figure, and those of the whole plane.
const NEAR = { theta: [-1.6, 1.6], omega: [0, 5] };
const WIDE = { theta: [-3.5, 3.5], omega: [-9, 9] };
const START = { theta: -1.2, omega: 1 };
// The side of the square (rad), and the pieces of each of its sides.
const SIDE = 0.3;
const SIDE_PIECES = 24;
// RK4's slopes are drawn a quarter of a step long, each is followed from the start for a time, and
// the step is their average, as the still figure has them: shares of the step and their names.
const SHARE = 0.25;
const FOLLOWED = ['h/2', 'h/2', 'h'];
const WEIGHTS = [1 / 6, 1 / 3, 1 / 3, 1 / 6];
const AVERAGED = ['h/6', 'h/3', 'h/3', 'h/6'];
const HEADINGS = ['Where each slope is taken', 'How they are averaged'];

const signed = (x, digits) => x.toFixed(digits).replace('-', '−');

figures.stencil = class extends Moved {
    constructor(spot, library, number) {
        super(spot, library, number);
        this.method = library.method(spot.dataset.method);
        this.first = { ...START, h: Number(spot.dataset.step) };
        this.scene = { ...this.first };
        // The frames of the still figure: one, or for several slopes two.
        const axes = [...spot.querySelectorAll('figure > svg .axis')];
        const frames = axes.map(axis => axis.getAttribute('d').match(/[\d.]+/g).slice(0, 4));
        this.planes = frames.map((frame, i) => {
            const [left, top, bottom, right] = frame.map(Number);
            const named = { theta: i === frames.length - 1, omega: true };
            if (frames.length > 1)
                this.svg.append(words(HEADINGS[i], { x: left, y: top - 42 }));
            return new Plane(
                this.svg,
                `${this.name}-${i}`,
                [left, top, right, bottom],
                NEAR,
                named,
            );
        });
        [this.plane] = this.planes;
        this.start = handle(
            this.plane,
            'Start of the step: the arrow keys move it',
            [0.05, 0.1],
            (theta, omega) =>
                this.change({
                    theta: Math.round(1000 * theta) / 1000,
                    omega: Math.round(1000 * omega) / 1000,
                }),
        );
        this.lay();
    }

    lay() {
        const h = this.slider('h', 'Step h', 's', { from: 0.01, to: 1, by: 0.01 });
        this.wide = button('wide', 'Whole plane', () => {
            const pressed = this.wide.getAttribute('aria-pressed') !== 'true';
            this.view(pressed);
            this.show();
        });
        this.rows = ['start', 'end of the step', 'true motion'].map(name => {
            const cells = [element('td'), element('td')];
            return { cells, row: markup`<tr><th scope="row">${name}</th>${cells}</tr>` };
        });
        this.area = element('output', { class: 'area' });
        this.every = element('div');
        const reset = button('reset', 'Reset', () => {
            this.view(false);
            this.change(this.first);
        });
        this.controls.append(
            markup`<div class="buttons">${[h, reset, this.wide]}</div>`,
            markup`<table>
                <thead>
                    <tr><td></td><th scope="col">θ (rad)</th><th scope="col">ω (rad/s)</th></tr>
                </thead>
                <tbody>${this.rows.map(({ row }) => row)}</tbody>
            </table>`,
            markup`<p class="note">${this.area}</p>`,
            everyDigit(this.every),
        );
        this.view(false);
    }

    view(wide) {
        this.wide.setAttribute('aria-pressed', wide);
        const { theta, omega } = wide ? WIDE : NEAR;
        for (const plane of this.planes) plane.frame(theta, omega);
        // The start has to be in sight.
        const { scene, plane } = this;
        const [x, y] = [plane.x(scene.theta), plane.y(scene.omega)];
        [scene.theta, scene.omega] = plane.at(x, y).map(v => Math.round(1000 * v) / 1000);
    }

    // The parts of the step: what each is, its share of the step, from where to where.
    parts() {
        const count = this.library.exports.step_parts();
        const numbers = this.library.points(3 * count);
        return Array.from({ length: count }, (_, i) => {
            const [kind, share, ...ends] = numbers.subarray(6 * i, 6 * i + 6);
            return { kind, share, from: ends.slice(0, 2), to: ends.slice(2) };
        });
    }

    show() {
        const { library, method, planes, scene } = this;
        // The last shows the step as a whole.
        const plane = planes.at(-1);
        library.scene(method, scene);
        const start = Float64Array.of(scene.theta, scene.omega);
        const parts = this.parts();
        const end = library.carried(start, 1),
            truth = library.followed(start, scene.h);
        const square = library.shape(0, SIDE, SIDE_PIECES),
            image = library.carried(square, 1);
        const ratio = library.area(image) / library.area(square);
        const orbit = library.orbit(scene, 401);
        for (const each of planes) {
            each.clear();
            each.curve(orbit);
        }
        plane.curve(square, { filled: true, thin: true });
        plane.curve(image, { method, filled: true, thin: true });
        if (planes.length > 1) {
            this.drawSlopes(parts, start, truth);
            this.drawAverage(parts, start);
        } else this.drawParts(parts, truth);
        this.tell(image, ratio);
        plane.markers(truth);
        plane.markers([...start, ...end], method);
        const point = `θ ${signed(start[0], 3)} rad, ω ${signed(start[1], 3)} rad/s`;
        this.start.put(start[0], start[1], point);
        this.settle();
        this.entries();
        [start, end, truth].forEach((z, i) => {
            z.forEach((value, k) => {
                this.rows[i].cells[k].textContent = signed(value, 4);
            });
        });
        this.area.textContent =
            `The step makes a square of ${SIDE} rad × ${SIDE}\u00a0ω₀ about the start ` +
            `${ratio.toFixed(4)} times as large; both measured as polygons of ` +
            `${image.length / 2} points.`;
        this.spell(end);
    }

    entries() {
        const { method, planes, scene } = this;
        const own = colour(method);
        const ring = 'M18,0m-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z';
        const arrow = 'M0,0h36m-10,-5l10,5 -10,5';
        const slopes = [
            ['followed from the start', arrow, `line ${own}`],
            ['a slope', arrow, `line bold ${own}`],
        ];
        const step = [
            ['true orbit', 'M0,0h36', 'line'],
            [method.title, `M18,0${look(method).marker}`, `dot ${own}`],
        ];
        const ends = [
            [`true motion after ${scene.h} s`, ring, 'dot'],
            ['a square, and its image', 'M4,-7h28v14h-28z', `line fill thin ${own}`],
        ];
        if (planes.length > 1) this.legend([...step, ...slopes], ends, planes[1].top - 90);
        else this.legend([...step, ...ends]);
    }

    // Above the square's image, or beside or below it where there is no room, how large it is.
    // Above that of several slopes there is the name of the last, and below that of one its arrow.
    tell(image, ratio) {
        const plane = this.planes.at(-1);
        const [xs, ys] = [0, 1].map(k => image.filter((_, i) => i % 2 === k));
        const x = plane.x((Math.min(...xs) + Math.max(...xs)) / 2);
        const above = plane.y(Math.max(...ys)) - 8,
            below = plane.y(Math.min(...ys)) + 22;
        const low = this.planes.length > 1 && below < plane.bottom - 6;
        const beside = plane.x(Math.max(...xs)) + 8;
        const words = `area × ${ratio.toFixed(3)}`;
        const fits = above > plane.top + 16;
        // As wide as its letters at most.
        const hasRoom = beside > plane.left && beside + 100 < plane.right && below > plane.top;
        if (!low && !fits && hasRoom) {
            const middle = Math.max((above + below) / 2, plane.top + 16);
            return plane.note(beside, middle, words, 'start');
        }
        const y = !low && fits ? above : below;
        if (x > plane.left && x < plane.right && y > plane.top && y < plane.bottom)
            plane.note(x, y, words, 'middle');
    }

    // Kicks and drifts, or a slope that is followed to the end.
    drawParts(parts, truth) {
        const { method, plane } = this;
        for (const { kind, share, from, to } of parts) {
            const part = { 1: '', 0.5: '½ ' }[share] ?? `${share.toFixed(2)} `;
            const name = kind === SLOPE ? 'tangent' : part + NAMES[kind];
            plane.arrow(from, to, method, name, { taken: truth[0] });
        }
    }

    // Where each slope is taken: the one before has led there from the start.
    drawSlopes(parts, start, truth) {
        const { method, plane } = this,
            taken = truth[0];
        parts.slice(1).forEach(({ from }, i) => {
            // The name of the first stands beyond the arrow of the slope.
            const how = i ? { low: true } : { taken, along: 0.75 };
            plane.arrow(start, from, method, `k_{${i + 1}} ${FOLLOWED[i]}`, how);
        });
        parts.forEach(({ from, to }, i) => {
            const tip = from.map((value, k) => value + SHARE * (to[k] - value));
            const how = { taken, along: 1, ahead: i > 0, bold: true };
            plane.arrow(from, tip, method, `k_{${i + 1}}`, how);
        });
        plane.markers(start, method);
    }

    // The slopes one after the other, each for its share of the step.
    drawAverage(parts, start) {
        const { method } = this,
            plane = this.planes.at(-1);
        let at = [...start];
        parts.forEach(({ from, to }, i) => {
            const next = at.map((value, k) => value + WEIGHTS[i] * (to[k] - from[k]));
            // The last ends where the step does: its name stands where there is more room.
            const how = i < 3 ? { low: true } : { along: 0 };
            plane.arrow(at, next, method, `k_{${i + 1}} ${AVERAGED[i]}`, how);
            at = next;
        });
    }

    // Every digit, with the command that prints the same.
    spell([theta, omega]) {
        const { method, scene } = this;
        const start = { theta0: scene.theta, omega0: scene.omega, dt: scene.h, ...PENDULUM };
        const values = [
            ['theta', theta, 'theta'],
            ['omega', omega, 'omega'],
        ];
        const command = simulate(method.name, start, 1);
        this.every.replaceChildren(...spelt('The step ends at ', values, command));
    }
};

const TILTED = { theta: 1, omega: 0, h: 0.25, order: 7, steps: 25 };
// Points on a curve.
const POINTS = 401;

figures.tilted = class extends Moved {
    constructor(spot, library, number) {
        super(spot, library, number);
        this.method = library.method('symplectic-euler');
        this.scene = { ...TILTED };
        const { svg, width, height } = this;
        const box = [38, 95, width - 20, height - 56];
        this.plane = new Plane(svg, this.name, box, { theta: [-1.3, 1.3], omega: [-3.6, 3.6] });
        this.lay();
    }

    lay() {
        const sliders = [
            this.slider('h', 'Step h', 's', { from: 0.02, to: 0.4, by: 0.01 }),
            this.slider('order', 'Terms', '', { from: 0, to: 7, by: 1 }),
            this.slider('steps', 'Steps taken', '', { from: 0, to: 200, by: 1 }),
            this.slider('theta', 'Released from', 'rad', { from: 0.2, to: 2.6, by: 0.1 }),
        ];
        this.strays = element('output', { class: 'strays' });
        const step = button('step', 'One step', () =>
            this.change({ steps: Math.min(this.scene.steps + 1, 200) }),
        );
        const reset = button('reset', 'Reset', () => this.change(TILTED));
        this.controls.append(
            markup`<div class="sliders">${sliders}</div>`,
            markup`<div class="buttons">${[step, reset]}</div>`,
            markup`<p class="note">${this.strays}</p>`,
        );
    }

    show() {
        const { library, method, plane, scene } = this,
            { order, steps } = scene;
        this.settle();
        library.scene(method, scene);
        const orbit = library.level(0, POINTS),
            curve = library.level(order, POINTS);
        // The orbit leaves its points where `strays` looks for them.
        const count = library.exports.orbit(steps + 1),
            points = library.points(count);
        const off = [0, order].map(n => library.exports.strays(n, count));
        const most = 2 * Math.sqrt(PENDULUM.g) * Math.sin(scene.theta / 2);
        plane.frame([-1.3 * scene.theta, 1.3 * scene.theta], [-1.2 * most, 1.2 * most]);
        plane.clear();
        plane.curve(orbit);
        if (order > 0) plane.curve(curve, { dash: '7 4' });
        plane.markers(points, method);
        this.entries();
        const lost = curve.some(Number.isNaN);
        this.strays.textContent =
            `Over these steps H strays from its start by up to ${measured(off[0])}\u00a0J` +
            (order === 0
                ? '.'
                : lost
                  ? '; the level curve of the modified energy leaves the well, and does not close.'
                  : `, and the modified energy by up to ${measured(off[1])}\u00a0J.`);
    }

    entries() {
        const { method, scene } = this,
            own = colour(method);
        const terms = scene.order === 1 ? 'one term' : `${scene.order} terms`;
        this.legend([
            ['true orbit, H', 'M0,0h36', 'line'],
            [`${method.title}, h = ${scene.h} s`, `M18,0${look(method).marker}`, `dot ${own}`],
            ...(scene.order ? [[`modified energy, ${terms}`, 'M0,0h36', 'line', '7 4']] : []),
        ]);
    }
};
