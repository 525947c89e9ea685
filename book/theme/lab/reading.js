// Reading numbers off the plots and the phase portrait, with a pointer or with the keyboard.
(theLab => {
    'use strict';

    const { element, measured, seconds } = theLab;

    // How near a pointer has to be to a point of the phase portrait (px).
    const NEAR = 14;
    // How many times an arrow key moves across a plot.
    const KEYS = 100;

    class Reading {
        constructor(lab, sheets) {
            this.lab = lab;
            // What it says is the value of the slider that the drawing is.
            this.box = element('div', { class: 'reading', 'aria-hidden': 'true', hidden: true });
            for (const sheet of sheets) this.listen(sheet);
        }

        listen(sheet) {
            const { lab } = this,
                { canvas } = sheet,
                portrait = sheet === lab.drawing.phase;
            canvas.setAttribute('role', 'slider');
            canvas.tabIndex = 0;
            this.say(canvas, null);
            const at = event => {
                if (lab.held) return this.put(null);
                const box = canvas.getBoundingClientRect(),
                    [x, y] = [event.clientX - box.left, event.clientY - box.top];
                if (!portrait) {
                    const { left, right } = sheet.frame();
                    return this.put(x >= left && x <= right ? sheet.time(x) : null, sheet);
                }
                const near = sheet.nearest(x, y, NEAR);
                return this.put(near && near.steps * lab.scene.dt, sheet);
            };
            canvas.addEventListener('pointermove', at);
            canvas.addEventListener('pointerdown', at);
            canvas.addEventListener('pointerleave', event => {
                // A finger that is lifted leaves what it pointed at.
                if (event.pointerType !== 'touch') this.put(null);
            });
            canvas.addEventListener('blur', () => this.put(null));
            canvas.addEventListener('keydown', event => {
                const now = lab.cursor?.time ?? lab.time;
                const by = event.shiftKey ? lab.scene.dt : Math.max(lab.time / KEYS, lab.scene.dt);
                const to = {
                    ArrowLeft: now - by,
                    ArrowDown: now - by,
                    ArrowRight: now + by,
                    ArrowUp: now + by,
                    Home: 0,
                    End: lab.time,
                    Escape: null,
                }[event.key];
                if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
                // The book's arrow keys turn the page.
                event.preventDefault();
                event.stopPropagation();
                this.put(to, sheet);
            });
        }

        // Reads out at the step nearest to the time (s), or nothing.
        put(time, sheet) {
            const { lab } = this,
                { dt } = lab.scene;
            if (time === null && !lab.cursor) return;
            if (this.sheet && this.sheet !== sheet) this.say(this.sheet.canvas, null);
            if (time === null) {
                lab.cursor = null;
                this.box.hidden = true;
            } else {
                // At the start there is no error to read.
                const step = Math.min(Math.max(Math.round(time / dt), 1), lab.taken);
                lab.cursor = { step, time: step * dt };
                this.sheet = sheet;
            }
            lab.drawing.plots();
            lab.drawing.phase.draw();
            this.show();
        }

        // Brings the read-out up to date, while the run goes on.
        show() {
            const { lab, sheet, box } = this;
            if (!lab.cursor || !sheet) return;
            lab.cursor.step = Math.min(lab.cursor.step, lab.taken);
            lab.cursor.time = lab.cursor.step * lab.scene.dt;
            const rows = this.rows(sheet);
            const t = `t = ${seconds(lab.cursor.time, lab.scene.dt)} s`;
            box.replaceChildren(
                element('p', {}, t),
                element(
                    'table',
                    {},
                    ...rows.map(([name, words]) =>
                        element('tr', {}, element('td', {}, name), element('td', {}, words)),
                    ),
                ),
            );
            box.hidden = false;
            this.say(sheet.canvas, `${t}: ${rows.map(row => row.join(' ')).join('; ')}`);
            this.stand(sheet);
        }

        // Beside the cursor, on the side where there is more room.
        stand(sheet) {
            const { box, lab } = this,
                { canvas } = sheet,
                place = canvas.parentElement;
            const portrait = sheet === lab.drawing.phase;
            const { left, right, top, bottom } = sheet.frame();
            const far = !portrait && lab.cursor.time < sheet.span / 2;
            const x = far || portrait ? right - box.offsetWidth - 4 : left + 4;
            box.style.left = `${place.offsetLeft + Math.max(x, 0)}px`;
            // In the portrait where the point is not.
            const point = portrait && lab.pendulums[0]?.near(lab.cursor.step);
            const above = point && point.omega > 0;
            const y = above ? bottom - box.offsetHeight - 4 : top + 4;
            box.style.top = `${place.offsetTop + y}px`;
        }

        // What each method has at the cursor, and each that is pinned.
        rows(sheet) {
            const { lab } = this,
                { cursor, drawing } = lab;
            if (sheet === drawing.phase) {
                return lab.pendulums.map(pendulum => {
                    const point = pendulum.near(cursor.step);
                    return [pendulum.method.title, point ? this.state(point) : '–'];
                });
            }
            const unit = sheet === drawing.angle ? 'rad' : 'J';
            const words = (pendulum, step) => {
                const bin = sheet.seriesOf(pendulum).at(step);
                if (!bin) return '–';
                const [low, high] = bin.map(measured);
                // Several steps in one place of the curve.
                return low === high ? `${low} ${unit}` : `${low} to ${high} ${unit}`;
            };
            const own = lab.pendulums.map(p => [p.method.title, words(p, cursor.step)]);
            const step = pendulum => Math.round(cursor.time / lab.pin.dt);
            const pinned = lab.pin.shown().map(p => [
                `${p.method.title}, pinned`,
                cursor.time <= lab.pin.time ? words(p, step(p)) : '–',
            ]);
            return [...own, ...pinned];
        }

        // A point in phase space; of another step than the cursor's if not every one is kept.
        state({ steps, theta, omega }) {
            const { cursor, scene } = this.lab;
            const other =
                steps === cursor.step ? '' : ` at ${seconds(steps * scene.dt, scene.dt)} s`;
            return `θ = ${measured(theta)} rad, ω = ${measured(omega)} rad/s${other}`;
        }

        // The drawing as a slider over time.
        say(canvas, words) {
            const { lab } = this;
            canvas.setAttribute('aria-valuemin', 0);
            canvas.setAttribute('aria-valuemax', lab.taken);
            canvas.setAttribute('aria-valuenow', lab.cursor?.step ?? lab.taken);
            canvas.setAttribute('aria-valuetext', words ?? 'nothing read out');
        }
    }

    theLab.Reading = Reading;
})((globalThis.theLab ??= {}));
