// What a lab draws: pendulums, the phase portrait, and the errors over time.
(theLab => {
    'use strict';

    const { QUANTITY, TRAIL, raised, roundUp, tick, wrapped } = theLab;
    const { THETA, OMEGA, PERIOD } = QUANTITY;

    // As in the figures: a method's colour, marker and dash follow from its index in the library's
    // list. A test in book/study/src/charts/style.rs checks that both agree.
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
    const FONT = '13px "Open Sans", system-ui, sans-serif';
    const TURN = 2 * Math.PI;
    // Space below a pendulum for its name (px).
    const NAME = 20;

    // A canvas at the resolution of the screen, drawn in CSS pixels.
    class Sheet {
        constructor() {
            this.canvas = document.createElement('canvas');
            this.canvas.setAttribute('role', 'img');
            this.width = this.height = 0;
            this.ink = this.canvas.getContext('2d');
        }

        fit(width, height) {
            const scale = Math.min(devicePixelRatio || 1, 2);
            const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
            if (this.canvas.width !== w || this.canvas.height !== h) {
                Object.assign(this.canvas, { width: w, height: h });
                this.canvas.style.height = `${height}px`;
            }
            Object.assign(this, { width, height, scale });
            this.ink.setTransform(scale, 0, 0, scale, 0, 0);
        }

        clear() {
            this.ink.clearRect(0, 0, this.width, this.height);
        }
    }

    function mark(ink, path, x, y, size, colour) {
        ink.save();
        ink.translate(x, y);
        ink.scale(size, size);
        ink.fillStyle = colour;
        ink.fill(path);
        ink.restore();
    }

    // The colour, the marker and the dash of a method.
    function look({ number }) {
        return {
            colour: `--pendula-${COLOURS[number % COLOURS.length]}`,
            marker: MARKERS[number % MARKERS.length],
            dash: DASHES[number % DASHES.length],
        };
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
            y: value =>
                bottom - ((Math.log10(Math.abs(value)) - low) / (high - low)) * (bottom - top),
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

    class Drawing {
        constructor(lab) {
            this.lab = lab;
            for (const sheet of ['stage', 'phase', 'energy', 'angle']) this[sheet] = new Sheet();
            // The phase portrait so far, so that a frame only adds its own points.
            this.trails = document.createElement('canvas');
            this.drawn = [];
            this.reach = 0;
        }

        colours() {
            const style = getComputedStyle(document.documentElement);
            const value = name => style.getPropertyValue(name).trim();
            this.ink = value('--fg') || '#000';
            this.looks = new Map(
                this.lab.known.map(method => {
                    const { colour, marker, dash } = look(method);
                    return [
                        method.number,
                        { colour: value(colour), path: new Path2D(marker), dash },
                    ];
                }),
            );
        }

        // Sets the sizes from the available width and redraws everything.
        layout() {
            this.colours();
            const width = sheet => sheet.canvas.parentElement?.clientWidth ?? 0;
            const stage = width(this.stage),
                n = this.lab.pendulums.length || 1;
            this.down = Math.ceil(n / Math.max(1, Math.floor(stage / 100)));
            this.across = Math.ceil(n / this.down);
            this.cell = Math.min(stage / this.across, this.lab.whole ? 230 : 190);
            this.stage.fit(stage, this.down * (this.cell + NAME));
            for (const sheet of [this.phase, this.energy, this.angle].filter(
                sheet => sheet.canvas.isConnected,
            )) {
                const own = width(sheet);
                const height = Math.round(Math.min(Math.max(own * 0.62, 200), 300));
                // Beside the two plots it is as high as both.
                const tall = sheet === this.phase && this.lab.whole && own < 0.6 * stage;
                if (own) sheet.fit(own, tall ? 2 * height - 12 : height);
            }
            // During a drag the axis keeps its scale; otherwise the point under the pointer would
            // run away.
            if (!this.lab.held) this.reach = 0;
            this.base();
            this.all();
        }

        all() {
            this.pendulums();
            this.portrait();
            this.plots();
        }

        // The pivot of the i-th pendulum and the length of its rod (px).
        pivot(i) {
            const left = (this.stage.width - this.across * this.cell) / 2;
            const L = this.lab.scene.L;
            return {
                x: left + ((i % this.across) + 0.5) * this.cell,
                y: Math.floor(i / this.across) * (this.cell + NAME) + this.cell / 2,
                // Grows with L, but not in proportion: the shortest rod must leave a bob to grasp.
                rod: this.cell * (0.3 + (0.11 * L) / (L + 1)),
            };
        }

        pendulums() {
            const { stage, lab } = this,
                ink = stage.ink;
            stage.clear();
            lab.pendulums.forEach((pendulum, i) => {
                const { x, y, rod } = this.pivot(i),
                    { path, colour } = this.looks.get(pendulum.method.number);
                const bob = theta => [x + rod * Math.sin(theta), y + rod * Math.cos(theta)];
                ink.globalAlpha = 0.35;
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
                ink.strokeStyle = colour;
                ink.beginPath();
                ink.moveTo(x, y);
                ink.lineTo(bx, by);
                ink.stroke();
                mark(ink, path, bx, by, 1.7, colour);
                ink.fillStyle = this.ink;
                ink.beginPath();
                ink.arc(x, y, 2.5, 0, TURN);
                ink.fill();
                ink.font = FONT;
                ink.textAlign = 'center';
                ink.fillText(pendulum.method.title, x, y + this.cell / 2 + 12, this.cell - 4);
            });
        }

        // The frame of the phase portrait in pixels, with the maps between (θ, ω) and pixels.
        frame() {
            const { width, height } = this.phase;
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

        // Draws what does not move: axes, the exact orbit, the separatrix. It clears the trails.
        base() {
            const { phase, lab } = this;
            if (!phase.width) return;
            const top = 2 * Math.sqrt(lab.scene.g / lab.scene.L);
            const speeds = lab.pendulums.map(p => Math.abs(p.read(OMEGA))).filter(Number.isFinite);
            const seen = Math.max(...speeds, Math.abs(lab.scene.omega0), 0);
            if (this.reach === 0 || seen > this.reach)
                this.reach = roundUp(Math.max(1.25 * top, 1.25 * seen));
            const sheet = Object.assign(this.trails, {
                width: phase.canvas.width,
                height: phase.canvas.height,
            });
            const ink = sheet.getContext('2d');
            ink.setTransform(phase.scale, 0, 0, phase.scale, 0, 0);
            const f = this.frame();
            ink.strokeStyle = ink.fillStyle = this.ink;
            ink.font = FONT;
            ink.lineWidth = 1;
            ink.strokeRect(f.left, f.top, f.right - f.left, f.bottom - f.top);
            ink.textBaseline = 'top';
            for (const [theta, label] of [
                [-Math.PI, '−π'],
                [0, '0'],
                [Math.PI, 'π'],
            ]) {
                ink.textAlign = theta > 0 ? 'right' : theta < 0 ? 'left' : 'center';
                ink.fillText(label, f.x(theta), f.bottom + 4);
            }
            ink.textAlign = 'center';
            ink.fillText('θ (rad)', (f.left + f.right) / 2, f.bottom + 17);
            ink.textAlign = 'right';
            ink.textBaseline = 'middle';
            for (const omega of [-this.reach, 0, this.reach]) {
                ink.fillText(
                    tick(omega),
                    f.left - 5,
                    Math.min(Math.max(f.y(omega), f.top + 6), f.bottom - 6),
                );
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
            const { lab } = this,
                library = lab.library;
            if (!lab.pendulums.length) return;
            const trace = (state, from, to, sign) => {
                ink.beginPath();
                let before = NaN;
                for (let i = 0; i <= 240; i++) {
                    const [theta, omega] = state(from + ((to - from) * i) / 240);
                    const x = wrapped(sign * theta);
                    // No line across the edge at ±π.
                    ink[Math.abs(x - before) < Math.PI ? 'lineTo' : 'moveTo'](
                        f.x(x),
                        f.y(sign * omega),
                    );
                    before = x;
                }
                ink.stroke();
            };
            const slow = 6 / Math.sqrt(lab.scene.g / lab.scene.L);
            ink.setLineDash([2, 4]);
            for (const sign of [-1, 1]) {
                trace(
                    t => [library.separatrix_theta(0, t), library.separatrix_omega(0, t)],
                    -slow,
                    slow,
                    sign,
                );
            }
            ink.setLineDash([]);
            const period = library.read(0, PERIOD);
            if (Number.isNaN(period)) return;
            ink.lineWidth = 1.5;
            trace(t => [library.exact_theta(0, t), library.exact_omega(0, t)], 0, period, 1);
        }

        portrait() {
            const { phase, lab } = this;
            if (!phase.width) return;
            if (lab.pendulums.some(p => Math.abs(p.read(OMEGA)) > this.reach)) this.base();
            const f = this.frame(),
                ink = this.trails.getContext('2d');
            ink.save();
            ink.beginPath();
            ink.rect(f.left, f.top, f.right - f.left, f.bottom - f.top);
            ink.clip();
            lab.pendulums.forEach((pendulum, i) => {
                ink.fillStyle = this.looks.get(pendulum.method.number).colour;
                for (
                    let k = Math.max(this.drawn[i], pendulum.points - TRAIL);
                    k < pendulum.points;
                    k++
                ) {
                    const at = 2 * (k % TRAIL);
                    ink.fillRect(
                        f.x(pendulum.trail[at]) - 0.75,
                        f.y(pendulum.trail[at + 1]) - 0.75,
                        1.5,
                        1.5,
                    );
                }
                this.drawn[i] = pendulum.points;
            });
            ink.restore();
            phase.clear();
            phase.ink.drawImage(this.trails, 0, 0, phase.width, phase.height);
            const x = f.x(wrapped(lab.scene.theta0)),
                y = f.y(lab.scene.omega0);
            phase.ink.strokeStyle = this.ink;
            phase.ink.lineWidth = 1.5;
            phase.ink.beginPath();
            phase.ink.arc(x, y, 9, 0, TURN);
            phase.ink.stroke();
            for (const pendulum of lab.pendulums) {
                const { path, colour } = this.looks.get(pendulum.method.number);
                const at = [f.x(wrapped(pendulum.read(THETA))), f.y(pendulum.read(OMEGA))];
                mark(phase.ink, path, ...at, 1, colour);
            }
        }

        plots() {
            const { lab } = this,
                damped = lab.scene.beta > 0;
            this.plot(
                this.energy,
                damped ? 'energy (J)' : 'energy error (J)',
                pendulum => pendulum.energy,
            );
            if (damped && this.angle.width) {
                this.angle.clear();
                this.angle.ink.fillStyle = this.ink;
                this.angle.ink.font = FONT;
                this.angle.ink.textAlign = 'center';
                this.angle.ink.textBaseline = 'middle';
                this.angle.ink.fillText(
                    'with damping there is no closed form',
                    this.angle.width / 2,
                    this.angle.height / 2,
                    this.angle.width - 20,
                );
            } else if (!damped) {
                this.plot(this.angle, 'angle error (rad)', pendulum => pendulum.angle);
            }
        }

        // One quantity of every pendulum over time.
        plot(sheet, title, seriesOf) {
            if (!sheet.width) return;
            const { lab } = this,
                { ink, width, height } = sheet;
            const f = { left: 66, right: width - 12, top: 24, bottom: height - 34 };
            const logarithmic = lab.scene.scale === 'log';
            const all = lab.pendulums.map(seriesOf);
            const span = lab.scene.until || roundUp(Math.max(lab.time, 10 * lab.scene.dt, 5));
            const x = t => f.left + (t / span) * (f.right - f.left);
            const { y, ticks } = logarithmic ? logarithmicAxis(all, f) : linearAxis(all, f);
            sheet.clear();
            ink.strokeStyle = ink.fillStyle = this.ink;
            ink.lineWidth = 1;
            ink.font = FONT;
            ink.textBaseline = 'middle';
            ink.textAlign = 'right';
            for (const [value, label] of ticks) {
                ink.fillText(label, f.left - 6, y(value), f.left - 8);
                ink.globalAlpha = 0.2;
                ink.fillRect(f.left, Math.round(y(value)), f.right - f.left, 1);
                ink.globalAlpha = 1;
            }
            ink.strokeRect(f.left, f.top, f.right - f.left, f.bottom - f.top);
            ink.textAlign = 'left';
            ink.fillText(title, f.left, 12);
            ink.textBaseline = 'top';
            for (const [t, align] of [
                [0, 'left'],
                [span / 2, 'center'],
                [span, 'right'],
            ]) {
                ink.textAlign = align;
                ink.fillText(tick(t), x(t), f.bottom + 4);
            }
            ink.textAlign = 'center';
            ink.fillText('t (s)', x(span / 2), f.bottom + 17);
            ink.save();
            ink.beginPath();
            ink.rect(f.left, f.top, f.right - f.left, f.bottom - f.top);
            ink.clip();
            all.forEach((series, own) => {
                const { colour, path, dash } = this.looks.get(lab.pendulums[own].method.number);
                const time = i => x(Math.min((i + 1) * series.width, lab.taken) * lab.scene.dt);
                const size = i => Math.max(Math.abs(series.low[i]), Math.abs(series.high[i]));
                ink.strokeStyle = colour;
                ink.lineWidth = 1.8;
                ink.setLineDash(logarithmic ? dash : []);
                ink.beginPath();
                for (let i = 0; i < series.length; i++) {
                    if (logarithmic) {
                        if (size(i) > 0) ink.lineTo(time(i), y(size(i)));
                    } else {
                        // The band between the extremes, as one stroke up and down.
                        ink.lineTo(time(i), y(series.low[i]));
                        ink.lineTo(time(i), y(series.high[i]));
                    }
                }
                ink.stroke();
                ink.setLineDash([]);
                // Markers distinguish the lines without colours; those of different methods are
                // offset, so that none hides another.
                for (let third = 0; third < 3; third++) {
                    const i = Math.floor((series.length * (third + (own + 0.5) / all.length)) / 3);
                    if (series.length < 3 || (logarithmic && size(i) === 0)) continue;
                    mark(
                        ink,
                        path,
                        time(i),
                        y(logarithmic ? size(i) : series.high[i]),
                        0.9,
                        colour,
                    );
                }
            });
            ink.restore();
        }

        // Text alternatives for the drawings.
        describe() {
            const { lab } = this,
                names = lab.pendulums.map(pendulum => pendulum.method.title).join(', ');
            const energy = lab.scene.beta > 0 ? 'Energy' : 'Energy error';
            for (const [sheet, words] of [
                [
                    this.stage,
                    `Pendulums side by side: ${names}. A ring on a dashed rod is the exact one. ` +
                        `Drag a bob to set θ₀.`,
                ],
                [
                    this.phase,
                    `Phase portrait of ${names}, over exact orbit and separatrix. ` +
                        `Drag to set θ₀ and ω₀.`,
                ],
                [this.energy, `${energy} over time of ${names}; its numbers are in the table.`],
                [
                    this.angle,
                    `Angle error against the closed form, of ${names}; ` +
                        `its numbers are in the table.`,
                ],
            ])
                sheet.canvas.setAttribute('aria-label', words);
        }
    }

    Object.assign(theLab, { Drawing, look });
})((globalThis.theLab ??= {}));
