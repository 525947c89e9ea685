// Dragging the bobs and the phase portrait of a lab. A touch elsewhere scrolls the page.
(theLab => {
    'use strict';

    const {
        QUANTITY: { THETA },
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
                const bobs = lab.pendulums.map((pendulum, i) => {
                    const pivot = drawing.pivot(i),
                        theta = pendulum.read(THETA);
                    const away = Math.hypot(
                        x - pivot.x - pivot.rod * Math.sin(theta),
                        y - pivot.y - pivot.rod * Math.cos(theta),
                    );
                    return { ...pivot, away, within: Math.abs(x - pivot.x) <= drawing.cell / 2 };
                });
                // A pointer in a cell drags only that cell's pendulum.
                const own = bobs.filter(bob => bob.within).sort((a, b) => a.away - b.away)[0];
                return own && own.away <= Math.min(reach, 0.6 * drawing.cell) ? own : null;
            },
            (pivot, x, y) => {
                const theta0 = Math.round(1000 * Math.atan2(x - pivot.x, y - pivot.y)) / 1000;
                lab.change({ theta0, omega0: 0 }, true);
            },
        );
        draggable(
            lab,
            drawing.phase.canvas,
            (x, y, reach) => {
                const frame = drawing.frame(),
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
                const omega0 = Math.round(100 * clamp(frame.omega(y), drawing.reach)) / 100;
                lab.change({ theta0, omega0 }, true);
            },
        );
    };
})((globalThis.theLab ??= {}));
