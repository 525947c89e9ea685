// The lab: pendulums that the reader moves. What moves them is the library itself, compiled to WebAssembly by
// book/lab/build; here is only what is drawn, asked for and shown. On paper, without scripts and in the book as one page,
// what stands inside an element of class `lab` stays as it is.
(() => {
'use strict';

const places = [...document.querySelectorAll('.lab')];
if (!places.length || /\/print\.html$/.test(location.pathname)) return;
const HERE = document.currentScript.src;

// ---------------------------------------------------------------------------------------------------------------------
// What may be asked for
// ---------------------------------------------------------------------------------------------------------------------

const PAPERS = ['forward-euler', 'symplectic-euler', 'rk4', 'stormer-verlet'];
const SCENE = {
    methods: PAPERS, theta0: 1, omega0: 0, dt: 0.01, g: 9.81, L: 1, beta: 0, speed: 1, scale: 'linear', until: 0,
};
// The lessons of lab.md, by the names of their headings, and what a small lab in a chapter shows of them.
const PRESETS = {
    'over-the-top': {title: 'Forward Euler goes over the top', theta0: 1.5, dt: 0.03, shows: 'energy'},
    'kick-then-drift': {
        title: 'One letter apart', methods: ['forward-euler', 'symplectic-euler'], theta0: 2, dt: 0.05, shows: 'energy',
    },
    'bounded': {
        title: 'Bounded, and how', methods: ['symplectic-euler', 'stormer-verlet'], theta0: 2, dt: 0.02, shows: 'energy',
    },
    'for-an-hour': {
        title: 'RK4 against Verlet for an hour', methods: ['rk4', 'stormer-verlet'], theta0: 1, dt: 0.05, speed: 100,
        scale: 'log', until: 3600, shows: 'energy',
    },
    'last-torus': {
        title: 'The last torus', methods: ['symplectic-euler', 'stormer-verlet'], theta0: 3, dt: 0.314455,
        speed: 1000, shows: 'energy',
    },
    'hidden-order': {
        // From here the period is 2.14 s, a whole number of steps.
        title: 'One period hides the order', methods: ['symplectic-euler', 'stormer-verlet'], theta0: 1.00304559,
        dt: 0.0214, scale: 'log', until: 2.14, shows: 'angle',
    },
    'too-long-a-step': {
        title: 'A step too long', methods: PAPERS, theta0: 0.2, dt: 0.66, speed: 10, scale: 'log', shows: 'energy',
    },
};
// label, unit, least and greatest of the slider and of what may be typed, step of the slider; the step Δt is logarithmic.
const SLIDERS = {
    dt: {label: 'Step Δt', unit: 's', from: -3, to: 0.2, by: 0.01, least: 1e-5, most: 3, logarithmic: true},
    theta0: {label: 'Angle θ₀', unit: 'rad', from: -3.14, to: 3.14, by: 0.01, least: -100, most: 100},
    omega0: {label: 'Velocity ω₀', unit: 'rad/s', from: -15, to: 15, by: 0.05, least: -1000, most: 1000},
    g: {label: 'Gravity g', unit: 'm/s²', from: 0.1, to: 25, by: 0.01, least: 0.001, most: 1000},
    L: {label: 'Length L', unit: 'm', from: 0.1, to: 5, by: 0.01, least: 0.001, most: 1000},
    beta: {label: 'Damping β', unit: '1/s', from: 0, to: 2, by: 0.01, least: 0, most: 10},
};
const SPEEDS = [0.1, 0.25, 1, 2, 10, 100, 1000];

// Numbered as in book/lab/src/bench.rs.
const THETA = 0, OMEGA = 1, TIME = 2, STEPS = 3, EVALUATIONS = 4, ENERGY = 5, ERROR = 6, LOWEST = 7, HIGHEST = 8,
    LARGEST = 9, LIMIT = 10, PERIOD = 11, INITIAL = 12;

// As in the figures: a method's colour, marker and dash are those of its place in the library's list. A test in
// src/report/svg/style.rs holds the two together.
const COLOURS = ['vermilion', 'blue', 'green', 'purple', 'ochre', 'sky'];
const MARKERS = [
    'm-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z',
    'm-4.6,-4.6h9.2v9.2h-9.2z',
    'm0,-6.4l6.4,6.4 -6.4,6.4 -6.4,-6.4z',
    'm0,-6.4l6,10.4h-12z',
    'm-2,-6h4v4h4v4h-4v4h-4v-4h-4v-4h4z',
    'm0,-2.6l3.4,-3.4 2.6,2.6 -3.4,3.4 3.4,3.4 -2.6,2.6 -3.4,-3.4 -3.4,3.4 -2.6,-2.6 3.4,-3.4 -3.4,-3.4 2.6,-2.6z',
    'm0,6.4l6,-10.4h-12z',
    'm-5.4,-5.4h10.8l-10.8,10.8h10.8z',
];
const DASHES = [[], [14, 5], [14, 4, 2, 4], [7, 4]];

// A trajectory is drawn with this many bins at most; as it grows, two become one.
const BINS = 512;
// The closed form and the phase portrait see this many samples a frame at most, and what is kept of them is this many.
const SAMPLES = 64, TRAIL = 4096;
// What a frame may take of the sixtieth of a second, in ms.
const BUDGET = 9;
const TURN = 2 * Math.PI;

// ---------------------------------------------------------------------------------------------------------------------
// Small things
// ---------------------------------------------------------------------------------------------------------------------

const calm = matchMedia('(prefers-reduced-motion: reduce)');
const wrapped = theta => theta - TURN * Math.round(theta / TURN);

function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
        else if (value !== undefined && value !== false) made.setAttribute(key, value === true ? '' : value);
    }
    made.append(...children);
    return made;
}

function raised(exponent) {
    return [...String(exponent)].map(sign => '⁰¹²³⁴⁵⁶⁷⁸⁹'[sign] ?? '⁻').join('');
}

