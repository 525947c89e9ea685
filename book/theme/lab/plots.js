// The phase portrait of a lab, and the plots of one quantity of every pendulum over time.
'use strict';

// What is so many times as large as the largest of the others, and larger than a swing can be,
// would press these flat: it leaves the picture, and its number stands where it left.
const FAR = 10;

// The systems of which the separatrix says something.
const PLAIN = ['pendulum', 'driven'];

class Portrait extends Sheet {
    constructor(lab) {
        super();
        this.lab = lab;
        // What was drawn so far, so that a frame only adds its own points.
        this.dots = document.createElement('canvas');
        this.drawn = [];
        this.reach = 0;
    }

    // The frame of the phase portrait in pixels, with the maps between (θ, ω) and pixels.
    frame() {
        const { width, height } = this;
        const left = 44,
            right = width - 10,
            top = 10,
            bottom = height - 34;
        return {
            left,
            right,
            top,
            bottom,
            x: theta => left + (theta / TURN + 0.5) * (right - left),
            y: omega => (top + bottom) / 2 - ((omega / this.reach) * (bottom - top)) / 2,
            theta: x => ((x - left) / (right - left) - 0.5) * TURN,
            omega: y => (((top + bottom) / 2 - y) / (bottom - top)) * 2 * this.reach,
        };
    }

    // The largest velocity that is drawn (rad/s): half as fast again as what just goes round turns
    // at the bottom, twice over, or as fast as the start.
    get most() {
        const { g, L, omega0 } = this.lab.scene;
        return Math.max(6 * Math.sqrt(g / L), 1.25 * Math.abs(omega0));
    }

    // Draws what does not move: axes, the exact orbit, the separatrix. It clears the dots.
    base() {
        const { lab } = this;
        if (!this.width) return;
        const top = 2 * Math.sqrt(lab.scene.g / lab.scene.L);
        const speeds = lab.pendulums.map(p => Math.abs(p.read(OMEGA))).filter(w => w <= this.most);
        const seen = Math.max(...speeds, Math.abs(lab.scene.omega0), 0);
        if (this.reach === 0 || seen > this.reach)
            this.reach = roundUp(Math.max(1.25 * top, 1.25 * seen));
        const sheet = Object.assign(this.dots, {
            width: this.canvas.width,
            height: this.canvas.height,
        });
        const ink = sheet.getContext('2d');
        ink.setTransform(this.scale, 0, 0, this.scale, 0, 0);
        const f = this.frame();
        ink.strokeStyle = ink.fillStyle = lab.drawing.ink;
        axis(ink, f, ['−π', '0', 'π'], 'θ (rad)');
        for (const omega of [-this.reach, 0, this.reach]) {
            const y = Math.min(Math.max(f.y(omega), f.top + 6), f.bottom - 6);
            write(ink, tick(omega), f.left - 5, y, 'right', 'middle');
        }
        ink.save();
        ink.translate(12, (f.top + f.bottom) / 2);
        ink.rotate(-Math.PI / 2);
        write(ink, 'ω (rad/s)', 0, 0, 'center', 'middle');
        ink.restore();
        within(ink, f, () => {
            ink.globalAlpha = 0.75;
            this.curves(ink, f);
        });
        this.drawn = lab.pendulums.map(pendulum => pendulum.oldest);
    }

    // The separatrix, dotted, and the exact orbit, from the closed form.
    curves(ink, f) {
        const { lab } = this,
            library = lab.library;
        if (!lab.pendulums.length || !PLAIN.includes(lab.scene.system)) return;
        const trace = (state, from, to, sign) => {
            ink.beginPath();
            let before = NaN;
            for (let i = 0; i <= 240; i++) {
                const [theta, omega] = state(from + ((to - from) * i) / 240);
                const x = wrapped(sign * theta);
                // No line across the edge at ±π.
                const pen = Math.abs(x - before) < Math.PI ? 'lineTo' : 'moveTo';
                ink[pen](f.x(x), f.y(sign * omega));
                before = x;
            }
            ink.stroke();
        };
        const slow = 6 / Math.sqrt(lab.scene.g / lab.scene.L);
        ink.setLineDash([2, 4]);
        const top = t => [library.separatrix_theta(0, t), library.separatrix_omega(0, t)];
        for (const sign of [-1, 1]) trace(top, -slow, slow, sign);
        ink.setLineDash([]);
        const period = library.read(0, PERIOD);
        if (!isClosed(lab.scene) || Number.isNaN(period)) return;
        ink.lineWidth = 1.5;
        trace(t => [library.exact_theta(0, t), library.exact_omega(0, t)], 0, period, 1);
    }

