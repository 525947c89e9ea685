// The numbers of a lab: the table, and every digit.
(theLab => {
    'use strict';

    const { QUANTITY, conserves, count, element, isClosed, measured, rough, timed } = theLab;
    const { THETA, OMEGA, TIME, STEPS, EVALUATIONS, ENERGY, ERROR, LARGEST, INITIAL } = QUANTITY;
    const { LOWER_THETA, LOWER_OMEGA } = QUANTITY;

    // What the command line prints of each system, and what is read for it.
    const ONE = [
        ['t', TIME],
        ['theta', THETA],
        ['omega', OMEGA],
        ['energy', ENERGY],
    ];
    const PRINTED = {
        pendulum: ONE,
        driven: ONE,
        shaken: ONE,
        double: [
            ['t', TIME],
            ['theta1', THETA],
            ['theta2', LOWER_THETA],
            ['omega1', OMEGA],
            ['omega2', LOWER_OMEGA],
            ['energy', ENERGY],
        ],
    };

    class Numbers {
        constructor(lab) {
            this.lab = lab;
            this.head = element('thead');
            this.rows = element('tbody');
            this.table = element(
                'div',
                { class: 'table-wrapper' },
                element('table', {}, this.head, this.rows),
            );
        }

        // The columns after the methods: heading of the group, own heading, value.
        columns() {
            const { lab } = this;
            // Between two looks at it an error may have been larger.
            const least = x => (lab.sampled && x > 0 ? `≥\u00a0${measured(x)}` : measured(x));
            if (!lab.whole) {
                return [
                    ['', 'Largest energy error (J)', p => measured(p.read(LARGEST))],
                    ['', 'Largest angle error (rad)', p => least(p.angle.largest)],
                ];
            }
            const energy = conserves(lab.scene)
                ? [
                      ['Energy error (J)', 'now', p => measured(p.read(ERROR))],
                      ['Energy error (J)', 'largest', p => measured(p.read(LARGEST))],
                  ]
                : [['', 'Energy (J)', p => measured(p.read(INITIAL) + p.read(ERROR))]];
            const angle = isClosed(lab.scene)
                ? [
                      ['Angle error (rad)', 'now', p => measured(p.lapse)],
                      ['Angle error (rad)', 'largest', p => least(p.angle.largest)],
                  ]
                : [];
            return [
                ...energy,
                ...angle,
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
                        ...columns.map(([group, title]) =>
                            element('td', { 'data-label': group ? `${group}, ${title}` : title }),
                        ),
                    ),
                ),
            );
        }

        // Updates the table, and the digits if they are seen.
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
            const columns = this.columns();
            pendulums.forEach((pendulum, i) => {
                const [head, ...cells] = this.rows.rows[i].cells;
                head.textContent = pendulum.method.title + (pendulum.lost ? ': step too long' : '');
                columns.forEach(([, , value], k) => {
                    cells[k].textContent = value(pendulum);
                });
            });
            if (this.every && (this.every.parentElement.open || !running)) this.spell();
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
                    const value = ([name, quantity]) => [
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
                    const numbers = element(
                        'p',
                        { class: 'numbers' },
                        `${pendulum.method.title}: `,
                        ...PRINTED[scene.system].flatMap(value),
                    );
                    const command = this.command(pendulum);
                    return command
                        ? [numbers, element('pre', {}, element('code', {}, command))]
                        : [numbers];
                }),
            );
        }

        // What prints the same numbers; empty if nothing does.
        command(pendulum) {
            const { scene } = this.lab,
                steps = pendulum.read(STEPS);
            const run = `--dt ${scene.dt} --steps ${steps} --every ${Math.max(steps, 1)}`;
            if (scene.system === 'double' && pendulum.method.name === 'rk4')
                return (
                    `pendula simulate --system double-pendulum --theta1 ${scene.theta0} ` +
                    `--theta2 ${scene.theta2} --omega1 ${scene.omega0} ` +
                    `--omega2 ${scene.omega2} --gravity ${scene.g} --length1 ${scene.L} ` +
                    `--length2 ${scene.L} ${run}`
                );
            if (!isClosed(scene)) return '';
            return (
                `pendula simulate --method ${pendulum.method.name} --theta0 ${scene.theta0} ` +
                `--omega0 ${scene.omega0} --gravity ${scene.g} --length ${scene.L} ${run}`
            );
        }
    }

    Object.assign(theLab, { Numbers, PRINTED });
})((globalThis.theLab ??= {}));
