// The parts of a lab other than its drawings: buttons, sliders, methods, numbers.
(theLab => {
    'use strict';

    const { LONGEST, PAPERS, PRESETS, QUANTITY, ROOT, SLIDERS, SPEEDS } = theLab;
    const { address, look, presetScene, timed } = theLab;
    const { count, measured, rough, seconds } = theLab;
    const { THETA, OMEGA, TIME, STEPS, EVALUATIONS, ENERGY, ERROR, LARGEST, INITIAL } = QUANTITY;

    function element(name, attributes = {}, ...children) {
        const made = document.createElement(name);
        for (const [key, value] of Object.entries(attributes)) {
            if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
            else if (value !== false) made.setAttribute(key, value === true ? '' : value);
        }
        made.append(...children);
        return made;
    }

    class Page {
        constructor(lab) {
            this.lab = lab;
            const { drawing, whole, preset } = lab;
            const button = (name, words, onclick) =>
                element('button', { type: 'button', class: name, onclick }, words);
            const sheet = (own, ...notes) =>
                element('div', { class: 'sheet' }, own.canvas, ...notes);
            this.run = button('run', 'Run', () => lab.run(!lab.running));
            this.time = element('output', { class: 'time', 'aria-live': 'off' });
            this.slow = element('span', { class: 'note', hidden: true }, 'as fast as it can');
            this.orbit = element('span', { class: 'note' });
            this.head = element('thead');
            this.rows = element('tbody');
            this.said = element('p', { class: 'note said', role: 'status' });
            this.sliders = {};
            const keys = Object.keys(SLIDERS).filter(
                key => whole || key === 'dt' || key === 'theta0',
            );
            const plots = whole
                ? [drawing.energy, drawing.angle]
                : [drawing[PRESETS[preset].shows]];
            this.live = element(
                'div',
                { class: 'live', role: 'group', 'aria-label': `Lab: ${PRESETS[preset].title}` },
                ...(whole ? [this.lessons()] : []),
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
                element('div', { class: 'sliders' }, ...keys.map(key => this.slider(key))),
                element(
                    'div',
                    { class: 'buttons' },
                    this.speed(),
                    ...(whole ? [this.until()] : []),
                    this.scale(),
                ),
                ...(whole ? [this.choice()] : []),
                element(
                    'div',
                    { class: 'sheets' },
                    sheet(drawing.phase, this.orbit),
                    ...plots.map(plot => sheet(plot)),
                ),
                element(
                    'div',
                    { class: 'table-wrapper' },
                    element('table', {}, this.head, this.rows),
                ),
                whole ? this.digits() : this.onward(),
                this.said,
            );
        }

        // ----------------------------------------------------------------------------- what can be
        // set

        lessons() {
            this.links = Object.keys(PRESETS).map(name =>
                element(
                    'a',
                    {
                        href: `#${name}`,
                        onclick: event => {
                            event.preventDefault();
                            this.lab.lesson(name);
                        },
                    },
                    PRESETS[name].title,
                ),
            );
            return element('nav', { class: 'lessons', 'aria-label': 'Lessons' }, ...this.links);
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

        speed() {
            const options = SPEEDS.map(speed =>
                element('option', { value: speed }, `${speed}`.replace('0.25', '¼') + ' ×'),
            );
            this.pace = element(
                'select',
                {
                    class: 'speed',
                    onchange: () => this.lab.adjust({ speed: Number(this.pace.value) }),
                },
                ...options,
            );
            return element('label', {}, 'Speed', this.pace);
        }

        until() {
            this.end = element('input', {
                type: 'number',
                class: 'until',
                min: 0,
                max: LONGEST,
                step: 'any',
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
            this.logarithmic = element('input', {
                type: 'checkbox',
                class: 'scale',
                onchange: () =>
                    this.lab.adjust({ scale: this.logarithmic.checked ? 'log' : 'linear' }),
            });
            return element('label', {}, this.logarithmic, 'Errors on a logarithmic scale');
        }

        slider(key) {
            const { label, unit, from, to, by, least, most, logarithmic } = SLIDERS[key];
            const value = at => Number(logarithmic ? (10 ** at).toPrecision(3) : at.toFixed(2));
            const range = element('input', {
                type: 'range',
                class: key,
                min: from,
                max: to,
                step: by,
                oninput: () => {
                    this.lab.change({ [key]: value(Number(range.value)) });
                },
            });
            const typed = element('input', {
                type: 'number',
                class: key,
                min: least,
                max: most,
                step: 'any',
                'aria-label': `${label} (${unit}), as a number`,
                onchange: () => {
                    const given = typed.valueAsNumber;
                    if (given >= least && given <= most) {
                        this.lab.change({ [key]: given });
                    } else {
                        this.sliders[key](this.lab.scene[key]);
                        this.say(`${label} must be from ${least} to ${most} ${unit}.`);
                    }
                },
            });
            this.sliders[key] = now => {
                range.value = logarithmic ? Math.log10(now) : now;
                range.setAttribute('aria-valuetext', `${now} ${unit}`);
                typed.value = now;
            };
            const name = element('span', {}, `${label} (${unit})`);
            return element('div', { class: 'slider' }, element('label', {}, name, range), typed);
        }

        choice() {
            const box = method => {
                const input = element('input', {
                    type: 'checkbox',
                    value: method.name,
                    onchange: () => this.choose(),
                });
                const { marker, colour } = look(method);
                const sign = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
                sign.setAttribute('viewBox', '-8 -8 16 16');
                sign.setAttribute('aria-hidden', 'true');
                sign.innerHTML = `<path d="M0,0${marker}" style="fill: var(${colour})"/>`;
                return element('label', {}, input, sign, method.title);
            };
            const papers = this.lab.known.filter(method => PAPERS.includes(method.name)).map(box);
            const others = this.lab.known.filter(method => !PAPERS.includes(method.name)).map(box);
            this.boxes = [...papers, ...others].map(label => label.querySelector('input'));
            this.others = element(
                'details',
                {},
                element('summary', {}, 'More methods'),
                element('div', {}, ...others),
            );
            return element(
                'fieldset',
                { class: 'methods' },
                element('legend', {}, `Methods, up to ${this.lab.places}`),
                element('div', {}, ...papers),
                this.others,
            );
        }

        choose() {
            const chosen = this.boxes.filter(box => box.checked).map(box => box.value);
            // Methods that were chosen already keep their places.
            const kept = this.lab.scene.methods.filter(name => chosen.includes(name));
            const methods = [...kept, ...chosen.filter(name => !kept.includes(name))];
            if (methods.length) this.lab.change({ methods });
            else this.lab.adjust({});
        }

        // ------------------------------------------------------------------------------- what is
        // shown

        // Updates what depends on the scene alone.
        settle() {
            const { scene, places } = this.lab,
                damped = scene.beta > 0;
            for (const [key, show] of Object.entries(this.sliders)) show(scene[key]);
            this.pace.value = scene.speed;
            this.logarithmic.checked = scene.scale === 'log';
            this.orbit.textContent =
                (damped ? '' : 'solid: exact orbit; ') + 'dotted: separatrix; ring: start';
            this.caption();
            if (!this.lab.whole) return;
            this.end.value = scene.until || '';
            const here = address(scene);
            for (const link of this.links) {
                if (address(presetScene(link.hash.slice(1))) === here)
                    link.setAttribute('aria-current', 'true');
                else link.removeAttribute('aria-current');
            }
            for (const box of this.boxes) {
                box.checked = scene.methods.includes(box.value);
                box.disabled = !box.checked && scene.methods.length >= places;
            }
            // The list must be open if it contains a chosen method.
            if (scene.methods.some(name => !PAPERS.includes(name))) this.others.open = true;
        }

        // The columns after the methods: heading of the group, own heading, value.
        columns() {
            if (!this.lab.whole) {
                return [
                    ['', 'Largest energy error (J)', p => measured(p.read(LARGEST))],
                    ['', 'Largest angle error (rad)', p => measured(p.angle.largest)],
                ];
            }
            const errors = [
                ['Energy error (J)', 'now', p => measured(p.read(ERROR))],
                ['Energy error (J)', 'largest', p => measured(p.read(LARGEST))],
                ['Angle error (rad)', 'now', p => measured(p.lapse)],
                ['Angle error (rad)', 'largest', p => measured(p.angle.largest)],
            ];
            const energy = ['', 'Energy (J)', p => measured(p.read(INITIAL) + p.read(ERROR))];
            return [
                ...(this.lab.scene.beta > 0 ? [energy] : errors),
                ['', 'Force evaluations', p => count(p.read(EVALUATIONS))],
                // The minimum, as disturbances only make a time longer.
                ['', 'Time a step (ns)', p => (p.times.length ? rough(Math.min(...p.times)) : '–')],
            ];
        }

        // The head of the table, and a row for each pendulum.
        caption() {
            const columns = this.columns(),
                groups = columns.map(([group]) => group);
            const grouped = groups.some(Boolean),
                tall = grouped && { rowspan: 2 };
            const first = element('tr', {}, element('th', { scope: 'col', ...tall }, 'Method'));
            const second = element('tr');
            columns.forEach(([group, title], i) => {
                const width = groups.filter(other => other === group).length;
                if (!group) first.append(element('th', { scope: 'col', ...tall }, title));
                else if (groups.indexOf(group) === i)
                    first.append(element('th', { scope: 'colgroup', colspan: width }, group));
                if (group) second.append(element('th', { scope: 'col' }, title));
            });
            this.head.replaceChildren(first, ...(grouped ? [second] : []));
            this.rows.replaceChildren(
                ...this.lab.pendulums.map(() =>
                    element(
                        'tr',
                        {},
                        element('th', { scope: 'row' }),
                        ...columns.map(() => element('td')),
                    ),
                ),
            );
        }

        // Updates the numbers.
        show() {
            const { lab } = this,
                { scene, pendulums, running } = lab;
            if (running) {
                // One method at a time, so that no frame is late, and each a few times: the browser
                // optimises code only after it has run for a while.
                const next = [...pendulums].sort((a, b) => a.times.length - b.times.length)[0];
                if (next.times.length < 5)
                    next.times.push(timed(lab.stopwatch, next.method, scene));
            }
            const steps = `${count(lab.taken)} ${lab.taken === 1 ? 'step' : 'steps'}`;
            this.run.textContent = running ? 'Pause' : 'Run';
            this.time.textContent = `t = ${seconds(lab.time, scene.dt)} s, ${steps}`;
            const columns = this.columns();
            pendulums.forEach((pendulum, i) => {
                const [head, ...cells] = this.rows.rows[i].cells;
                head.textContent = pendulum.method.title + (pendulum.lost ? ': step too long' : '');
                columns.forEach(([, , value], k) => {
                    cells[k].textContent = value(pendulum);
                });
            });
            if (this.every && (this.every.parentElement.open || !running)) this.spell();
            lab.drawing.describe();
        }

        digits() {
            this.every = element('div');
            return element(
                'details',
                { class: 'digits' },
                element('summary', {}, 'Every digit, and the same on the command line'),
                this.every,
            );
        }

        // Shows every digit, with the command that prints the same numbers.
        spell() {
            const { scene, pendulums } = this.lab;
            this.every.replaceChildren(
                ...pendulums.flatMap(pendulum => {
                    // It has no numbers.
                    if (pendulum.lost)
                        return element(
                            'p',
                            { class: 'numbers' },
                            `${pendulum.method.title}: step too long`,
                        );
                    const value = (name, quantity) => [
                        `${name} = `,
                        element(
                            'data',
                            {
                                value: pendulum.read(quantity),
                                'data-of': `${pendulum.method.name} ${name}`,
                            },
                            pendulum.read(quantity),
                        ),
                        '  ',
                    ];
                    const steps = pendulum.read(STEPS);
                    const command =
                        `pendula simulate --method ${pendulum.method.name} ` +
                        `--theta0 ${scene.theta0} ` +
                        `--omega0 ${scene.omega0} --gravity ${scene.g} --length ${scene.L} ` +
                        `--dt ${scene.dt} ` +
                        `--steps ${steps} --every ${Math.max(steps, 1)}`;
                    const numbers = element(
                        'p',
                        { class: 'numbers' },
                        `${pendulum.method.title}: `,
                        ...value('t', TIME),
                        ...value('theta', THETA),
                        ...value('omega', OMEGA),
                        ...value('energy', ENERGY),
                    );
                    return scene.beta > 0
                        ? [numbers]
                        : [numbers, element('pre', {}, element('code', {}, command))];
                }),
            );
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
                (scene.beta > 0 ? '' : ` Largest energy error: ${errors}.`)
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
