// The level curve of symplectic Euler's H̃, built term by term under a slider, and the points of
// the method, step by step.
(theLab => {
    'use strict';

    const { Moved, Plane, element, figures, measured, words } = theLab;
    const FIRST = { theta: 1, omega: 0, h: 0.25, order: 7, steps: 25 };
    // Points on a curve.
    const POINTS = 401;

    figures.tilted = class extends Moved {
        constructor(spot, library, number) {
            super(spot, library, number);
            this.method = library.method('symplectic-euler');
            this.scene = { ...FIRST };
            const { svg, width, height } = this;
            const box = [38, 95, width - 20, height - 56];
            this.top = this.legend([]);
            svg.append(this.top, words('ω (rad/s)', { x: 0, y: 79 }));
            svg.append(
                words('θ (rad)', {
                    x: (box[0] + box[2]) / 2,
                    y: height - 12,
                    'text-anchor': 'middle',
                }),
            );
            this.plane = new Plane(svg, this.name, box, { theta: [-1.3, 1.3], omega: [-3.6, 3.6] });
            this.lay();
        }

        lay() {
            const slider = (key, label, unit, range) =>
                (this[key] = this.slider(key, label, unit, range, value =>
                    this.change({ [key]: value }),
                ));
            slider('h', 'Step h', 's', { from: 0.02, to: 0.4, by: 0.01 });
            slider('order', 'Terms of H̃', '', { from: 0, to: 7, by: 1 });
            slider('steps', 'Steps taken', '', { from: 0, to: 200, by: 1 });
            slider('theta', 'Released from', 'rad', { from: 0.2, to: 2.6, by: 0.1 });
            this.strays = element('output', { class: 'strays' });
            this.controls.append(
                element(
                    'div',
                    { class: 'sliders' },
                    ...['h', 'order', 'steps', 'theta'].map(key => this[key].part),
                ),
                element(
                    'div',
                    { class: 'buttons' },
                    this.button('step', 'One step', () =>
                        this.change({ steps: Math.min(this.scene.steps + 1, 200) }),
                    ),
                    this.button('reset', 'Reset', () => this.change(FIRST)),
                ),
                element('p', { class: 'note' }, this.strays),
            );
        }

        change(some) {
            Object.assign(this.scene, some);
            this.show();
        }

        show() {
            const { library, method, plane, scene } = this,
                { order, steps } = scene;
            for (const key of ['h', 'order', 'steps', 'theta']) this[key].set(scene[key]);
            library.scene(method, scene);
            const orbit = library.level(0, POINTS),
                curve = library.level(order, POINTS);
            // The orbit leaves its points where `strays` looks for them.
            const count = library.exports.orbit(steps + 1),
                points = library.points(count);
            const off = [0, order].map(n => library.exports.strays(n, count));
            const most = 2 * Math.sqrt(theLab.PENDULUM.g) * Math.sin(scene.theta / 2);
            plane.frame(
                [-1.3 * scene.theta, 1.3 * scene.theta],
                [-1.2 * most, 1.2 * most],
            );
            plane.clear();
            plane.curve(orbit);
            if (order > 0) plane.curve(curve, { dash: '7 4' });
            plane.markers(points, method);
            this.top.replaceWith((this.top = this.entries()));
            const lost = curve.some(Number.isNaN);
            const terms = order === 1 ? '1 term' : `${order} terms`;
            this.strays.textContent =
                `Over these steps H strays from its start by up to ${measured(off[0])} J` +
                (order === 0
                    ? '.'
                    : lost
                      ? `; with ${terms} the level of H̃ leaves the well, and is no closed curve.`
                      : `, and H̃ with ${terms} by up to ${measured(off[1])} J.`);
        }

        entries() {
            const { method, scene } = this,
                { colour, marker } = theLab.look(method);
            const own = colour.replace('--pendula-', '');
            const terms = scene.order === 1 ? 'one term' : `${scene.order} terms`;
            return this.legend([
                ['true orbit, H', 'M0,0h36', 'line'],
                [`${method.title}, h = ${scene.h} s`, `M18,0${marker}`, `dot ${own}`],
                ...(scene.order ? [[`H̃, ${terms}`, 'M0,0h36', 'line', '7 4']] : []),
            ]);
        }
    };
})((globalThis.theLab ??= {}));
