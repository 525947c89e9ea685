// The numbers of a lab, the table and every digit; and what a reader takes along: a link, the
// numbers of the run, its picture.
'use strict';

// What the command line prints of each system, and what is read for it.
const ONE = [
    ['t', TIME],
    ['theta', THETA],
    ['omega', OMEGA],
    ['energy', ENERGY],
];
const TWO = [
    ['t', TIME],
    ['theta1', THETA],
    ['theta2', LOWER_THETA],
    ['omega1', OMEGA],
    ['omega2', LOWER_OMEGA],
    ['energy', ENERGY],
];
const printed = ({ system }) => (system === 'double' ? TWO : ONE);

class Numbers {
    constructor(lab) {
        this.lab = lab;
        this.head = element('thead');
        this.rows = element('tbody');
        const both = [this.head, this.rows];
        this.table = markup`<div class="table-wrapper"><table>${both}</table></div>`;
    }

    // The columns after the methods: heading and value.
    columns() {
        const { lab } = this;
        // Between two looks at it an error may have been larger.
        const least = x => (lab.sampled && x > 0 ? `≥\u00a0${measured(x)}` : measured(x));
        const energy = ['Largest energy error (J)', p => measured(p.read(LARGEST))];
        const angle = ['Largest angle error (rad)', p => least(p.angle.largest)];
        if (!lab.whole) return [energy, angle];
        return [
            ...(conserves(lab.scene)
                ? [['Energy error (J)', p => measured(p.read(ERROR))], energy]
                : [['Energy (J)', p => measured(p.read(INITIAL) + p.read(ERROR))]]),
            ...(isClosed(lab.scene) ? [['Angle error (rad)', p => measured(p.lapse)], angle] : []),
            ['Force evaluations', p => count(p.read(EVALUATIONS))],
            // The minimum, as disturbances only make a time longer.
            ['Time per step (ns)', p => (p.times.length ? rough(Math.min(...p.times)) : '–')],
        ];
    }

    // The head of the table, and a row for each pendulum.
    caption() {
        const titles = this.columns().map(([title]) => title);
        const head = title => markup`<th scope="col">${title}</th>`;
        this.head.replaceChildren(markup`<tr>${['Method', ...titles].map(head)}</tr>`);
        const cell = title => element('td', { 'data-label': title });
        const row = () => markup`<tr><th scope="row"></th>${titles.map(cell)}</tr>`;
        this.rows.replaceChildren(...this.lab.pendulums.map(row));
    }

    // Updates the table, and the digits if they are seen.
    show() {
        const { lab } = this,
            { scene, pendulums, running } = lab;
        if (running) {
            // One method at a time, so that no frame is late, and each a few times: the browser
            // optimises code only after it has run for a while.
            const next = [...pendulums].sort((a, b) => a.times.length - b.times.length)[0];
            if (next.times.length < 5) next.times.push(timed(lab.stopwatch, next.method, scene));
        }
        const columns = this.columns();
        pendulums.forEach((pendulum, i) => {
            const [head, ...cells] = this.rows.rows[i].cells;
            head.textContent = pendulum.method.title + (pendulum.lost ? ': step too long' : '');
            columns.forEach(([, value], k) => {
                cells[k].textContent = value(pendulum);
            });
        });
        if (this.every && (this.every.parentElement.open || !running)) this.spell();
    }

    digits() {
        this.every = element('div');
        return everyDigit(this.every);
    }

    // Shows every digit, with the command that prints the same numbers.
    spell() {
        const { scene, pendulums } = this.lab;
        const each = pendulum => {
            const { name, title } = pendulum.method;
            // It has no numbers.
            if (pendulum.lost) return spelt(`${title}: step too long`, []);
            const values = printed(scene).map(([column, quantity]) => [
                column,
                pendulum.read(quantity),
                `${name} ${column}`,
            ]);
            return spelt(`${title}: `, values, this.command(pendulum));
        };
        this.every.replaceChildren(...pendulums.flatMap(each));
    }

    // What prints the same numbers; empty if nothing does.
    command(pendulum) {
        const { scene } = this.lab,
            steps = pendulum.read(STEPS);
        if (scene.system === 'double' && pendulum.method.name === 'rk4')
            return (
                `pendula simulate --system double-pendulum --theta1 ${scene.theta0} ` +
                `--theta2 ${scene.theta2} --omega1 ${scene.omega0} ` +
                `--omega2 ${scene.omega2} --gravity ${scene.g} --length1 ${scene.L} ` +
                `--length2 ${scene.L} --dt ${scene.dt} --steps ${steps} ` +
                `--every ${Math.max(steps, 1)}`
            );
        return isClosed(scene) ? simulate(pendulum.method.name, scene, steps) : '';
    }
}

// The most rows of each method.
const ROWS = 10_000;
// Between the parts of the picture, and the height of a line (px).
const GAP = 12;
const LINE = 20;

