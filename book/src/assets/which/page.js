// The form of "Which integrator is this?", and what it answers. Its input stands in the address, as
// in #in=double&swinging-1=1.05,0.39. Without scripts, in print.html and where a browser has no
// whole numbers of any length, what stands in its place is shown.
(which => {
    'use strict';

    const spot = document.querySelector('.which');
    if (!spot || !which || /\/print\.html$/.test(location.pathname)) return;

    const { FIRST, Known, PRECISIONS, beside, decimal, pairOf, two } = which,
        { count, element, tick } = globalThis.theLab,
        FILE = new URL('../known-answers.js', document.currentScript.src),
        NAMES = ['θ', 'ω'],
        UNITS = ['rad', 'rad/s'],
        // The chapters of methods that have one.
        CHAPTERS = ['forward-euler', 'symplectic-euler', 'stormer-verlet', 'rk4'],
        EXAMPLES = [
            ['a right RK4', 'rk4'],
            ['a leapfrog with the old force twice', 'stormer-verlet-old-force-twice'],
        ],
        // More are listed by name alone, and more still are folded.
        IN_FULL = 3,
        OPEN = 16;

    const minus = text => String(text).replace(/-(?=[\d.])/g, '−');
    const about = x => (x < 9.95 && x >= 0.05 ? x.toFixed(1) : tick(Number(x.toPrecision(2))));
    const line = (...words) => element('p', {}, ...words);
    const link = (href, ...words) => element('a', { href }, ...words);
    const list = items => element('ul', {}, ...items.map(item => element('li', {}, ...item)));
    const texts = pair => pair.map(({ text }) => text);
    const isMistake = entry => Boolean(entry.of);
    const titled = name => (CHAPTERS.includes(name) ? link(`${name}.html`, name) : name);

    // The address of this input.
    const address = (precision, pairs) =>
        `#in=${precision}${pairs.map(([key, pair]) => `&${key}=${pair.join(',')}`).join('')}`;

    // What an answer is the answer to: "2 steps of h = 0.125 from …".
    function task(scenes, key) {
        const [, scene, steps] = /^(.*)-(\d+)$/.exec(key),
            { g_over_l: g, amplitude, frequency, t, theta, omega, h } = scenes[scene],
            driven = Number(amplitude) > 0,
            drive = driven ? ` + ${amplitude} cos ${frequency}t, from t = ${t}` : '';
        return minus(
            `${steps} step${steps > 1 ? 's' : ''} of h = ${h} from θ = ${theta}, ω = ${omega}; ` +
                `θ̈ = −${g === '1' ? '' : `${g} `}sin θ${drive}`,
        );
    }

    class Page {
        constructor(known) {
            this.known = known;
            this.rounds = [];
            this.form = element('form', { 'aria-label': 'Which integrator is this?' });
            this.form.innerHTML = `
                <fieldset class="precision"><legend>Computed in</legend>
                <label><input type="radio" name="in" value="double" checked> double</label>
                <label><input type="radio" name="in" value="single"> single precision</label>
                </fieldset><p><button>Which is it?</button></p><p class="examples">Try </p>
                <output aria-live="polite"></output><div class="result"></div>`;
            [this.said] = this.form.getElementsByTagName('output');
            this.result = this.form.querySelector('.result');
            const ways = EXAMPLES.map(([words, name]) => {
                const { texts } = known.named(name).answers.get(FIRST);
                return link(address('double', [[FIRST, texts.map(Number)]]), words);
            });
            this.form.querySelector('.examples').append(ways[0], ' or ', ways[1], '.');
            this.round(FIRST);
            this.form.addEventListener('change', () => this.changed());
            this.form.addEventListener('submit', event => {
                event.preventDefault();
                this.answer();
            });
            addEventListener('hashchange', () => this.follow());
        }

        get precision() {
            return this.form.elements.in.value;
        }

        // Fields for a pair of numbers, before those of the precision.
        round(key) {
            const field = (name, i) => {
                const input = element('input', { autocomplete: 'off', spellcheck: 'false' });
                return element('label', {}, element('span', {}, `${name} (${UNITS[i]})`), input);
            };
            const legend = element('legend', {}, task(this.known.scenes, key)),
                box = element('fieldset', { class: 'pair' }, legend, ...NAMES.map(field)),
                inputs = [...box.querySelectorAll('input')];
            this.form.querySelector('.precision').before(box);
            this.rounds.push({ key, box, inputs });
            return inputs;
        }

        // Leaves these many pairs.
        cut(length) {
            for (const { box } of this.rounds.splice(length)) box.remove();
        }

        // From the address to the fields.
        follow() {
            const asked = new URLSearchParams(location.hash.slice(1));
            if (!asked.has(FIRST)) return;
            this.form.elements.in.value = asked.get('in') === 'single' ? 'single' : 'double';
            this.cut(0);
            for (const [key, pair] of asked) {
                if (!this.known.keys.includes(key)) continue;
                const typed = pair.split(',');
                this.round(key).forEach((input, i) => (input.value = typed[i] ?? ''));
            }
            this.answer();
        }

        // Answers once every pair that was begun is whole.
        changed() {
            this.spread();
            const begun = this.rounds.filter(({ inputs }, i) => !i || inputs.some(x => x.value));
            if (begun.every(({ inputs }) => inputs.every(x => x.value))) this.answer();
        }

        // Two numbers in one field, as a program prints them.
        spread() {
            for (const { inputs } of this.rounds) {
                const pair = inputs[1].value ? null : two(inputs[0].value);
                pair?.forEach((value, i) => (inputs[i].value = value));
            }
        }

        // Reads the fields, puts them into the address, and says what they are.
        answer() {
            this.spread();
            const pairs = [],
                wrong = [];
            for (const { key, inputs } of this.rounds) {
                if (pairs.length && inputs.every(input => !input.value.trim())) break;
                const read = inputs.map(input => decimal(input.value));
                inputs.forEach((input, i) => {
                    const isBad = typeof read[i] === 'string';
                    input.setAttribute('aria-invalid', isBad);
                    if (isBad) wrong.push(`${NAMES[i]} ${read[i]}.`);
                });
                if (!wrong.length) pairs.push([key, pairOf(...read)]);
            }
            if (wrong.length) {
                this.say(`${wrong.join(' ')} Two numbers like 1.0552 and −0.39e-3 are needed.`);
                return;
            }
            const typed = pairs.map(([key, pair]) => [key, texts(pair)]);
            history.replaceState(null, '', address(this.precision, typed));
            const focused = document.activeElement;
            this.cut(pairs.length);
            this.judge(pairs, typed);
            if (!focused.isConnected) this.rounds.at(-1).inputs[0].focus();
        }

        say(words, ...result) {
            this.said.value = words;
            this.result.replaceChildren(...result);
            spot.classList.add('answered');
        }

        judge(pairs, typed) {
            const { bits, digits } = PRECISIONS[this.precision],
                left = this.known.left(pairs, bits),
                { found, at } = left;
            if (at !== undefined) {
                this.none(found, pairs[at], at, bits);
                return;
            }
            const most = Math.max(...pairs.flatMap(([, pair]) => pair.map(x => x.digits))),
                few = most < digits - 2 && !found.some(({ agrees }) => agrees),
                tell = few ? `As far as ${most} digits tell, ` : '',
                [{ entry }] = found;
            const one = isMistake(entry) ? `${entry.of} with a mistake` : entry.name,
                it = found.length > 1 ? `${count(found.length)} entries fit` : `it is ${one}`,
                words = `${tell}${it}.${few ? ` Print all ${digits} digits of the numbers.` : ''}`;
            const parts = found.length > IN_FULL ? this.names(found) : found.map(this.card(pairs));
            const isFloat = ({ text }) => Math.fround(Number(text)) === Number(text);
            if (this.precision === 'single' && most > 11 && !pairs[0][1].every(isFloat))
                parts.unshift(
                    line(
                        'These numbers have more digits than single precision. ',
                        link(address('double', typed), 'Compare them in double precision'),
                        '.',
                    ),
                );
            this.say(words.replace(/^i/, 'I'), ...parts);
            if (!few) this.further(left, pairs, bits);
        }

        // What to compute next, if it tells more.
        further(left, pairs, bits) {
            const { found, hidden } = left,
                next = this.known.question(
                    left,
                    pairs.map(([key]) => key),
                    bits,
                );
            if (!next && found.length > 1)
                this.result.append(line('Nothing in the file tells these apart.'));
            if (!next) return;
            if (found.length === 1)
                this.result.append(
                    line(`What these numbers do not show of ${found[0].entry.name}, if it is so:`),
                    list(hidden.map(({ what }) => [what])),
                );
            this.round(next);
            this.result.append(
                line(found.length > 1 ? 'To tell more of them apart:' : 'To see that, too:'),
                this.rounds.at(-1).box,
                line(element('button', {}, 'And now?')),
            );
        }

        // Nothing fits: what is near, and what the numbers may be instead.
        none(found, [key, pair], at, bits) {
            const { known, precision } = this,
                [nearest] = known.ranked(key, pair, bits),
                { entry, epsilons, allowed } = nearest,
                start = known.scenes[key.replace(/-\d+$/, '')],
                isStart = pair.every(
                    (x, i) => x.value === decimal(start[['theta', 'omega'][i]]).value,
                ),
                isFar = Math.max(...nearest.off) > 0.03,
                hints = known.instead(key, pair, bits).map(hint => this.hint(hint, key, pair));
            if (isStart) hints.unshift(['They are the numbers at the start: no step was taken.']);
            if (isFar && !at && !hints.length) hints.push(...this.guess(pair));
            if (epsilons < 1e3 * allowed)
                hints.push([
                    'Too far for rounding, but near: is a coefficient or a sine cut short?',
                ]);
            const silent = found.filter(one => !one.entry.answers.has(key));
            const before = silent.length ? silent : found;
            if (at)
                hints.unshift([
                    silent.length
                        ? 'The file has no answer to the last two numbers for '
                        : 'Without the last two numbers it was ',
                    ...before.map((one, i) => [i ? ', ' : '', one.entry.name].join('')),
                    '.',
                ]);
            this.say(
                `No entry fits${at ? ' all of them' : ''}. The nearest${at ? ' to the last' : ''} is ` +
                    `${entry.name}, ${about(epsilons)} ε away; ${about(allowed)} ε are allowed.`,
                ...(hints.length ? [list(hints)] : []),
                ...(isFar ? [] : [this.card([[key, pair]], true)(nearest)]),
            );
        }

        hint([what, fits, other], key, pair) {
            const names = fits
                    .slice(0, 3)
                    .map(({ entry }) => entry.name)
                    .join(', '),
                more = fits.length > 3 ? ` and ${count(fits.length - 3)} more` : '',
                those = `they are those of ${names}${more}`;
            const { precision } = this;
            return {
                single: [
                    `In single precision ${those}. `,
                    link(address('single', [[key, texts(pair)]]), 'Compare them so'),
                ],
                scene: [
                    `They may be those of ${names}${more} for ${other && task(this.known.scenes, other)}.`,
                ],
                swapped: [
                    `With θ and ω exchanged ${those}. `,
                    link(address(precision, [[key, texts(pair).reverse()]]), 'Exchange them'),
                ],
                degrees: [`In degrees ${those}. A radian has 57.29578 of them.`],
            }[what];
        }

        // Of numbers that are far from all.
        guess(pair) {
            const [h, g] = this.known.guessed(pair);
            if (Math.abs(Number(pair[0].text)) > 7) return [['Are these degrees?']];
            const isLikely = h > 1e-4 && h < 3 && g > 0.1 && g < 1e3;
            return isLikely
                ? [[`A step of ${about(h)} with g/L = ${about(g)} would give about this.`]]
                : [];
        }

        // Names alone.
        names(found) {
            const kinds = [false, true].map(are =>
                found.filter(({ entry }) => isMistake(entry) === are),
            );
            const lines = kinds.map((some, i) =>
                line(
                    `${i ? 'Mistakes' : 'Methods'}: ${some.map(x => x.entry.name).join(', ') || 'none'}.`,
                ),
            );
            const all = element('details', {}, element('summary', {}, 'Their names'), ...lines);
            all.open = found.length <= OPEN;
            return [all];
        }

        // An entry in full: what it is, and the numbers side by side.
        card(pairs, isNearest = false) {
            return ({ entry, epsilons, allowed }) => {
                const { bits } = PRECISIONS[this.precision],
                    [key, pair] = pairs.findLast(([key]) => entry.answers.has(key));
                const rows = isMistake(entry)
                    ? [
                          ['what', entry.what],
                          ['effect', entry.effect],
                          ['a mistake in', titled(entry.of)],
                          [
                              'seen in',
                              /zoo$/.test(entry.seen) ? link('zoo.html', entry.seen) : entry.seen,
                          ],
                      ]
                    : [
                          ['also', entry.also?.join('; ')],
                          ['order', entry.order],
                          ['keeps', entry.keeps?.join(', ') ?? 'nothing'],
                          ['source', entry.source],
                      ];
                rows.push(['how', entry.note]);
                if (!isNearest)
                    rows.push(['off by', `${about(epsilons)} ε of ${about(allowed)} ε allowed`]);
                const right = isMistake(entry) && !isNearest ? this.known.named(entry.of) : entry;
                const isCompared = (isNearest || isMistake(entry)) && right.answers.has(key);
                const table = () => this.table(right.answers.get(key), pair, bits, isNearest);
                return element(
                    'section',
                    { 'aria-label': entry.name },
                    line(element('strong', {}, titled(entry.name))),
                    element(
                        'dl',
                        {},
                        ...rows
                            .filter(([, value]) => value)
                            .flatMap(([name, value]) => [
                                element('dt', {}, name),
                                element('dd', {}, value),
                            ]),
                    ),
                    ...(isCompared ? [table()] : []),
                );
            };
        }

        // The numbers beside those of the file; what differs is marked.
        table(answer, pair, bits, isNearest) {
            const { off } = beside(answer, pair, bits),
                yours = texts(pair),
                theirs = answer.texts.map((text, i) => text.slice(0, Math.max(yours[i].length, 8)));
            const marked = yours.map((text, i) => {
                let same = 0;
                while (same < text.length && text[same] === theirs[i][same]) same++;
                return [minus(text.slice(0, same)), element('mark', {}, minus(text.slice(same)))];
            });
            const rows = [
                ['yours', ...marked],
                [isNearest ? 'nearest' : 'right', ...theirs.map(text => [minus(text)])],
                ['apart', ...off.map((x, i) => [`${about(x)} ${UNITS[i]}`])],
            ].map(([name, ...cells]) =>
                element(
                    'tr',
                    {},
                    element('th', { scope: 'row' }, name),
                    ...cells.map(cell => element('td', {}, ...cell)),
                ),
            );
            const heads = ['', ...NAMES].map(name => element('th', { scope: 'col' }, name));
            const table = element('table', {}, element('tr', {}, ...heads), ...rows);
            return element('div', { class: 'table-wrapper' }, table);
        }
    }

    // The answers come by a script: a page that is opened from a disk cannot fetch a file.
    const script = element('script', { src: FILE });
    script.addEventListener('load', () => {
        const page = new Page(new Known(globalThis.knownAnswers));
        spot.prepend(page.form);
        spot.classList.add('on');
        page.follow();
    });
    script.addEventListener('error', () => console.error('which: known-answers.js is missing'));
    document.head.append(script);
})(globalThis.which);