// Four significant digits, as in the tables.
function brief(x, digits = 4) {
    if (!Number.isFinite(x)) return '–';
    if (x === 0) return '0';
    const size = Math.abs(x);
    if (size >= 1e-3 && size < 1e6) return String(Number(x.toPrecision(digits))).replace('-', '−');
    const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
    return `${mantissa.replace('-', '−')} × 10${raised(Number(exponent))}`;
}

function count(n) {
    return String(n).replace(/\B(?=(\d{3})+$)/g, ' ');
}

// 1, 2 or 5 times a power of ten, not below x.
function round(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 2, 5, 10].map(m => m * power).find(tick => tick >= x * (1 - 1e-9));
}

// ---------------------------------------------------------------------------------------------------------------------
// A scene and its address
// ---------------------------------------------------------------------------------------------------------------------

function presetScene(name) {
    const {title, shows, ...given} = PRESETS[name];
    return {...SCENE, ...given};
}

function address(scene) {
    const parts = [`m=${scene.methods.join(',')}`];
    for (const key of Object.keys(SLIDERS)) parts.push(`${key}=${scene[key]}`);
    parts.push(`speed=${scene.speed}`, `scale=${scene.scale}`);
    if (scene.until) parts.push(`until=${scene.until}`);
    return parts.join('&');
}

