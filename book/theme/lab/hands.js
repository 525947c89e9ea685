// The pointer and the keyboard on a lab’s drawings: dragging bobs and the phase portrait, reading
// numbers off the plots. A touch elsewhere scrolls the page.
'use strict';

// How far a touch may be from what it drags (px); a mouse drags what is nearest.
const FINGER = 30;

// `grasp(point, reach)` returns what can be dragged there, or null; `move(held, point)` moves
// it, and `end()` is told when it is let go. Points have clientX and clientY.
function draggable(target, grasp, move, end = () => {}) {
    let held = null;
    target.addEventListener(
        'touchstart',
        event => {
            if (grasp(event.touches[0], FINGER)) event.preventDefault();
        },
        { passive: false },
    );
    target.addEventListener('pointerdown', event => {
        if (event.button !== 0) return;
        held = grasp(event, event.pointerType === 'touch' ? FINGER : Infinity);
        if (!held) return;
        target.setPointerCapture(event.pointerId);
        move(held, event);
    });
    target.addEventListener('pointermove', event => {
        if (held) move(held, event);
    });
    for (const name of ['pointerup', 'pointercancel']) {
        target.addEventListener(name, () => {
            if (held) end();
            held = null;
        });
    }
}

// What is dragged on a canvas changes the lab's scene, which rests until it is let go.
function draggableIn(lab, canvas, grasp, move) {
    const at = event => {
        const box = canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    };
    draggable(
        canvas,
        (point, reach) => grasp(...at(point), reach),
        (held, point) => {
            lab.running = false;
            lab.held = lab.grasped = true;
            move(held, ...at(point));
        },
        () => {
            lab.held = false;
            lab.remember();
            lab.go();
        },
    );
}

function takeHands(lab) {
    const { drawing } = lab;
    draggableIn(
        lab,
        drawing.stage.canvas,
        (x, y, reach) => {
            const { stage } = drawing;
            const bobs = lab.pendulums.flatMap((pendulum, i) => {
                const pivot = stage.pivot(i),
                    within = Math.abs(x - pivot.x) <= stage.cell / 2;
                const all = stage.bobs(pivot, pendulum.read(THETA), pendulum.read(LOWER_THETA));
                return all.map(([bx, by], which) => {
                    // The lower bob turns about the upper one.
                    const about = which ? { x: all[0][0], y: all[0][1] } : pivot;
                    return { which, about, away: Math.hypot(x - bx, y - by), within };
                });
            });
            // A pointer in a cell drags only that cell's pendulum.
            const own = bobs.filter(bob => bob.within).sort((a, b) => a.away - b.away)[0];
            return own && own.away <= Math.min(reach, 0.6 * drawing.stage.cell) ? own : null;
        },
        ({ which, about }, x, y) => {
            const theta = Math.round(1000 * Math.atan2(x - about.x, y - about.y)) / 1000;
            const lower = { theta2: theta, omega2: 0 },
                upper = { theta0: theta, omega0: 0 };
            lab.change(which ? lower : upper, true);
        },
    );
    draggableIn(
        lab,
        drawing.phase.canvas,
        (x, y, reach) => {
            const frame = drawing.phase.frame(),
                { left, right, top, bottom } = frame;
            const away = Math.hypot(
                x - frame.x(wrapped(lab.scene.theta0)),
                y - frame.y(lab.scene.omega0),
            );
            return x > left && x < right && y > top && y < bottom && away <= reach ? frame : null;
        },
        (frame, x, y) => {
            const clamp = (value, most) => Math.min(Math.max(value, -most), most);
            const theta0 = Math.round(1000 * clamp(frame.theta(x), Math.PI)) / 1000;
            const omega0 = Math.round(100 * clamp(frame.omega(y), drawing.phase.reach)) / 100;
            lab.change({ theta0, omega0 }, true);
        },
    );
}

// How near a pointer has to be to a point of the phase portrait (px).
const REACH = 14;
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
            const near = sheet.nearest(x, y, REACH);
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
        const row = ([name, words]) => markup`<tr><td>${name}</td><td>${words}</td></tr>`;
        box.replaceChildren(markup`<p>${t}</p>`, markup`<table>${rows.map(row)}</table>`);
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
        const step = Math.round(cursor.time / lab.pin.dt);
        const pinned = lab.pin
            .shown()
            .map(p => [
                `${p.method.title}, pinned`,
                cursor.time <= lab.pin.time ? words(p, step) : '–',
            ]);
        return [...own, ...pinned];
    }

    // A point in phase space; of another step than the cursor's if not every one is kept.
    state({ steps, theta, omega }) {
        const { cursor, scene } = this.lab;
        const other = steps === cursor.step ? '' : ` at ${seconds(steps * scene.dt, scene.dt)} s`;
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
