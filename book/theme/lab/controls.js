// What a reader can set in a lab: system, sliders, speed, methods.
'use strict';

// What a pendulum may hang on: the acceleration there (m/s²).
const PLANETS = [
    [1.62, 'Moon'],
    [3.71, 'Mars'],
    [8.87, 'Venus'],
    [9.81, 'Earth'],
    [24.79, 'Jupiter'],
];

class Controls {
    constructor(lab) {
        this.lab = lab;
        this.sliders = {};
        this.rows = {};
        const keys = Object.keys(SLIDERS).filter(
            key => lab.whole || key === 'dt' || key === 'theta0',
        );
        const until = lab.whole ? this.until() : [];
        this.live = [
            markup`<div class="sliders">${keys.map(key => this.slider(key))}</div>`,
            markup`<div class="buttons">
                ${this.speed()}${until}${this.scale()}${this.trails()}
            </div>`,
        ];
        if (!lab.whole) return;
        this.live.unshift(markup`<div class="buttons">${[this.system(), this.planets()]}</div>`);
        this.live.push(this.choice());
    }

    system() {
        const onchange = () => {
            const { scene } = this.lab,
                start = startOf(this.kind.value);
            // Gravity and length stay, and the methods, if one of them suits.
            const kept = scene.methods.filter(name => this.suits(name, start));
            const { g, L, speed, scale, lesson, step } = scene;
            const methods = kept.length ? kept : start.methods;
            this.lab.change({ ...start, methods, g, L, speed, scale, lesson, step });
        };
        const titles = Object.entries(SYSTEMS).map(([name, { title }]) => [name, title]);
        this.kind = select({ class: 'system', onchange }, titles);
        return element('label', {}, 'System', this.kind);
    }

    planets() {
        const onchange = () => this.lab.change({ g: Number(this.planet.value) });
        const places = PLANETS.map(([g, name]) => [g, `${name}, ${g} m/s²`]);
        this.planet = select({ class: 'planet', onchange }, [['', 'as set below'], ...places]);
        this.planet.options[0].disabled = true;
        return element('label', {}, 'Gravity', this.planet);
    }

    // Whether the library has a method for the system of a scene, be the step as short as may
    // be.
    suits(name, scene) {
        const method = this.lab.known.find(known => known.name === name);
        return place(this.lab.stopwatch, 0, method, { ...scene, dt: 1e-3 });
    }

    speed() {
        const onchange = () => this.lab.adjust({ speed: Number(this.pace.value) });
        const words = SPEEDS.map(speed => [speed, `${speed} ×`.replace('0.25', '¼')]);
        this.pace = select({ class: 'speed', onchange }, words);
        return element('label', {}, 'Speed', this.pace);
    }

    until() {
        this.end = field('number', 'until', [0, LONGEST, 'any'], {
            placeholder: 'never',
            'aria-label': 'Stop at (s), or empty for never',
            onchange: () => {
                const given = this.end.valueAsNumber;
                this.lab.change({ until: given > 0 && given <= LONGEST ? given : 0 });
            },
        });
        return element('label', {}, 'Stop at', this.end, 's');
    }

    scale() {
        const { box, label } = checkbox('scale', 'Errors on a logarithmic scale', false, on =>
            this.lab.adjust({ scale: on ? 'log' : 'linear' }),
        );
        this.logarithmic = box;
        return label;
    }

    trails() {
        const { stage } = this.lab.drawing;
        const bars = checkbox('bars', 'Energy bars', stage.bars, on => {
            stage.bars = on;
            stage.draw();
        });
        bars.label.title = 'Potential energy, the kinetic on top; the line is their sum at first';
        this.bars = bars.label;
        const trails = checkbox('trails', 'Trails', stage.trails, on => {
            stage.trails = on;
            stage.draw();
        });
        return this.lab.whole ? [bars.label, trails.label] : trails.label;
    }