    // Adds what is new.
    draw() {
        const { lab } = this;
        if (!this.width) return;
        const { most, reach } = this;
        const grows = w => w > reach && w <= most;
        if (lab.pendulums.some(p => grows(Math.abs(p.read(OMEGA))))) this.base();
        const f = this.frame(),
            dots = this.dots.getContext('2d');
        const add = (pendulum, i) => {
            dots.fillStyle = lab.drawing.looks.get(pendulum.method.number).colour;
            for (let k = Math.max(this.drawn[i], pendulum.oldest); k < pendulum.points; k++) {
                const { theta, omega } = pendulum.point(k);
                dots.fillRect(f.x(theta) - 0.75, f.y(omega) - 0.75, 1.5, 1.5);
            }
            this.drawn[i] = pendulum.points;
        };
        within(dots, f, () => lab.pendulums.forEach(add));
        this.clear();
        const { ink } = this;
        ink.drawImage(this.dots, 0, 0, this.width, this.height);
        ink.strokeStyle = lab.drawing.ink;
        ink.lineWidth = 1.5;
        ring(ink, f.x(wrapped(lab.scene.theta0)), f.y(lab.scene.omega0), 9);
        // Outlines, each a little smaller than the one before: where they meet, all are seen.
        const step = lab.cursor?.step;
        lab.pendulums.forEach((pendulum, i) => {
            const { path, colour } = lab.drawing.looks.get(pendulum.method.number);
            const at = step === undefined ? null : pendulum.near(step);
            const [theta, omega] = at
                ? [at.theta, at.omega]
                : [wrapped(pendulum.read(THETA)), pendulum.read(OMEGA)];
            const size = 1.35 - 0.75 * (i / Math.max(lab.pendulums.length - 1, 3));
            const y = Math.min(Math.max(f.y(omega), f.top + 8), f.bottom - 8);
            mark(ink, path, f.x(theta), y, size, colour, true);
            if (y === f.y(omega) || Number.isNaN(y)) return;
            // Out of the picture: its number, on the side where there is room.
            const side = f.x(theta) > (f.left + f.right) / 2 ? 'right' : 'left';
            ink.fillStyle = colour;
            const beside = f.x(theta) + (side === 'right' ? -12 : 12);
            write(ink, `ω = ${tick(Number(omega.toPrecision(2)))}`, beside, y, side, 'middle');
        });
    }

    // The point that is nearest to a place on the canvas, nearer than `reach` (px), or null.
    nearest(x, y, reach) {
        const f = this.frame();
        let best = null;
        for (const pendulum of this.lab.pendulums) {
            for (let k = pendulum.oldest; k < pendulum.points; k++) {
                const { steps, theta, omega } = pendulum.point(k);
                const away = Math.hypot(f.x(theta) - x, f.y(omega) - y);
                if (away < (best?.away ?? reach)) best = { away, steps };
            }
        }
        return best;
    }
}

