// The phase portrait of a lab.
(theLab => {
    'use strict';

    const { QUANTITY, FONT, Sheet, TURN, hollow, isClosed, roundUp, tick, wrapped } = theLab;
    const { THETA, OMEGA, PERIOD } = QUANTITY;
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

        // Draws what does not move: axes, the exact orbit, the separatrix. It clears the dots.
        base() {
            const { lab } = this;
            if (!this.width) return;
            const top = 2 * Math.sqrt(lab.scene.g / lab.scene.L);
            const speeds = lab.pendulums.map(p => Math.abs(p.read(OMEGA))).filter(Number.isFinite);
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
            if (!isClosed(lab.scene) || Number.isNaN(period)) return;
            ink.lineWidth = 1.5;
            trace(t => [library.exact_theta(0, t), library.exact_omega(0, t)], 0, period, 1);
        }

        // Adds what is new.
        draw() {
            const { lab } = this;
            if (!this.width) return;
            if (lab.pendulums.some(p => Math.abs(p.read(OMEGA)) > this.reach)) this.base();
            const f = this.frame(),
                dots = this.dots.getContext('2d');
            dots.save();
            dots.beginPath();
            dots.rect(f.left, f.top, f.right - f.left, f.bottom - f.top);
            dots.clip();
            lab.pendulums.forEach((pendulum, i) => {
                dots.fillStyle = lab.drawing.looks.get(pendulum.method.number).colour;
                for (let k = Math.max(this.drawn[i], pendulum.oldest); k < pendulum.points; k++) {
                    const { theta, omega } = pendulum.point(k);
                    dots.fillRect(f.x(theta) - 0.75, f.y(omega) - 0.75, 1.5, 1.5);
                }
                this.drawn[i] = pendulum.points;
            });
            dots.restore();
            this.clear();
            const { ink } = this;
            ink.drawImage(this.dots, 0, 0, this.width, this.height);
            ink.strokeStyle = lab.drawing.ink;
            ink.lineWidth = 1.5;
            ink.beginPath();
            ink.arc(f.x(wrapped(lab.scene.theta0)), f.y(lab.scene.omega0), 9, 0, TURN);
            ink.stroke();
            // Outlines, each a little smaller than the one before: where they meet, all are seen.
            const step = lab.cursor?.step;
            lab.pendulums.forEach((pendulum, i) => {
                const { path, colour } = lab.drawing.looks.get(pendulum.method.number);
                const at = step === undefined ? null : pendulum.near(step);
                const [theta, omega] = at
                    ? [at.theta, at.omega]
                    : [wrapped(pendulum.read(THETA)), pendulum.read(OMEGA)];
                const size = 1.35 - 0.75 * (i / Math.max(lab.pendulums.length - 1, 3));
                hollow(ink, path, f.x(theta), f.y(omega), size, colour);
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

    theLab.Portrait = Portrait;
})((globalThis.theLab ??= {}));