    slider(key) {
        const { label, unit, from, to, by, least, most, logarithmic } = SLIDERS[key];
        const value = at => Number(logarithmic ? (10 ** at).toPrecision(3) : at.toFixed(2));
        const range = field('range', key, [from, to, by], {
            oninput: () => this.lab.change({ [key]: value(Number(range.value)) }),
        });
        const typed = field('number', key, [least, most, 'any'], {
            'aria-label': `${label} (${unit}), as a number`,
            onchange: () => {
                const given = typed.valueAsNumber;
                if (given >= least && given <= most) {
                    this.lab.change({ [key]: given });
                } else {
                    this.sliders[key](this.lab.scene[key]);
                    this.lab.page.say(`${label} must be from ${least} to ${most} ${unit}.`);
                }
            },
        });
        this.sliders[key] = now => {
            range.value = logarithmic ? Math.log10(now) : now;
            range.setAttribute('aria-valuetext', `${now} ${unit}`);
            typed.value = now;
        };
        this.rows[key] = markup`
            <div class="slider">
                <label><span>${`${label} (${unit})`}</span>${range}</label>${typed}
            </div>`;
        return this.rows[key];
    }

    choice() {
        this.signs = [];
        const box = method => {
            const input = element('input', {
                type: 'checkbox',
                value: method.name,
                onchange: () => this.choose(),
            });
            const path = drawn('path', { d: `M0,0${look(method).marker}` });
            this.signs.push([method, path]);
            const sign = drawn('svg', { viewBox: '-8 -8 16 16', 'aria-hidden': 'true' }, path);
            return element('label', {}, input, sign, method.title);
        };
        const papers = this.lab.known.filter(method => PAPERS.includes(method.name)).map(box);
        const others = this.lab.known.filter(method => !PAPERS.includes(method.name)).map(box);
        this.boxes = [...papers, ...others].map(label => label.querySelector('input'));
        this.others = markup`
            <details><summary>More methods</summary><div>${others}</div></details>`;
        return markup`
            <fieldset class="methods">
                <legend>Methods, up to ${String(this.lab.places)}</legend>
                <div>${papers}</div>
                ${this.others}
            </fieldset>`;
    }

    choose() {
        const chosen = this.boxes.filter(box => box.checked).map(box => box.value);
        // Methods that were chosen already keep their places.
        const kept = this.lab.scene.methods.filter(name => chosen.includes(name));
        const methods = [...kept, ...chosen.filter(name => !kept.includes(name))];
        if (methods.length) this.lab.change({ methods });
        else this.lab.adjust({});
    }

    // Shows the scene.
    settle() {
        const { scene, places, whole } = this.lab;
        for (const [key, show] of Object.entries(this.sliders)) show(scene[key]);
        this.pace.value = scene.speed;
        this.logarithmic.checked = scene.scale === 'log';
        if (!whole) return;
        const keys = keysOf(scene.system);
        for (const [key, row] of Object.entries(this.rows)) row.hidden = !keys.includes(key);
        this.kind.value = scene.system;
        this.end.value = scene.until || '';
        // What does not suit the system is not offered.
        const sort = `${scene.system} ${scene.beta > 0}`;
        if (this.sort !== sort) {
            this.sort = sort;
            const any = startOf(scene.system);
            if (scene.system === 'pendulum') any.beta = Math.min(scene.beta, 0.1);
            for (const box of this.boxes) box.parentElement.hidden = !this.suits(box.value, any);
        }
        this.planet.value = PLANETS.some(([g]) => g === scene.g) ? scene.g : '';
        this.bars.hidden = !hasBars(scene);
        for (const [{ number }, path] of this.signs)
            path.style.fill = `var(${this.lab.drawing.looks.get(number).name})`;
        for (const box of this.boxes) {
            box.checked = scene.methods.includes(box.value);
            box.disabled = !box.checked && scene.methods.length >= places;
        }
        // The list must be open if it contains a chosen method.
        if (scene.methods.some(name => !PAPERS.includes(name))) this.others.open = true;
    }
}
