// A lab as it stands on its page, with the lessons beside it, whose words stand in the chapter.
'use strict';

// The steps of each lesson in the page, by name: their words, what they change of the lesson's
// scene, and for how long (s) they compare it with the step before.
function lessonsOf(page) {
    const lessons = {};
    for (const list of page.querySelectorAll('.lesson-steps[data-lesson]')) {
        lessons[list.dataset.lesson] = [...list.children].map(words => ({
            words,
            changes: words.dataset.changes ?? '',
            compares: Number(words.dataset.compares ?? 0),
        }));
    }
    return lessons;
}

class Lessons {
    constructor(lab) {
        this.lab = lab;
        const names = Object.keys(PRESETS);
        // All steps of all lessons, one after another: [lesson, step].
        this.walk = names.flatMap(name => (lab.lessons[name] ?? [0]).map((_, i) => [name, i + 1]));
        this.choice = select(
            { 'aria-label': 'Lesson', onchange: () => lab.lesson(this.choice.value, 1) },
            names.map(name => [name, PRESETS[name].title]),
        );
        this.where = element('span', { class: 'note' });
        // Said when the step changes, after what is being said.
        this.words = element('div', { class: 'words', 'aria-live': 'polite' });
        this.changed = element('p', { class: 'note changed' });
        this.back = button('back', 'Back', () => this.turn(-1));
        this.next = button('forward', 'Next', () => this.turn(1));
        this.set = button('set', 'Set the scene again', () => {
            const { lesson, step } = lab.scene;
            lab.lesson(lesson, step);
        });
        this.beside = markup`
            <section class="beside" aria-label="Lesson">
                <p class="title">${this.choice}${this.where}</p>
                ${this.words}
                <div class="buttons">${[this.back, this.next, this.set]}</div>
                ${this.changed}
            </section>`;
    }

    // The step before or after the present one, across lessons, if there is one.
    neighbour(by) {
        const { lesson, step } = this.lab.scene;
        const at = this.walk.findIndex(([name, i]) => name === lesson && i === step);
        return this.walk[at + by];
    }

    turn(by) {
        const to = this.neighbour(by);
        if (to) this.lab.lesson(...to);
    }

    // Shows the step of the scene.
    settle() {
        const { lab } = this,
            { lesson, step } = lab.scene,
            steps = lab.lessons[lesson] ?? [];
        this.choice.value = lesson;
        const [before, after] = [this.neighbour(-1), this.neighbour(1)];
        // Kept in the order of the keyboard, so that the focus is not lost.
        this.back.setAttribute('aria-disabled', !before);
        this.next.setAttribute('aria-disabled', !after);
        this.next.textContent = after && after[0] !== lesson ? 'Next lesson' : 'Next';
        const off = !lab.isStep();
        this.set.hidden = !off;
        this.changed.hidden = !off;
        this.changed.textContent = off ? 'You have changed the scene of this step.' : '';
        const shown = `${lesson}/${step}`;
        if (this.shown === shown) return;
        this.shown = shown;
        this.where.textContent = `Step ${step} of ${Math.max(steps.length, 1)}`;
        const words = steps[step - 1]?.words.cloneNode(true);
        this.words.replaceChildren(...(words ? words.childNodes : []));
    }
}

// Takes the time between two presses, of the pendulums' own clock.
class Stopwatch {
    constructor(lab) {
        this.lab = lab;
        this.from = this.to = null;
        this.button = button('watch', 'Stopwatch', () => this.press());
        this.read = element('output', { class: 'lapse', 'aria-live': 'off' });
        this.live = [this.button, this.read];
    }

    press() {
        const { from, to, lab } = this;
        if (from === null) this.from = lab.time;
        else if (to === null) this.to = lab.time;
        else this.from = this.to = null;
        this.show();
    }

    show() {
        const { lab } = this;
        // Another run has begun.
        if (Math.max(this.from, this.to) > lab.time) this.from = this.to = null;
        const { from, to } = this;
        this.button.textContent =
            from === null ? 'Stopwatch' : to === null ? 'Stop the watch' : 'Back to zero';
        this.read.textContent =
            from === null ? '' : `${seconds((to ?? lab.time) - from, lab.scene.dt)} s`;
    }
}

class Page {
    constructor(lab) {
        this.lab = lab;
        const { drawing, whole, hero, preset } = lab;
        const sheet = (own, notes = []) => markup`<div class="sheet">${own.canvas}${notes}</div>`;
        this.run = button('run', 'Run', () => lab.run(!lab.running));
        this.time = element('output', { class: 'time', 'aria-live': 'off' });
        this.slow = element('span', { class: 'note', hidden: true }, 'as fast as it can go');
        this.orbit = element('span', { class: 'note' });
        this.said = element('p', { class: 'note said', role: 'status' });
        this.controls = new Controls(lab);
        this.numbers = new Numbers(lab);
        this.lessons = whole ? new Lessons(lab) : null;
        const plots = whole ? [drawing.energy, drawing.angle] : [drawing[PRESETS[preset].shows]];
        this.watch = whole ? new Stopwatch(lab) : null;
        // On the first page the pendulums stand alone.
        this.reading = new Reading(lab, hero ? [] : [drawing.phase, ...plots]);
        this.live = markup`
            <div class="live" role="group">
                <div class="scene">
                    <div class="bench">
                        <div class="stage">${drawing.stage.canvas}</div>
                        <div class="buttons">
                            ${this.run}
                            ${hero ? [] : button('step', 'One step', () => lab.oneStep())}
                            ${button('again', 'Start again', () => lab.again())}
                            ${whole ? this.watch.live : []}
                            ${[this.time, this.slow]}
                        </div>
                        <p class="note">Drag a bob and let go: all begin there, at rest.</p>
                    </div>
                    ${whole ? this.lessons.beside : []}
                    ${hero ? [] : markup`<div class="rest">
                        <div class="sheets">
                            ${sheet(drawing.phase, this.orbit)}
                            ${plots.map(plot => sheet(plot))}
                            ${this.reading.box}
                        </div>
                        ${whole ? lab.pin.live : []}
                    </div>`}
                    ${hero ? [] : markup`<div class="settings">${this.controls.live}</div>`}
                </div>
                <div class="below">
                    ${hero ? [] : this.numbers.table}
                    ${whole ? [this.numbers.digits(), new Keep(lab).live] : this.onward()}
                    ${this.said}
                </div>
            </div>`;
        this.live.ariaLabel = `Lab: ${PRESETS[preset].title}`;
    }

    onward() {
        const href = new URL(`lab.html#${this.lab.preset}`, ROOT);
        const link = element('a', { href }, 'Open it in the lab');
        return markup`<p class="note onward">${link}</p>`;
    }

    // Updates what depends on the scene alone.
    settle() {
        const { scene } = this.lab;
        this.lab.drawing.colours();
        this.controls.settle();
        this.lessons?.settle();
        this.orbit.textContent = [
            isClosed(scene) && 'solid: exact orbit',
            ['pendulum', 'driven'].includes(scene.system) && 'dotted: separatrix',
            scene.system === 'double' && 'the upper bob alone',
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
        this.watch?.show();
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