// The scene of an address, or null where it is none. What it does not name is as in SCENE, and what cannot be is left out.
function addressed(hash, known) {
    const name = hash.replace(/^#/, '');
    if (Object.hasOwn(PRESETS, name)) return presetScene(name);
    if (!name.includes('=')) return null;
    const given = new URLSearchParams(name);
    const scene = {...SCENE};
    const methods = (given.get('m') ?? '').split(',').filter((m, i, all) => known.includes(m) && all.indexOf(m) === i);
    if (methods.length) scene.methods = methods.slice(0, 8);
    for (const [key, {least, most}] of Object.entries(SLIDERS)) {
        const value = given.has(key) ? Number(given.get(key)) : NaN;
        if (value >= least && value <= most) scene[key] = value;
    }
    if (SPEEDS.includes(Number(given.get('speed')))) scene.speed = Number(given.get('speed'));
    if (given.get('scale') === 'log') scene.scale = 'log';
    const until = given.get('until');
    if (Number(until) > 0) scene.until = Number(until);
    return scene;
}

// ---------------------------------------------------------------------------------------------------------------------
// The library
// ---------------------------------------------------------------------------------------------------------------------

// The compiled module: from a script, as a page that was opened from a disk may load nothing else.
function compiled() {
    return new Promise((resolve, reject) => {
        const script = element('script', {src: new URL('../assets/lab.wasm.js', HERE)});
        script.addEventListener('load', () => {
            const bytes = Uint8Array.from(atob(globalThis.pendulaLab), letter => letter.charCodeAt(0));
            resolve(WebAssembly.compile(bytes));
        });
        script.addEventListener('error', () => reject(new Error('lab.wasm.js is missing')));
        document.head.append(script);
    });
}

// The methods of the library: number, name, title, and how they look.
function methodsOf(library) {
    const text = (method, which) => {
        const at = library.text_at(method, which), length = library.text_length(method, which);
        return new TextDecoder().decode(new Uint8Array(library.memory.buffer, at, length));
    };
    return Array.from({length: library.methods()}, (_, number) => ({
        number,
        name: text(number, 0),
        title: text(number, 1),
        colour: `--pendula-${COLOURS[number % COLOURS.length]}`,
        marker: MARKERS[number % MARKERS.length],
        dash: DASHES[number % DASHES.length],
    }));
}

// What was seen of one quantity: its extremes in bins of `width` steps.
class Series {
    constructor() {
        this.low = new Float64Array(BINS);
        this.high = new Float64Array(BINS);
        this.width = 1;
        this.length = 0;
    }

    // The sample after `steps` steps, with the extremes since the last.
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

    // The largest size of what was seen.
    get largest() {
        let largest = 0;
        for (let i = 0; i < this.length; i++) largest = Math.max(largest, this.high[i], -this.low[i]);
        return largest;
    }
}

// One method on its way, in one place of the library.
class Pendulum {
    constructor(library, place, method) {
        Object.assign(this, {library, place, method, energy: new Series(), angle: new Series(), spent: 0, lapse: 0});
        this.trail = new Float32Array(2 * TRAIL);
        this.points = 0;
    }

    read(quantity) {
        return this.library.read(this.place, quantity);
    }

    // Takes `steps` steps and notes what was seen; `exact` is the angle in closed form at their end.
    advance(steps) {
        const before = performance.now();
        const taken = this.library.advance(this.place, steps);
        this.spent += performance.now() - before;
        return taken;
    }

    note(exact, offset) {
        const steps = this.read(STEPS), theta = this.read(THETA);
        // An implicit method whose equations have not been solved has no numbers any more.
        this.lost = Number.isNaN(theta);
        if (this.lost) return;
        this.energy.add(steps, offset + this.read(LOWEST), offset + this.read(HIGHEST));
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

// ---------------------------------------------------------------------------------------------------------------------
// Drawing
// ---------------------------------------------------------------------------------------------------------------------

// A canvas that is as sharp as the screen, and drawn in CSS pixels.
class Sheet {
    constructor(what) {
        this.canvas = element('canvas', {role: 'img', 'aria-label': what});
        this.width = this.height = 0;
        this.ink = this.canvas.getContext('2d');
    }

    // Whether the size has changed.
    fit(width, height) {
        const scale = Math.min(devicePixelRatio || 1, 2);
        const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
        const changed = this.canvas.width !== w || this.canvas.height !== h;
        if (changed) {
            Object.assign(this.canvas, {width: w, height: h});
            this.canvas.style.height = `${height}px`;
        }
        Object.assign(this, {width, height, scale});
        this.ink.setTransform(scale, 0, 0, scale, 0, 0);
        return changed;
    }

    clear() {
        this.ink.clearRect(0, 0, this.width, this.height);
    }
}

function mark(ink, path, x, y, size, colour, hollow) {
    ink.save();
    ink.translate(x, y);
    ink.scale(size, size);
    ink.fillStyle = ink.strokeStyle = colour;
    ink.lineWidth = 1.6 / size;
    if (hollow) ink.stroke(path);
    else ink.fill(path);
    ink.restore();
}

const FONT = '13px "Open Sans", system-ui, sans-serif';

class Drawing {
    constructor(lab) {
        this.lab = lab;
        this.stage = new Sheet('');
        this.phase = new Sheet('');
        this.energy = new Sheet('');
        this.angle = new Sheet('');
        this.trails = document.createElement('canvas');
        this.drawn = [];
        this.reach = 0;
    }

    colours() {
        const style = getComputedStyle(document.documentElement);
        this.colour = name => style.getPropertyValue(name).trim();
        this.ink = this.colour('--fg') || '#000';
        this.paper = this.colour('--bg') || '#fff';
        this.looks = new Map(this.lab.known.map(method => [
            method.number, {colour: this.colour(method.colour), path: new Path2D(method.marker), dash: method.dash},
        ]));
    }

    // Sizes from the width there is; everything is drawn anew.
    layout() {
        this.colours();
        const width = sheet => sheet.canvas.parentElement?.clientWidth ?? 0;
        const stage = width(this.stage), n = this.lab.pendulums.length || 1;
        this.down = Math.ceil(n / Math.max(1, Math.floor(stage / 100)));
        this.across = Math.ceil(n / this.down);
        this.cell = Math.min(stage / this.across, this.lab.whole ? 230 : 190);
        this.stage.fit(stage, this.down * (this.cell + 20));
        for (const sheet of [this.phase, this.energy, this.angle].filter(sheet => sheet.canvas.isConnected)) {
            const own = width(sheet);
            const height = Math.round(Math.min(Math.max(own * 0.62, 200), 300));
            // Beside two others it is as high as both.
            const tall = sheet === this.phase && this.lab.whole && own < 0.6 * stage;
            if (own) sheet.fit(own, tall ? 2 * height - 12 : height);
        }
        this.reach = 0;
        this.all();
    }

    all() {
        this.base();
        this.pendulums();
        this.portrait();
        this.plots();
    }

    // Where the pivot of the i-th pendulum is, and how long its rod.
    pivot(i) {
        const left = (this.stage.width - this.across * this.cell) / 2;
        const L = this.lab.scene.L;
        return {
            x: left + (i % this.across + 0.5) * this.cell,
            y: Math.floor(i / this.across) * (this.cell + 20) + this.cell / 2,
            // Longer where it is longer; in proportion, the shortest would leave nothing to grasp.
            rod: this.cell * (0.25 + 0.14 * L / (L + 1)),
        };
    }

    pendulums() {
        const {stage, lab} = this, ink = stage.ink;
        stage.clear();
        lab.pendulums.forEach((pendulum, i) => {
            const {x, y, rod} = this.pivot(i), look = this.looks.get(pendulum.method.number);
            const bob = theta => [x + rod * Math.sin(theta), y + rod * Math.cos(theta)];
            ink.globalAlpha = 0.25;
            ink.strokeStyle = this.ink;
            ink.lineWidth = 1;
            ink.beginPath();
            ink.arc(x, y, rod, 0, TURN);
            ink.stroke();
            ink.globalAlpha = 1;
            if (Number.isFinite(lab.exact)) {
                const [ex, ey] = bob(lab.exact);
                ink.setLineDash([3, 3]);
                ink.beginPath();
                ink.moveTo(x, y);
                ink.lineTo(ex, ey);
                ink.stroke();
                ink.setLineDash([]);
                ink.beginPath();
                ink.arc(ex, ey, 10, 0, TURN);
                ink.stroke();
            }
            const [bx, by] = bob(pendulum.read(THETA));
            ink.lineWidth = 2;
            ink.strokeStyle = look.colour;
            ink.beginPath();
            ink.moveTo(x, y);
            ink.lineTo(bx, by);
            ink.stroke();
            mark(ink, look.path, bx, by, 1.7, look.colour);
            ink.fillStyle = this.ink;
            ink.beginPath();
            ink.arc(x, y, 2.5, 0, TURN);
            ink.fill();
            ink.font = FONT;
            ink.textAlign = 'center';
            ink.fillText(pendulum.method.title, x, y + this.cell / 2 + 12, this.cell - 4);
        });
    }

    // The frame of the phase portrait in pixels, and the way from (θ, ω) there.
    frame() {
        const {width, height} = this.phase;
        const left = 44, right = width - 10, top = 10, bottom = height - 34;
        return {
            left, right, top, bottom,
            x: theta => left + (theta / TURN + 0.5) * (right - left),
            y: omega => (top + bottom) / 2 - omega / this.reach * (bottom - top) / 2,
            theta: x => ((x - left) / (right - left) - 0.5) * TURN,
            omega: y => ((top + bottom) / 2 - y) / (bottom - top) * 2 * this.reach,
        };
    }

    // What does not move: axes, the exact orbit, the separatrix. It begins the trails anew.
    base() {
        const {phase, lab} = this;
        if (!phase.width) return;
        const top = 2 * Math.sqrt(lab.scene.g / lab.scene.L);
        const speeds = lab.pendulums.map(p => Math.abs(p.read(OMEGA))).filter(Number.isFinite);
        const seen = Math.max(...speeds, Math.abs(lab.scene.omega0), 0);
        if (this.reach === 0 || seen > this.reach) this.reach = round(Math.max(1.25 * top, 1.25 * seen));
        const sheet = Object.assign(this.trails, {width: phase.canvas.width, height: phase.canvas.height});
        const ink = sheet.getContext('2d');
        ink.setTransform(phase.scale, 0, 0, phase.scale, 0, 0);
        const f = this.frame();
        ink.strokeStyle = ink.fillStyle = this.ink;
        ink.font = FONT;
        ink.lineWidth = 1;
        ink.strokeRect(f.left, f.top, f.right - f.left, f.bottom - f.top);
        ink.textBaseline = 'top';
        for (const [theta, label] of [[-Math.PI, '−π'], [0, '0'], [Math.PI, 'π']]) {
            ink.textAlign = theta > 0 ? 'right' : theta < 0 ? 'left' : 'center';
            ink.fillText(label, f.x(theta), f.bottom + 4);
        }
        ink.textAlign = 'center';
        ink.fillText('θ (rad)', (f.left + f.right) / 2, f.bottom + 17);
        ink.textAlign = 'right';
        ink.textBaseline = 'middle';
        for (const omega of [-this.reach, 0, this.reach]) {
            ink.fillText(brief(omega), f.left - 5, Math.min(Math.max(f.y(omega), f.top + 6), f.bottom - 6));
        }
        ink.save();
        ink.translate(12, (f.top + f.bottom) / 2);
        ink.rotate(-Math.PI / 2);
        ink.textAlign = 'center';
        ink.fillText('ω (rad/s)', 0, 0);
        ink.restore();
        ink.save();
        ink.beginPath();
        ink.rect(f.left, f.top, f.right - f.left, f.bottom - f.top);
        ink.clip();
        ink.globalAlpha = 0.75;
        this.curves(ink, f);
        ink.restore();
        this.drawn = lab.pendulums.map(pendulum => Math.max(0, pendulum.points - TRAIL));
    }

    // The separatrix, dotted, and the exact orbit, from the closed form.
    curves(ink, f) {
        const {lab} = this, library = lab.library;
        if (!lab.pendulums.length) return;
        const trace = (state, from, to, sign) => {
            ink.beginPath();
            let before = NaN;
            for (let i = 0; i <= 240; i++) {
                const [theta, omega] = state(from + (to - from) * i / 240);
                const x = wrapped(sign * theta);
                // Across the edge there is no line.
                ink[Math.abs(x - before) < Math.PI ? 'lineTo' : 'moveTo'](f.x(x), f.y(sign * omega));
                before = x;
            }
            ink.stroke();
        };
        const slow = 6 / Math.sqrt(lab.scene.g / lab.scene.L);
        ink.setLineDash([2, 4]);
        for (const sign of [-1, 1]) {
            trace(t => [library.separatrix_theta(0, t), library.separatrix_omega(0, t)], -slow, slow, sign);
        }
        ink.setLineDash([]);
        const period = library.read(0, PERIOD);
        if (Number.isNaN(period)) return;
        ink.lineWidth = 1.5;
        trace(t => [library.exact_theta(0, t), library.exact_omega(0, t)], 0, period, 1);
    }

    portrait() {
        const {phase, lab} = this;
        if (!phase.width) return;
        if (lab.pendulums.some(p => Math.abs(p.read(OMEGA)) > this.reach)) this.base();
        const f = this.frame(), ink = this.trails.getContext('2d');
        ink.save();
        ink.beginPath();
        ink.rect(f.left, f.top, f.right - f.left, f.bottom - f.top);
        ink.clip();
        lab.pendulums.forEach((pendulum, i) => {
            ink.fillStyle = this.looks.get(pendulum.method.number).colour;
            for (let k = Math.max(this.drawn[i], pendulum.points - TRAIL); k < pendulum.points; k++) {
                const at = 2 * (k % TRAIL);
                ink.fillRect(f.x(pendulum.trail[at]) - 0.75, f.y(pendulum.trail[at + 1]) - 0.75, 1.5, 1.5);
            }
            this.drawn[i] = pendulum.points;
        });
        ink.restore();
        phase.clear();
        phase.ink.drawImage(this.trails, 0, 0, phase.width, phase.height);
        const x = f.x(wrapped(lab.scene.theta0)), y = f.y(lab.scene.omega0);
        phase.ink.strokeStyle = this.ink;
        phase.ink.lineWidth = 1.5;
        phase.ink.beginPath();
        phase.ink.arc(x, y, 9, 0, TURN);
        phase.ink.stroke();
        for (const pendulum of lab.pendulums) {
            const look = this.looks.get(pendulum.method.number);
            const at = [f.x(wrapped(pendulum.read(THETA))), f.y(pendulum.read(OMEGA))];
            mark(phase.ink, look.path, ...at, 1, look.colour);
        }
    }

    plots() {
        const {lab} = this, damped = lab.scene.beta > 0;
        this.plot(this.energy, damped ? 'energy (J)' : 'energy error (J)', pendulum => pendulum.energy, damped);
        if (damped && this.angle.width) {
            this.angle.clear();
            this.angle.ink.fillStyle = this.ink;
            this.angle.ink.font = FONT;
            this.angle.ink.textAlign = 'center';
            this.angle.ink.textBaseline = 'middle';
            this.angle.ink.fillText('with damping there is no closed form', this.angle.width / 2, this.angle.height / 2,
                this.angle.width - 20);
        } else if (!damped) {
            this.plot(this.angle, 'angle error (rad)', pendulum => pendulum.angle, false);
        }
    }

    plot(sheet, title, seriesOf, positive) {
        if (!sheet.width) return;
        const {lab} = this, {ink, width, height} = sheet, logarithmic = lab.scene.scale === 'log';
        const left = 66, right = width - 12, top = 24, bottom = height - 34;
        sheet.clear();
        const span = lab.scene.until || round(Math.max(lab.time, 10 * lab.scene.dt, 5));
        const sizes = lab.pendulums.map(pendulum => seriesOf(pendulum).largest);
        const largest = Math.max(...sizes, 0);
        const x = t => left + t / span * (right - left);
        let y, ticks;
        if (logarithmic) {
            const high = Math.ceil(Math.log10(largest > 0 ? largest : 1) + 0.05);
            // Room for the smallest error to grow into.
            const smallest = Math.min(...sizes.filter(size => size > 0), largest || 1);
            const low = Math.min(Math.floor(Math.log10(smallest)) - 2, high - 4);
            const every = Math.ceil((high - low) / 6);
            y = value => bottom - (Math.log10(Math.abs(value)) - low) / (high - low) * (bottom - top);
            ticks = Array.from({length: high - low + 1}, (_, i) => low + i).filter(i => (i - high) % every === 0)
                .map(i => [10 ** i, i === 0 ? '1' : i === 1 ? '10' : `10${raised(i)}`]);
        } else {
            const reach = round(largest > 0 ? largest : 1);
            const least = positive ? 0 : -reach;
            y = value => bottom - (value - least) / (reach - least) * (bottom - top);
            ticks = (positive ? [0, reach / 2, reach] : [-reach, 0, reach]).map(value => [value, brief(value, 3)]);
        }
        ink.strokeStyle = ink.fillStyle = this.ink;
        ink.lineWidth = 1;
        ink.font = FONT;
        ink.textBaseline = 'middle';
        ink.textAlign = 'right';
        for (const [value, label] of ticks) {
            ink.fillText(label, left - 6, y(value), left - 8);
            ink.globalAlpha = 0.2;
            ink.fillRect(left, Math.round(y(value)), right - left, 1);
            ink.globalAlpha = 1;
        }
        ink.strokeRect(left, top, right - left, bottom - top);
        ink.textAlign = 'left';
        ink.fillText(title, left, 12);
        ink.textBaseline = 'top';
        ink.textAlign = 'center';
        for (const t of [0, span / 2, span]) ink.fillText(brief(t), Math.min(x(t), right - 10), bottom + 4);
        ink.fillText('t (s)', (left + x(span / 2)) / 2, bottom + 17);
        ink.save();
        ink.beginPath();
        ink.rect(left, top, right - left, bottom - top);
        ink.clip();
        for (const pendulum of lab.pendulums) {
            const series = seriesOf(pendulum), look = this.looks.get(pendulum.method.number);
            ink.strokeStyle = ink.fillStyle = look.colour;
            ink.lineWidth = 1.8;
            ink.setLineDash(logarithmic ? look.dash : []);
            const time = i => x(Math.min((i + 1) * series.width, lab.taken) * lab.scene.dt);
            ink.beginPath();
            for (let i = 0; i < series.length; i++) {
                const low = series.low[i], high = series.high[i];
                if (logarithmic) {
                    const size = Math.max(Math.abs(low), Math.abs(high));
                    if (size > 0) ink.lineTo(time(i), y(size));
                } else {
                    // The band between the extremes, as a stroke to and fro.
                    ink.lineTo(time(i), y(low));
                    ink.lineTo(time(i), y(high));
                }
            }
            ink.stroke();
            ink.setLineDash([]);
            // Markers tell the lines apart without colours.
            for (const part of [0.3, 0.6, 0.9]) {
                const i = Math.floor(series.length * part);
                const value = logarithmic ? Math.max(Math.abs(series.low[i]), Math.abs(series.high[i])) : series.high[i];
                if (i < series.length && (value > 0 || !logarithmic)) {
                    mark(ink, look.path, time(i), y(value), 0.9, look.colour);
                }
            }
        }
        ink.restore();
    }

    // What is drawn, in words.
    describe() {
        const {lab} = this, names = lab.pendulums.map(pendulum => pendulum.method.title).join(', ');
        const label = (sheet, words) => sheet.canvas.setAttribute('aria-label', words);
        label(this.stage, `Pendulums side by side: ${names}. A ring on a dashed rod is the exact motion. Drag a bob to set the angle θ₀.`);
        label(this.phase, `Phase portrait of ${names}, over the exact orbit and the separatrix. Drag to set θ₀ and ω₀.`);
        label(this.energy, `Energy error over time of ${names}; its numbers are in the table.`);
        label(this.angle, `Angle error against the closed form, of ${names}; its numbers are in the table.`);
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// A lab
// ---------------------------------------------------------------------------------------------------------------------

class Lab {
    constructor(place, instance) {
        this.place = place;
        this.library = instance.exports;
        this.known = methodsOf(this.library);
        // A lab alone on its page has all there is; one within a chapter shows its lesson.
        this.whole = place.classList.contains('whole');
        this.preset = place.dataset.preset;
        this.pendulums = [];
        this.running = false;
        this.most = Infinity;
        this.drawing = new Drawing(this);
        this.scene = presetScene(this.preset);
        this.build();
        this.sense();
        if (this.whole) {
            this.follow(false);
            addEventListener('hashchange', () => this.follow(true));
        }
        this.begin();
        place.classList.add('on');
        let wide = 0;
        new ResizeObserver(([{contentRect: {width}}]) => {
            // The table grows and shrinks; that is no reason to begin the trails anew.
            if (width !== wide) this.drawing.layout();
            wide = width;
        }).observe(this.live);
        new MutationObserver(() => this.drawing.layout())
            .observe(document.documentElement, {attributes: true, attributeFilter: ['class']});
        document.fonts.ready.then(() => this.drawing.layout());
    }

    // The scene in the page's address, if there is one.
    follow(asked) {
        const scene = addressed(location.hash, this.known.map(method => method.name));
        if (!scene) return;
        this.scene = scene;
        this.begin();
        if (asked) {
            this.place.scrollIntoView({block: 'start'});
            this.run(!calm.matches);
        } else {
            this.arrive = true;
        }
    }

    // ------------------------------------------------------------------------------------------------ the scene

    // Every pendulum at its start.
    begin() {
        const {scene, library} = this;
        for (let place = 0; place < library.places(); place++) library.set(place, 0, 0, 0, 0, 0, 0, 0);
        const chosen = scene.methods.map(name => this.known.find(method => method.name === name)).filter(Boolean);
        this.pendulums = [];
        const refused = [];
        for (const method of chosen) {
            const stands = library.set(this.pendulums.length, method.number, scene.g, scene.L, scene.beta, scene.theta0,
                scene.omega0, scene.dt);
            if (stands) this.pendulums.push(new Pendulum(library, this.pendulums.length, method));
            else refused.push(method.title);
        }
        this.taken = this.time = 0;
        this.clock = 0;
        const limits = this.pendulums.map(pendulum => pendulum.read(LIMIT));
        const last = scene.until ? Math.round(scene.until / scene.dt) : Infinity;
        this.limit = Math.min(last, ...limits);
        this.sight();
        this.show();
        if (this.live.isConnected) this.drawing.layout();
        if (refused.length) {
            const why = scene.beta > 0 ? 'does not suit a damped pendulum' : 'is refused this scene';
            this.say(`${refused.join(', ')} ${why}.`);
        }
    }

    // Notes what there is to see at the present step.
    sight() {
        this.exact = this.pendulums.length ? this.library.exact_theta(0, this.time) : NaN;
        const offset = this.scene.beta > 0 && this.pendulums.length ? this.library.read(0, INITIAL) : 0;
        for (const pendulum of this.pendulums) pendulum.note(this.exact, offset);
    }

    // Takes up to `n` steps with every method, in pieces small enough to draw.
    advance(n) {
        const steps = Math.min(n, this.limit - this.taken);
        let piece = 1;
        while (piece * SAMPLES < steps) piece *= 2;
        const end = this.taken + steps;
        while (this.taken < end) {
            const next = Math.min(piece - this.taken % piece, end - this.taken);
            for (const pendulum of this.pendulums) pendulum.advance(next);
            this.taken += next;
            this.time = this.taken * this.scene.dt;
            this.sight();
        }
        return steps === n;
    }

    // The scene with some of it changed, from its start.
    change(some, quietly = false) {
        Object.assign(this.scene, some);
        this.begin();
        if (!quietly) this.remember();
    }

    // The address is that of the scene, as soon as the hand rests.
    remember() {
        if (!this.whole) return;
        clearTimeout(this.pending);
        this.pending = setTimeout(() => {
            history.replaceState(null, '', `#${address(this.scene)}`);
        }, 200);
    }

    // ------------------------------------------------------------------------------------------------ time

    run(on) {
        if (on && this.taken >= this.limit) this.begin();
        this.running = on && this.pendulums.length > 0;
        this.controls.run.textContent = this.running ? 'Pause' : 'Run';
        if (this.running) {
            this.before = performance.now();
            this.clock = this.time;
            this.next();
        } else {
            this.show();
            this.drawing.plots();
            if (this.pendulums.length) this.say(this.summary());
        }
    }

    // For those who ask for little motion, two pictures a second.
    next() {
        clearTimeout(this.waiting);
        cancelAnimationFrame(this.asked);
        if (calm.matches) this.waiting = setTimeout(() => this.frame(performance.now()), 500);
        else this.asked = requestAnimationFrame(now => this.frame(now));
    }

    frame(now) {
        if (!this.running) return;
        const began = performance.now();
        const passed = Math.min(Math.max(now - this.before, 0), calm.matches ? 600 : 100) / 1000;
        this.before = now;
        this.clock += passed * this.scene.speed;
        const due = Math.floor(this.clock / this.scene.dt + 1e-9) - this.taken;
        const n = Math.max(0, Math.min(due, this.most));
        // What cannot be done in time is not made up for.
        if (due > n) this.clock = (this.taken + n) * this.scene.dt;
        const more = this.advance(n);
        const cost = performance.now() - began;
        this.most = cost > BUDGET ? Math.max(1, Math.floor(n * BUDGET / cost)) : Math.max(this.most * 1.1, 64);
        this.controls.slow.hidden = due <= n;
        this.drawing.pendulums();
        this.drawing.portrait();
        // Curves and numbers that change sixty times a second nobody reads.
        this.frames = (this.frames ?? 0) + 1;
        if (this.frames % 3 === 0) this.drawing.plots();
        if (this.frames % 12 === 0 || calm.matches) this.show();
        if (more) this.next();
        else this.run(false);
    }

    // ------------------------------------------------------------------------------------------------ hands

    // Bob and phase portrait can be dragged. A finger elsewhere scrolls the page.
    sense() {
        const drag = (sheet, grasp, move) => {
            const {canvas} = sheet;
            const at = event => {
                const box = canvas.getBoundingClientRect();
                return [event.clientX - box.left, event.clientY - box.top];
            };
            let held = null;
            canvas.addEventListener('touchstart', event => {
                if (grasp(...at(event.touches[0]), 30)) event.preventDefault();
            }, {passive: false});
            canvas.addEventListener('pointerdown', event => {
                held = event.button === 0 ? grasp(...at(event), event.pointerType === 'touch' ? 30 : Infinity) : null;
                if (!held) return;
                canvas.setPointerCapture(event.pointerId);
                this.wasRunning = this.running;
                this.running = false;
                move(held, ...at(event));
            });
            canvas.addEventListener('pointermove', event => {
                if (held) move(held, ...at(event));
            });
            for (const name of ['pointerup', 'pointercancel']) {
                canvas.addEventListener(name, () => {
                    if (!held) return;
                    held = null;
                    this.remember();
                    this.run(!calm.matches);
                });
            }
        };
        const near = (x, y, bx, by, reach) => Math.hypot(x - bx, y - by) <= reach;
        drag(this.drawing.stage, (x, y, reach) => {
            const pivots = this.pendulums.map((pendulum, i) => ({...this.drawing.pivot(i), theta: pendulum.read(THETA)}));
            const distance = p => Math.hypot(x - p.x, y - p.y);
            const own = pivots.sort((a, b) => distance(a) - distance(b))[0];
            if (!own) return null;
            const {x: px, y: py, rod, theta} = own;
            return near(x, y, px + rod * Math.sin(theta), py + rod * Math.cos(theta), Math.min(reach, 0.6 * this.drawing.cell))
                && own;
        }, ({x: px, y: py}, x, y) => {
            const theta0 = Math.round(1000 * Math.atan2(x - px, y - py)) / 1000;
            this.change({theta0, omega0: 0}, true);
        });
        drag(this.drawing.phase, (x, y, reach) => {
            const f = this.drawing.frame();
            const start = [f.x(wrapped(this.scene.theta0)), f.y(this.scene.omega0)];
            return x > f.left && x < f.right && y > f.top && y < f.bottom && near(x, y, ...start, reach) && {...f};
        }, (f, x, y) => {
            const clamp = (value, most) => Math.min(Math.max(value, -most), most);
            const theta0 = Math.round(1000 * clamp(f.theta(x), Math.PI)) / 1000;
            const omega0 = Math.round(100 * clamp(f.omega(y), this.drawing.reach)) / 100;
            this.change({theta0, omega0}, true);
        });
    }

    // ------------------------------------------------------------------------------------------------ the page

    build() {
        const {drawing} = this;
        this.controls = {};
        const c = this.controls;
        c.run = element('button', {type: 'button', class: 'run', onclick: () => this.run(!this.running)}, 'Run');
        c.step = element('button', {type: 'button', class: 'step', onclick: () => {
            this.run(false);
            this.advance(1);
            this.run(false);
            drawing.all();
        }}, 'One step');
        c.again = element('button', {type: 'button', class: 'again', onclick: () => {
            this.run(false);
            this.begin();
            this.say('Back at the start.');
        }}, 'Start again');
        c.slow = element('span', {class: 'slow', hidden: true}, 'as fast as it can');
        c.time = element('output', {class: 'time', 'aria-live': 'off'});
        c.said = element('p', {class: 'said', role: 'status'});
        const figure = (sheet, caption) => element('div', {class: 'sheet'}, sheet.canvas,
            ...caption ? [element('span', {class: 'note'}, caption)] : []);
        const shows = PRESETS[this.preset].shows;
        const sheets = this.whole
            ? [figure(drawing.phase, 'solid: the exact orbit; dotted: the separatrix'), figure(drawing.energy),
                figure(drawing.angle)]
            : [figure(drawing.phase), figure(drawing[shows])];
        this.rows = element('tbody');
        this.live = element('div', {class: 'live', role: 'group', 'aria-label': `Lab: ${PRESETS[this.preset].title}`},
            ...this.whole ? [this.lessons()] : [],
            element('div', {class: 'stage'}, drawing.stage.canvas),
            element('div', {class: 'buttons'}, c.run, c.step, c.again, this.speed(), this.scales(), c.time, c.slow),
            element('div', {class: 'sliders'}, ...Object.keys(SLIDERS)
                .filter(key => this.whole || key === 'dt' || key === 'theta0').map(key => this.slider(key))),
            ...this.whole ? [this.choice()] : [],
            element('div', {class: 'sheets'}, ...sheets),
            element('div', {class: 'table-wrapper'}, element('table', {},
                element('thead', {}, element('tr', {}, ...this.columns().map(([title]) =>
                    element('th', {scope: 'col'}, title)))),
                this.rows)),
            ...this.whole ? [this.digits()] : [this.onward()],
            c.said);
        this.place.append(this.live);
    }

    lessons() {
        const link = name => element('a', {href: `#${name}`, onclick: event => {
            event.preventDefault();
            history.replaceState(null, '', `#${name}`);
            this.scene = presetScene(name);
            this.begin();
            this.run(!calm.matches);
        }}, PRESETS[name].title);
        return element('nav', {class: 'lessons', 'aria-label': 'Lessons'}, ...Object.keys(PRESETS).map(link));
    }

    onward() {
        return element('p', {class: 'onward'}, element('a', {href: new URL(`../lab.html#${this.preset}`, HERE)},
            'Open it in the lab'));
    }

    speed() {
        const options = SPEEDS.map(speed => element('option', {value: speed}, `${speed}`.replace('0.25', '¼') + ' ×'));
        this.controls.speed = element('select', {class: 'speed', onchange: event => {
            this.scene.speed = Number(event.target.value);
            this.remember();
        }}, ...options);
        return element('label', {}, 'Speed ', this.controls.speed);
    }

    scales() {
        this.controls.scale = element('input', {type: 'checkbox', class: 'scale', onchange: event => {
            this.scene.scale = event.target.checked ? 'log' : 'linear';
            this.drawing.plots();
            this.remember();
        }});
        return element('label', {}, this.controls.scale, ' logarithmic');
    }

    slider(key) {
        const {label, unit, from, to, by, least, most, logarithmic} = SLIDERS[key];
        const value = at => Number(logarithmic ? (10 ** at).toPrecision(3) : at.toFixed(2));
        const range = element('input', {type: 'range', class: key, min: from, max: to, step: by, oninput: () => {
            this.change({[key]: value(Number(range.value))});
        }});
        const typed = element('input', {type: 'number', class: key, min: least, max: most, step: 'any',
            'aria-label': `${label} (${unit}), as a number`, onchange: () => {
                const given = typed.valueAsNumber;
                if (given >= least && given <= most) {
                    this.change({[key]: given});
                } else {
                    this.say(`${label} must be from ${least} to ${most} ${unit}.`);
                    this.show();
                }
            }});
        this.controls[key] = {
            show: now => {
                range.value = logarithmic ? Math.log10(now) : now;
                range.setAttribute('aria-valuetext', `${now} ${unit}`);
                if (typed !== document.activeElement || typed.valueAsNumber !== now) typed.value = now;
            },
        };
        return element('div', {class: 'slider'}, element('label', {}, element('span', {}, `${label} (${unit})`), range), typed);
    }

    choice() {
        const box = method => {
            const input = element('input', {type: 'checkbox', value: method.name, onchange: () => this.choose()});
            const marker = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
            marker.setAttribute('viewBox', '-8 -8 16 16');
            marker.setAttribute('aria-hidden', 'true');
            const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
            path.setAttribute('d', `M0,0${method.marker}`);
            path.style.fill = `var(${method.colour})`;
            marker.append(path);
            return element('label', {}, input, marker, ` ${method.title}`);
        };
        this.controls.methods = this.known.map(box);
        const paper = this.controls.methods.filter((_, i) => PAPERS.includes(this.known[i].name));
        const others = this.controls.methods.filter(label => !paper.includes(label));
        return element('fieldset', {class: 'methods'},
            element('legend', {}, `Methods, up to ${this.library.places()}`),
            element('div', {}, ...paper),
            element('details', {}, element('summary', {}, 'More methods'), element('div', {}, ...others)));
    }

    choose() {
        const boxes = this.controls.methods.map(label => label.querySelector('input'));
        const chosen = boxes.filter(box => box.checked).map(box => box.value);
        // Those that were there keep their places.
        const kept = this.scene.methods.filter(name => chosen.includes(name));
        const methods = [...kept, ...chosen.filter(name => !kept.includes(name))].slice(0, this.library.places());
        if (methods.length) this.change({methods});
        else this.show();
    }

    digits() {
        this.every = element('div');
        return element('details', {class: 'digits'}, element('summary', {}, 'Every digit, and the same on the command line'),
            this.every);
    }

    // The table's columns: title, and what stands there.
    columns() {
        const damped = () => this.scene.beta > 0;
        const all = [
            ['Method', null],
            ['Steps', p => count(p.read(STEPS))],
            ['Force evaluations', p => count(p.read(EVALUATIONS))],
            ['Time a step (ns)', p => p.spent > 5 ? brief(1e6 * p.spent / p.read(STEPS), 2) : '–'],
            ['Energy error now (J)', p => damped() ? '–' : brief(p.read(ERROR))],
            [this.whole ? 'largest (J)' : 'Largest energy error (J)', p => damped() ? '–' : brief(p.read(LARGEST))],
            ['Angle error now (rad)', p => damped() ? '–' : brief(p.lapse)],
            [this.whole ? 'largest (rad)' : 'Largest angle error (rad)', p => damped() ? '–' : brief(p.angle.largest)],
        ];
        return this.whole ? all : [0, 1, 5, 7].map(i => all[i]);
    }

    // The numbers and the positions of all controls.
    show() {
        const {scene, controls} = this;
        controls.time.textContent = `t = ${brief(this.time, 6)} s`;
        const columns = this.columns().slice(1);
        this.pendulums.forEach((pendulum, i) => {
            const row = this.rows.rows[i] ?? this.rows.appendChild(element('tr', {}, element('th', {scope: 'row'}),
                ...columns.map(() => element('td'))));
            row.cells[0].textContent = pendulum.method.title + (pendulum.lost ? ': step too long' : '');
            columns.forEach(([, value], k) => {
                row.cells[k + 1].textContent = value(pendulum);
            });
        });
        while (this.rows.rows.length > this.pendulums.length) this.rows.lastChild.remove();
        for (const key of Object.keys(SLIDERS)) controls[key]?.show(scene[key]);
        controls.speed.value = scene.speed;
        controls.scale.checked = scene.scale === 'log';
        for (const label of controls.methods ?? []) {
            const box = label.querySelector('input');
            box.checked = scene.methods.includes(box.value);
            box.disabled = !box.checked && scene.methods.length >= this.library.places();
        }
        if (this.whole) this.spell();
        this.drawing.describe();
    }

    // Every digit, with the command that prints the same.
    spell() {
        const {scene} = this;
        this.every.replaceChildren(...this.pendulums.flatMap(pendulum => {
            const value = (name, quantity) => [`${name} = `, element('data', {value: pendulum.read(quantity),
                'data-of': `${pendulum.method.name} ${name}`}, pendulum.read(quantity)), '  '];
            const steps = pendulum.read(STEPS);
            const command = `pendula simulate --method ${pendulum.method.name} --theta0 ${scene.theta0} ` +
                `--omega0 ${scene.omega0} --gravity ${scene.g} --length ${scene.L} --dt ${scene.dt} ` +
                `--steps ${steps} --every ${Math.max(steps, 1)}`;
            const numbers = element('p', {class: 'numbers'}, `${pendulum.method.title}: `, ...value('t', TIME),
                ...value('theta', THETA), ...value('omega', OMEGA), ...value('energy', ENERGY));
            return scene.beta > 0 || pendulum.lost ? [numbers] : [numbers, element('pre', {}, element('code', {}, command))];
        }));
    }

    summary() {
        const damped = this.scene.beta > 0;
        const errors = this.pendulums.map(p => `${p.method.title} ${brief(p.read(LARGEST))} J`).join(', ');
        return `Paused at ${brief(this.time, 6)} s, after ${count(this.taken)} steps.` +
            (damped ? '' : ` Largest energy error: ${errors}.`);
    }

    say(words) {
        this.controls.said.textContent = words;
    }
}

// A page without WebAssembly is as on paper.
if (typeof WebAssembly === 'object') {
    compiled().then(async module => {
        for (const place of places) {
            if (!Object.hasOwn(PRESETS, place.dataset.preset)) throw new Error(`no preset ${place.dataset.preset}`);
            const lab = new Lab(place, await WebAssembly.instantiate(module));
            place.lab = lab;
            if (lab.arrive) place.scrollIntoView({block: 'start'});
        }
    }).catch(error => console.error(`lab: ${error.message}`));
}
})();
