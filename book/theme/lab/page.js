// A lab as it stands on its page.
(theLab => {
    'use strict';

    const { Controls, Keep, Lessons, Numbers, PRESETS, QUANTITY, ROOT, Reading } = theLab;
    const { button, conserves, count, element, isClosed, measured, seconds } = theLab;
    const { LARGEST } = QUANTITY;

    class Page {
        constructor(lab) {
            this.lab = lab;
            const { drawing, whole, preset } = lab;
            const sheet = (own, ...notes) =>
                element('div', { class: 'sheet' }, own.canvas, ...notes);
            this.run = button('run', 'Run', () => lab.run(!lab.running));
            this.time = element('output', { class: 'time', 'aria-live': 'off' });
            this.slow = element('span', { class: 'note', hidden: true }, 'as fast as it can');
            this.orbit = element('span', { class: 'note' });
            this.said = element('p', { class: 'note said', role: 'status' });
            this.controls = new Controls(lab);
            this.numbers = new Numbers(lab);
            this.lessons = whole ? new Lessons(lab) : null;
            const plots = whole
                ? [drawing.energy, drawing.angle]
                : [drawing[PRESETS[preset].shows]];
            this.reading = new Reading(lab, [drawing.phase, ...plots]);
            this.live = element(
                'div',
                { class: 'live', role: 'group', 'aria-label': `Lab: ${PRESETS[preset].title}` },
                ...(whole ? [this.lessons.nav] : []),
                element(
                    'div',
                    { class: 'bench' },
                    element('div', { class: 'stage' }, drawing.stage.canvas),
                    element(
                        'div',
                        { class: 'buttons' },
                        this.run,
                        button('step', 'One step', () => lab.oneStep()),
                        button('again', 'Start again', () => lab.again()),
                        this.time,
                        this.slow,
                    ),
                ),
                ...(whole ? [this.lessons.beside] : []),
                element(
                    'div',
                    { class: 'rest' },
                    element(
                        'div',
                        { class: 'sheets' },
                        sheet(drawing.phase, this.orbit),
                        ...plots.map(plot => sheet(plot)),
                        this.reading.box,
                    ),
                    ...(whole ? [lab.pin.live] : []),
                    ...this.controls.live,
                ),
                element(
                    'div',
                    { class: 'below' },
                    this.numbers.table,
                    ...(whole ? [this.numbers.digits(), new Keep(lab).live] : [this.onward()]),
                    this.said,
                ),
            );
        }

        onward() {
            return element(
                'p',
                { class: 'note onward' },
                element(
                    'a',
                    { href: new URL(`lab.html#${this.lab.preset}`, ROOT) },
                    'Open it in the lab',
                ),
            );
        }

        // Updates what depends on the scene alone.
        settle() {
            const { scene } = this.lab;
            this.controls.settle();
            this.lessons?.settle();
            this.orbit.textContent = [
                isClosed(scene) && 'solid: exact orbit',
                ['pendulum', 'driven'].includes(scene.system) && 'dotted: separatrix',
                scene.system === 'double' && 'of the upper bob',
                'ring: start',
            ]
                .filter(Boolean)
                .join('; ');
            // There is nothing to compare an angle with.
            const { parentElement } = this.lab.drawing.angle.canvas;
            if (parentElement) parentElement.hidden = !isClosed(scene);
            this.numbers.caption();
            this.lab.pin.settle();
        }

        // Updates the numbers.
        show() {
            const { scene, running, time, taken } = this.lab;
            const steps = `${count(taken)} ${taken === 1 ? 'step' : 'steps'}`;
            this.run.textContent = running ? 'Pause' : 'Run';
            this.time.textContent = `t = ${seconds(time, scene.dt)} s, ${steps}`;
            this.numbers.show();
            this.lab.drawing.describe();
        }

        // The state of the run, for screen readers.
        summary() {
            const { scene, pendulums, time, taken } = this.lab;
            if (taken === 0) return 'At the start.';
            const errors = pendulums
                .map(p => `${p.method.title} ${measured(p.read(LARGEST))}\u00a0J`)
                .join(', ');
            return (
                `Paused at ${seconds(time, scene.dt)} s, ` +
                `after ${count(taken)} ${taken === 1 ? 'step' : 'steps'}.` +
                (conserves(scene) ? ` Largest energy error: ${errors}.` : '')
            );
        }

        // Shows a message after the notice of the scene. The same text is not announced twice.
        say(words) {
            const all = [this.lab.notice, words].filter(Boolean).join(' ');
            if (this.said.textContent !== all) this.said.textContent = all;
        }
    }

    theLab.Page = Page;
})((globalThis.theLab ??= {}));