class Keep {
    constructor(lab) {
        this.lab = lab;
        this.live = markup`<div class="buttons keep">
            ${button('copy', 'Copy link', () => this.copy())}
            ${button('csv', 'Numbers (CSV)', () => this.numbers())}
            ${button('png', 'Picture (PNG)', () => this.picture())}
        </div>`;
    }

    // What the files are called.
    name() {
        const { scene, taken } = this.lab;
        return `pendula-${scene.lesson}-${scene.step}-${taken}-steps`;
    }

    say(words) {
        this.lab.page.say('');
        this.lab.page.say(words);
    }

    async copy() {
        this.lab.write();
        try {
            await navigator.clipboard.writeText(location.href);
            this.say('The link is copied: it leads to this scene.');
        } catch {
            this.say('The browser does not let a page copy: the link is its address.');
        }
    }

    // Gives a file to the browser to be saved.
    save(blob, name) {
        const url = URL.createObjectURL(blob);
        element('a', { href: url, download: name }).click();
        setTimeout(() => URL.revokeObjectURL(url), 10_000);
        this.say(`Saved as ${name}.`);
    }

    // The run once more, from its start to where it is, every so many steps.
    async numbers() {
        const { lab } = this,
            { scene, taken } = lab,
            name = this.name();
        if (this.making) return;
        this.making = true;
        const every = Math.max(1, Math.ceil(taken / ROWS));
        const columns = printed(scene),
            exact = isClosed(scene);
        const lines = [
            [
                'method',
                ...columns.map(([column]) => column),
                ...(exact ? ['exact_theta', 'exact_omega'] : []),
            ].join(','),
        ];
        let began = performance.now();
        for (const { method } of lab.pendulums) {
            if (!place(lab.spare, 0, method, scene)) continue;
            for (let steps = 0; steps <= taken; steps += every) {
                const row = columns.map(([, quantity]) => lab.spare.read(0, quantity));
                // A step that was not solved.
                if (!row.every(Number.isFinite)) break;
                const t = lab.spare.read(0, TIME);
                if (exact) row.push(lab.spare.exact_theta(0, t), lab.spare.exact_omega(0, t));
                // A text of −0 has no sign.
                const signed = row.map(x => (Object.is(x, -0) ? '-0.0' : x));
                lines.push([method.name, ...signed].join(','));
                if (lab.spare.advance(0, every) < every) break;
                if (performance.now() - began > SLICE) {
                    await new Promise(done => setTimeout(done));
                    began = performance.now();
                }
            }
        }
        this.making = false;
        this.save(new Blob([`${lines.join('\n')}\n`], { type: 'text/csv' }), `${name}.csv`);
    }

    // The drawings as they are, with the scene below.
    async picture() {
        const { lab } = this,
            { drawing, scene, time, taken } = lab,
            name = this.name();
        const angle = isClosed(scene) ? [drawing.angle] : [];
        const plots = [drawing.phase, drawing.energy, ...angle];
        // The plots as they stand on the page.
        const boxes = plots.map(plot => plot.canvas.getBoundingClientRect());
        const [left, top] = ['x', 'y'].map(side => Math.min(...boxes.map(box => box[side])));
        const width = Math.max(drawing.stage.width, ...boxes.map(box => box.right - left));
        const words = this.words(scene, `t = ${seconds(time, scene.dt)} s, ${taken} steps`);
        const below = drawing.stage.height + GAP;
        const end = below + Math.max(...boxes.map(box => box.bottom - top));
        const height = end + GAP + words.length * LINE;
        const canvas = element('canvas', {
            width: Math.round(2 * (width + 2 * GAP)),
            height: Math.round(2 * (height + 2 * GAP)),
        });
        const ink = canvas.getContext('2d');
        ink.scale(2, 2);
        ink.fillStyle = drawing.paper;
        ink.fillRect(0, 0, width + 2 * GAP, height + 2 * GAP);
        const put = (sheet, x, y) =>
            ink.drawImage(sheet.canvas, GAP + x, GAP + y, sheet.width, sheet.height);
        put(drawing.stage, (width - drawing.stage.width) / 2, 0);
        boxes.forEach(({ x, y }, i) => put(plots[i], x - left, below + y - top));
        ink.fillStyle = drawing.ink;
        words.forEach((line, i) => {
            write(ink, line, GAP, GAP + end + (i + 1) * LINE, 'left', 'alphabetic', width);
        });
        const blob = await new Promise(done => canvas.toBlob(done, 'image/png'));
        this.save(blob, `${name}.png`);
    }

    // The scene in words.
    words(scene, when) {
        const values = keysOf(scene.system).map(key => worded(scene, key));
        return [`${SYSTEMS[scene.system].title}, ${when}`, values.join(', ')];
    }
}
