// Dragging the bobs and the phase portrait of a lab. A touch elsewhere scrolls the page.
(theLab => {
    'use strict';

    const {
        QUANTITY: { THETA, LOWER_THETA },
        wrapped,
    } = theLab;
    // How far a touch may be from what it drags (px); a mouse drags what is nearest.
    const FINGER = 30;

    // `grasp(x, y, reach)` returns what can be dragged there, or null; `move(held, x, y)` moves it.
    function draggable(lab, canvas, grasp, move) {
        const at = event => {
            const box = canvas.getBoundingClientRect();
            return [event.clientX - box.left, event.clientY - box.top];
        };
        let held = null;
        canvas.addEventListener(
            'touchstart',
            event => {
                if (grasp(...at(event.touches[0]), FINGER)) event.preventDefault();
            },
            { passive: false },
        );
        canvas.addEventListener('pointerdown', event => {
            held =
                event.button === 0
                    ? grasp(...at(event), event.pointerType === 'touch' ? FINGER : Infinity)
                    : null;
            if (!held) return;
            canvas.setPointerCapture(event.pointerId);
            lab.running = false;
            lab.held = true;
            move(held, ...at(event));
        });
        canvas.addEventListener('pointermove', event => {
            if (held) move(held, ...at(event));
        });
        for (const name of ['pointerup', 'pointercancel']) {
            canvas.addEventListener(name, () => {
                if (!held) return;
                held = null;
                lab.held = false;
                lab.remember();
                lab.go();
            });
        }
    }

    theLab.takeHands = lab => {
        const { drawing } = lab;
        draggable(
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
        draggable(
            lab,
            drawing.phase.canvas,
            (x, y, reach) => {
                const frame = drawing.phase.frame(),
                    { left, right, top, bottom } = frame;
                const away = Math.hypot(
                    x - frame.x(wrapped(lab.scene.theta0)),
                    y - frame.y(lab.scene.omega0),
                );
                return x > left && x < right && y > top && y < bottom && away <= reach
                    ? frame
                    : null;
            },
            (frame, x, y) => {
                const clamp = (value, most) => Math.min(Math.max(value, -most), most);
                const theta0 = Math.round(1000 * clamp(frame.theta(x), Math.PI)) / 1000;
                const omega0 = Math.round(100 * clamp(frame.omega(y), drawing.phase.reach)) / 100;
                lab.change({ theta0, omega0 }, true);
            },
        );
    };
})((globalThis.theLab ??= {}));