// The vertical axis of a plot: the position of a value, and the ticks.
function logarithmicAxis(all, { top, bottom }) {
    const sizes = all.map(series => series.largest),
        largest = Math.max(...sizes, 0) || 1;
    const high = Math.ceil(Math.log10(largest) + 0.05);
    // Room for the smallest error to grow.
    const smallest = Math.min(...sizes.filter(size => size > 0), largest);
    const low = Math.min(Math.floor(Math.log10(smallest)) - 2, high - 4);
    const every = Math.ceil((high - low) / 6);
    const powers = Array.from({ length: high - low + 1 }, (_, i) => high - i).filter(
        (_, i) => i % every === 0,
    );
    return {
        y: value => bottom - ((Math.log10(Math.abs(value)) - low) / (high - low)) * (bottom - top),
        ticks: powers.map(power => [
            10 ** power,
            power === 0 ? '1' : power === 1 ? '10' : `10${raised(power)}`,
        ]),
    };
}

function linearAxis(all, { top, bottom }) {
    const edge = size => (size > 0 ? roundUp(size) : 0);
    let least = -edge(Math.max(...all.map(series => -series.lowest), 0));
    let most = edge(Math.max(...all.map(series => series.highest), 0));
    if (least === most) [least, most] = [-1, 1];
    const y = value => bottom - ((value - least) / (most - least)) * (bottom - top);
    // Zero first, then the ends, then the halves, as far as there is room (px).
    const ticks = [0];
    for (const value of [most, least, most / 2, least / 2]) {
        if (ticks.every(other => Math.abs(y(value) - y(other)) >= 24)) ticks.push(value);
    }
    return { y, ticks: ticks.map(value => [value, tick(value)]) };
}

class Plot extends Sheet {
    // `seriesOf` is the record of a pendulum.
    // `usual` is how large the quantity of a swing in a scene can be.
    constructor(lab, seriesOf, unit, usual) {
        super();
        Object.assign(this, { lab, seriesOf, unit, usual, span: 0 });
    }

    // What a bob gains from the bottom to the top (J, of 1 kg).
    static energyScale({ g, L }) {
        return 2 * g * L;
    }

    // Those that have left all the others behind, of some that have a series.
    far(all) {
        const sorted = [...all].sort((a, b) => b.series.largest - a.series.largest);
        const usual = this.usual(this.lab.scene);
        const leads = (one, i) =>
            i + 1 < sorted.length &&
            one.series.largest > Math.max(FAR * sorted[i + 1].series.largest, usual);
        const last = sorted.findLastIndex(leads);
        return sorted.slice(0, last + 1);
    }

    // The frame in pixels.
    frame() {
        return { left: 66, right: this.width - 12, top: 24, bottom: this.height - 34 };
    }

    // The time (s) at a place on the canvas.
    time(x) {
        const { left, right } = this.frame();
        return ((x - left) / (right - left)) * this.span;
    }

    draw(title) {
        if (!this.width) return;
        const { lab, ink, seriesOf } = this;
        const f = this.frame();
        const logarithmic = lab.scene.scale === 'log';
        const curve = dt => pendulum => ({
            series: seriesOf(pendulum),
            method: pendulum.method,
            dt,
        });
        const own = lab.pendulums.map(curve(lab.scene.dt));
        const pinned = lab.pin.shown().map(curve(lab.pin.dt));
        const far = logarithmic ? [] : this.far([...own, ...pinned]);
        const near = [...own, ...pinned].filter(one => !far.includes(one));
        const all = near.map(({ series }) => series);
        const last = Math.max(lab.time, pinned.length ? lab.pin.time : 0);
        this.span = lab.scene.until || roundUp(Math.max(last, 10 * lab.scene.dt, 5));
        const x = t => f.left + (t / this.span) * (f.right - f.left);
        const { y, ticks } = logarithmic ? logarithmicAxis(all, f) : linearAxis(all, f);
        this.clear();
        ink.strokeStyle = ink.fillStyle = lab.drawing.ink;
        for (const [value, label] of ticks) {
            write(ink, label, f.left - 6, y(value), 'right', 'middle', f.left - 8);
            ink.globalAlpha = 0.2;
            ink.fillRect(f.left, Math.round(y(value)), f.right - f.left, 1);
            ink.globalAlpha = 1;
        }
        axis(ink, f, [0, this.span / 2, this.span].map(tick), 't (s)');
        write(ink, title, f.left, 12, 'left', 'middle');
        if (pinned.length) write(ink, 'dotted: pinned', f.right, 12, 'right', 'middle');
        within(ink, f, () => {
            this.curves(own, x, y, logarithmic);
            for (const one of pinned) this.ghost(one, x, y, logarithmic);
            ink.fillStyle = lab.drawing.ink;
            if (lab.cursor) ink.fillRect(x(lab.cursor.time) - 0.5, f.top, 1, f.bottom - f.top);
        });
        far.forEach((one, i) => this.note(one, f, i));
    }

