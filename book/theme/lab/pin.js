// A run that is kept, to be compared with another. It is in the page's address, and what an address
// says is computed again.
'use strict';

// The least steps of a piece of a pinned run, and the pieces that a long one has at least.
const PIN_STEPS = 64;
const PIN_PIECES = 512;

class Pin {
    constructor(lab, library) {
        Object.assign(this, { lab, library, text: '', kept: null });
        this.words = element('span', { class: 'note' });
        this.put = button('pin', 'Pin this run', () => this.take());
        this.off = button('unpin', 'Unpin', () => {
            lab.adjust({ pin: '' });
            this.put.focus();
        });
        this.live = element('div', { class: 'buttons pins' }, this.put, this.off, this.words);
    }

    // The pendulums whose curves are drawn: none if they are of another quantity.
    shown() {
        const { kept, lab } = this;
        return kept && conserves(kept.scene) === conserves(lab.scene) ? kept.pendulums : [];
    }

    get dt() {
        return this.kept?.scene.dt;
    }

    get time() {
        return this.kept?.time;
    }

    // Keeps the present run as it is.
    take() {
        const { lab } = this;
        if (lab.taken === 0) {
            lab.page.say('There is nothing to pin before the run has begun.');
            return;
        }
        clearTimeout(this.waiting);
        this.text = pinOf(lab.scene, lab.taken);
        const pendulums = lab.pendulums.map(({ method, energy, angle }) => {
            return { method, energy: energy.copy(), angle: angle.copy() };
        });
        this.kept = { scene: lab.scene, time: lab.time, steps: lab.taken, pendulums };
        lab.adjust({ pin: this.text });
        lab.page.say('The run is pinned: change the scene, and compare.');
    }

    // Shows what the scene says is pinned; computes it if it is not there.
    settle() {
        const { lab } = this,
            { scene } = lab;
        if (scene.pin !== this.text) {
            clearTimeout(this.waiting);
            this.text = scene.pin;
            this.kept = null;
            const pinned = scene.pin && this.library && lab.addresses.pinned(scene.pin);
            if (pinned) this.begin(pinned);
        }
        this.off.hidden = !this.kept;
        this.words.textContent = this.kept ? this.say() : '';
    }

    begin({ scene, steps }) {
        this.run = new Run(this.library, this.lab.known);
        this.run.set({ ...scene, until: 0 });
        const { pendulums } = this.run;
        this.kept = { scene, time: 0, steps, pendulums };
        // First the page shows the scene.
        if (pendulums.length) this.waiting = setTimeout(() => this.goOn());
    }

    // Takes some steps of a pinned run, and more when the page has had its turn.
    goOn() {
        const { run, kept, lab } = this;
        const piece = Math.max(PIN_STEPS, Math.ceil(kept.steps / PIN_PIECES));
        const n = Math.min(piece, kept.steps - run.taken);
        const more = n > 0 && run.advance(n, performance.now() + SLICE);
        kept.time = run.time;
        if (more && run.taken < kept.steps) {
            this.waiting = setTimeout(() => this.goOn());
            return;
        }
        if (!lab.running) lab.drawing.plots();
    }

    // What is pinned, as far as it differs from the scene.
    say() {
        const { scene, steps } = this.kept,
            now = this.lab.scene,
            end = seconds(steps * scene.dt, scene.dt);
        const other = scene.system !== now.system;
        const differs = keysOf(scene.system)
            .filter(key => other || scene[key] !== now[key])
            .map(key => worded(scene, key));
        if (other) differs.unshift(SYSTEMS[scene.system].title.toLowerCase());
        if (scene.methods.join() !== now.methods.join()) {
            const title = name => this.lab.known.find(known => known.name === name).title;
            differs.push(scene.methods.map(title).join(', '));
        }
        const what = differs.length ? differs.join(', ') : 'the same scene';
        const seen = this.shown().length ? 'Dotted' : 'Pinned, but a different quantity';
        return `${seen}: ${what}; up to ${end} s`;
    }
}
