// The figures that a reader moves. Each is first the still figure of the chapter, as on paper, in
// print.html and without scripts; once the library is here, the same drawing stands in its place,
// with its controls. The library computes every number: these files handle input, drawing and text.
'use strict';

// The pendulum of all of them, the paper's.
const PENDULUM = { g: 9.81, L: 1 };

// The library with the points that it shares with the page.
class Library {
    constructor(exports) {
        this.exports = exports;
        this.methods = methodsOf(exports);
    }

    method(name) {
        const method = this.methods.find(known => known.name === name);
        if (!method) throw new Error(`no method ${name}`);
        return method;
    }

    // Sets what the functions below are about.
    scene(method, { theta, omega, h }) {
        const { g, L } = PENDULUM;
        this.exports.scene(method.number, g, L, theta, omega, h);
    }

    // The first `count` points as the library sees them, pairs of θ and ω.
    view(count) {
        const { memory } = this.exports;
        return new Float64Array(memory.buffer, this.exports.points_at(), 2 * count);
    }

    // Writes points, and says how many.
    write(points) {
        this.view(points.length / 2).set(points);
        return points.length / 2;
    }

    // A copy of them.
    points(count) {
        return this.view(count).slice();
    }

    // The images of points under `steps` steps, or under the exact motion for a time.
    carried(points, steps) {
        const count = this.write(points);
        this.exports.carry(steps, count);
        return this.points(count);
    }

    followed(points, t) {
        const count = this.write(points);
        this.exports.follow(t, count);
        return this.points(count);
    }

    shape(which, size, pieces) {
        return this.points(this.exports.shape(which, size, pieces));
    }

    // The area of a polygon (rad²/s).
    area(polygon) {
        return this.exports.area(this.write(polygon));
    }

    level(order, count) {
        this.exports.level_curve(order, count);
        return this.points(count);
    }

    // The exact orbit through the scene's start, a turn of it each way.
    orbit({ theta, omega }, count) {
        const { g, L } = PENDULUM,
            { exports } = this;
        exports.set(0, 0, 0, g, L, 0, theta, omega, 0.01, 0, 0);
        const period = exports.read(0, PERIOD);
        const points = new Float64Array(2 * count);
        for (let i = 0; i < count; i++) {
            const t = period * ((2 * i) / (count - 1) - 1);
            points[2 * i] = exports.exact_theta(0, t);
            points[2 * i + 1] = exports.exact_omega(0, t);
        }
        return points;
    }
}

// What the figures have in common: the drawing in place of the still one, and the controls.
class Moved {
    constructor(spot, library, number) {
        Object.assign(this, { spot, library, name: `moved-${number}`, sliders: {} });
        const still = spot.querySelector('figure > svg');
        const [, , width, height] = still.getAttribute('viewBox').split(' ').map(Number);
        Object.assign(this, { width, height });
        this.svg = drawn('svg', {
            class: 'moved',
            viewBox: `0 0 ${width} ${height}`,
            role: 'group',
            'aria-label': still.querySelector('title').textContent,
        });
        this.controls = element('div', { class: 'controls' });
        this.said = element('p', { class: 'note said', role: 'status' });
        this.live = element('div', { class: 'live' }, this.svg, this.controls);
    }

    // Puts it in the place of the still figure.
    come() {
        this.spot.prepend(this.live);
        this.spot.classList.add('on');
    }

    // Sets the entries of the legend, two to a row: [text, path, class, dash]; those of a second
    // chart stand above it, at this height.
    legend(first, second = [], height = 0) {
        const group = drawn('g', { class: 'legend' });
        const place = (entry, i, from) => ({ entry, i, y: from + 25 * Math.floor(i / 2) });
        const all = [
            ...first.map((entry, i) => place(entry, i, 13)),
            ...second.map((entry, i) => place(entry, i, height)),
        ];
        all.forEach(({ entry: [text, d, classes, dash = ''], i, y }) => {
            const x = i % 2 ? this.width / 2 - 10 : 1;
            group.append(
                drawn('path', {
                    class: classes,
                    d,
                    'stroke-dasharray': dash,
                    transform: `translate(${x},${y})`,
                }),
                words(text, { x: x + 45, y: y + 6 }),
            );
        });
        this.svg.querySelector('.legend')?.remove();
        this.svg.prepend(group);
    }

    // A slider of the scene, with its value beside it.
    slider(key, label, unit, { from, to, by }) {
        const value = element('output', {});
        const range = field('range', key, [from, to, by], {
            oninput: () => this.change({ [key]: Number(range.value) }),
        });
        const digits = (String(by).split('.')[1] ?? '').length;
        this.sliders[key] = now => {
            range.value = now;
            const text = `${now.toFixed(digits)}${unit ? `\u00a0${unit}` : ''}`;
            value.textContent = text.replace('-', '−');
            range.setAttribute('aria-valuetext', text);
        };
        return markup`<label class="slider"><span>${label}</span>${range}${value}</label>`;
    }

    // Shows the scene on the sliders.
    settle() {
        for (const [key, show] of Object.entries(this.sliders)) show(this.scene[key]);
    }

    // Changes some of the scene.
    change(some) {
        Object.assign(this.scene, some);
        this.show();
    }

    say(text) {
        if (this.said.textContent !== text) this.said.textContent = text;
    }
}

// The kinds of them by name, each with a `show()`.
const figures = {};

async function start() {
    const spots = [...document.querySelectorAll('.lab-figure')];
    if (!spots.length) return;
    const still = /\/print\.html$/.test(location.pathname);
    try {
        if (still || typeof WebAssembly !== 'object') throw null;
        const { exports } = await WebAssembly.instantiate(await compiled());
        const library = new Library(exports);
        spots.forEach((spot, i) => {
            const kind = spot.dataset.figure;
            if (!Object.hasOwn(figures, kind)) throw new Error(`no figure ${kind}`);
            spot.moved = new figures[kind](spot, library, i);
            spot.moved.come();
            spot.moved.show();
        });
    } catch (error) {
        // The room that was kept for controls.
        for (const spot of spots) spot.classList.add('off');
        if (error) console.error(`figures: ${error.message}`);
    }
}

// Once the kinds of figures are known: they come after this file, or later in the same.
if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', start);
else queueMicrotask(start);