    // The number of what has left the picture, at the edge where it did.
    note({ series, method }, { right, top, bottom }, i) {
        const { ink, lab, unit } = this;
        const now = series.last[series.length - 1],
            up = now > 0;
        const size = tick(Number(now.toPrecision(2)));
        const words = `${method.title}: ${size} ${unit} ${up ? '▲' : '▼'}`;
        const y = up ? top + 12 + 18 * i : bottom - 12 - 18 * i;
        // The curves of the others lie below it, up to the edge.
        Object.assign(ink, { fillStyle: lab.drawing.paper, font: FONT });
        const width = ink.measureText(words).width + 12,
            edge = up ? top + 1 : bottom - 1,
            end = up ? y + 10 : y - 10;
        ink.fillRect(right - 1 - width, edge, width, end - edge);
        ink.fillStyle = lab.drawing.looks.get(method.number).colour;
        write(ink, words, right - 6, y, 'right', 'middle');
    }

    // The places of a curve: of its bins the largest errors, or both extremes.
    trace({ series, dt }, x, y, logarithmic) {
        const { ink } = this;
        ink.beginPath();
        for (let i = 0; i < series.length; i++) {
            const at = x(Math.min((i + 1) * series.width, series.steps) * dt);
            if (logarithmic) {
                const size = Math.max(Math.abs(series.low[i]), Math.abs(series.high[i]));
                if (size > 0) ink.lineTo(at, y(size));
            } else {
                // The band between the extremes, as one stroke up and down.
                ink.lineTo(at, y(series.low[i]));
                ink.lineTo(at, y(series.high[i]));
            }
        }
        ink.stroke();
    }

    // The largest first, so that none lies below a larger one.
    curves(own, x, y, logarithmic) {
        const { ink, lab } = this;
        const order = own
            .map((one, place) => ({ ...one, place, largest: one.series.largest }))
            .sort((a, b) => b.largest - a.largest);
        for (const one of order) {
            const { colour, dash } = lab.drawing.looks.get(one.method.number);
            ink.strokeStyle = colour;
            ink.lineWidth = 1.8;
            ink.setLineDash(logarithmic ? dash : []);
            this.trace(one, x, y, logarithmic);
            ink.setLineDash([]);
        }
        // Markers distinguish the lines without colours, above all of them; those of different
        // methods are offset, so that none hides another.
        for (const { series, dt, method, place } of order) {
            const { colour, path } = lab.drawing.looks.get(method.number);
            for (let third = 0; third < 3; third++) {
                const i = Math.floor((series.length * (third + (place + 0.5) / own.length)) / 3);
                const size = Math.max(Math.abs(series.low[i]), Math.abs(series.high[i]));
                if (series.length < 3 || (logarithmic && size === 0)) continue;
                const t = Math.min((i + 1) * series.width, series.steps) * dt;
                mark(ink, path, x(t), y(logarithmic ? size : series.high[i]), 0.9, colour);
            }
        }
    }

    // A pinned curve: thin and dotted.
    ghost(one, x, y, logarithmic) {
        const { ink } = this;
        ink.strokeStyle = this.lab.drawing.looks.get(one.method.number).colour;
        ink.lineWidth = 1;
        ink.globalAlpha = 0.8;
        ink.setLineDash([1.5, 2.5]);
        this.trace(one, x, y, logarithmic);
        ink.setLineDash([]);
        ink.globalAlpha = 1;
    }
}
