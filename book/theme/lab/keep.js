// What a reader takes along: a link, the numbers of the run, its picture.
(theLab => {
    'use strict';

    const { FONT, PRINTED, QUANTITY, SLIDERS, SYSTEMS } = theLab;
    const { button, element, isClosed, keysOf, place, printed, seconds } = theLab;
    const { TIME } = QUANTITY;

    // The most rows of each method, and for how long (ms) they are computed before the page has its
    // turn.
    const ROWS = 10_000;
    const SLICE = 20;
    // Between the parts of the picture, and the height of a line (px).
    const GAP = 12;
    const LINE = 20;

    class Keep {
        constructor(lab) {
            this.lab = lab;
            // Where the browser does not let a page copy.
            this.link = element('input', {
                class: 'link',
                readonly: true,
                hidden: true,
                'aria-label': 'The link, to be copied',
            });
            this.live = element(
                'div',
                { class: 'buttons keep' },
                button('copy', 'Copy link', () => this.copy()),
                button('csv', 'Numbers (CSV)', () => this.numbers()),
                button('png', 'Picture (PNG)', () => this.picture()),
                this.link,
            );
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
                this.link.hidden = true;
                this.say('The link is copied: it leads to this scene.');
            } catch {
                this.link.hidden = false;
                this.link.value = location.href;
                this.link.select();
                this.say('The link is selected: copy it.');
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
            const columns = PRINTED[scene.system],
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
                    lines.push([method.name, ...row.map(printed)].join(','));
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
            ink.font = FONT;
            words.forEach((line, i) => {
                ink.fillText(line, GAP, GAP + end + (i + 1) * LINE, width);
            });
            const blob = await new Promise(done => canvas.toBlob(done, 'image/png'));
            this.save(blob, `${name}.png`);
        }

        // The scene in words.
        words(scene, when) {
            const values = keysOf(scene.system).map(key => {
                const { label, unit } = SLIDERS[key];
                return `${label.split(' ').at(-1)} = ${scene[key]} ${unit}`;
            });
            return [`${SYSTEMS[scene.system].title}, ${when}`, values.join(', ')];
        }
    }

    theLab.Keep = Keep;
})((globalThis.theLab ??= {}));
