// The form of "Which integrator is this?", and what it answers. Its input stands in the address, as
// in #in=double&swinging-1=1.05,0.39. Without scripts, in print.html and where a browser has no
// whole numbers of any length, what stands in its place is shown.
(which => {
    'use strict';

    const spot = document.querySelector('.which');
    if (!spot || !which || /\/print\.html$/.test(location.pathname)) return;

    const { FIRST, Known, PRECISIONS, beside, decimal, pairOf, two } = which,
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
        OPEN = 16,
        // Numbers that are further away, as a part of their size, are near nothing.
        NEAR = 1e-5;

    const minus = text => String(text).replace(/-(?=[\d.])/g, '−');
    const about = x => (x < 9.95 && x >= 0.05 ? x.toFixed(1) : tick(Number(x.toPrecision(2))));
    const line = (...words) => markup`<p>${words}</p>`;
    const link = (href, ...words) => element('a', { href }, ...words);
    const list = items => markup`<ul>${items.map(item => markup`<li>${item}</li>`)}</ul>`;
    const texts = pair => pair.map(({ text }) => text);
    const listed = names =>
        names.length > 1 ? `${names.slice(0, -1).join(', ')} or ${names.at(-1)}` : names[0];
    const isMistake = entry => Boolean(entry.of);
    const span = words => markup`<span>${words}</span>`;
    const both = values => {
        const each = values.map((value, i) => span(`${NAMES[i]} ${minus(value)}`));
        return markup`<span class="both">${each}</span>`;
    };
    // What an entry is called: as the book calls it, and as the library and the file do.
    const called = ({ name, title }) => (title ? `${title} (${name})` : name);
    const titled = entry =>
        CHAPTERS.includes(entry.name) ? link(`${entry.name}.html`, called(entry)) : called(entry);

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
                `θ″ = −${g === '1' ? '' : `${g} `}sin θ${drive}`,
        ).replaceAll(' = ', '\u00a0=\u00a0');
    }

    class Page {
        constructor(known) {
            this.known = known;
            this.rounds = [];
            const [right, wrong] = EXAMPLES.map(([words, name]) => {
                const { texts } = known.named(name).answers.get(FIRST);
                return link(address('double', [[FIRST, texts.map(Number)]]), words);
            });
            this.said = element('output', { tabindex: -1, 'aria-live': 'polite' });
            this.result = element('div', { class: 'result' });
            this.form = markup`
                <form aria-label="Which integrator is this?">
                    <fieldset class="precision">
                        <legend>Precision</legend>
                        <label><input type="radio" name="in" value="double" checked> double</label>
                        &#32;
                        <label><input type="radio" name="in" value="single"> single</label>
                    </fieldset>
                    <p><button>Which is it?</button></p>
                    <p class="examples">
                        Try ${right} or ${wrong}. The address of the page holds what you enter.
                    </p>
                    ${[this.said, this.result]}
                </form>`;
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
                return markup`<label>${[span(`${name} (${UNITS[i]})`), input]}</label>`;
            };
            const box = markup`
                    <fieldset class="pair">
                        <legend>${task(this.known.scenes, key)}</legend>
                        ${NAMES.map(field)}
                    </fieldset>`,
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
            const focused = document.activeElement,
                isBlank = ({ inputs }) => inputs.every(input => !input.value.trim()),
                blank = this.rounds.findIndex((round, i) => i > 0 && isBlank(round));
            if (blank > 0) this.cut(blank);
            // What was asked below the result and is answered joins the other fields.
            for (const { box } of this.rounds)
                if (this.result.contains(box)) this.form.querySelector('.precision').before(box);
            const wrong = [];
            const pairs = this.rounds.map(({ key, inputs }) => {
                const read = inputs.map(input => decimal(input.value));
                inputs.forEach((input, i) => {
                    const isBad = typeof read[i] === 'string';
                    input.setAttribute('aria-invalid', isBad);
                    if (isBad) wrong.push(`${NAMES[i]} ${read[i]}.`);
                });
                return [key, read];
            });
            if (wrong.length) this.say(`${wrong.join(' ')} Enter numbers like 1.0558 or 3.9e-1.`);
            else {
                this.typed = pairs.map(([key, pair]) => [key, texts(pair)]);
                history.replaceState(null, '', address(this.precision, this.typed));
                this.judge(pairs.map(([key, pair]) => [key, pairOf(...pair)]));
            }
            if (focused !== document.activeElement)
                (focused.isConnected ? focused : this.said).focus();
        }

        // A link to the same numbers, but for one pair of them.
        same(precision, words, key, pair) {
            const typed = this.typed.map(([at, own]) => [at, at === key ? pair : own]);
            return link(address(precision, typed), words);
        }

        // The answer, what helps with it, and what is shown below.
        say(words, hints = [], ...result) {
            const helps = hints.map(span);
            this.said.replaceChildren(element('strong', {}, words), ...helps);
            this.result.replaceChildren(...result);
            spot.classList.add('answered');
        }

        judge(pairs) {
            const { bits, digits } = PRECISIONS[this.precision],
                left = this.known.left(pairs, bits),
                { found, at } = left;
            const [, [theta, omega]] = pairs[0];
            if (Number(theta.text) === 1 && Number(omega.text) === 0.5) {
                this.say('These are the numbers at the start: no step was taken.');
                return;
            }
            if (at !== undefined) {
                this.none(found, pairs[at], at, bits);
                return;
            }
            const numbers = pairs.flatMap(([, pair]) => pair),
                most = Math.max(...numbers.map(x => x.digits)),
                few = most < digits - 2 && !found.some(({ agrees }) => agrees),
                tell = `As far as ${most} digit${most > 1 ? 's' : ''} tell, `,
                it = this.inWords(found),
                words = few ? `${tell}${it}. Print all ${digits} digits of the numbers.` : `${it}.`;
            const hints = [];
            if (this.precision === 'single' && !numbers.every(x => x.isSingle))
                hints.push([
                    'Single precision has no number with these digits. ',
                    this.same('double', 'Compare them in double precision'),
                ]);
            const parts = found.length > IN_FULL ? this.names(found) : found.map(this.card(pairs));
            this.say(words[0].toUpperCase() + words.slice(1), hints, ...parts);
            if (!few) this.further(left, pairs, bits);
        }

        // What to compute next, if it tells more.
        further(left, pairs, bits) {
            const { found, hidden } = left,
                asked = pairs.map(([key]) => key),
                next = this.known.question(left, asked, bits),
                isOne = found.length === 1;
            if (!next && !isOne) this.result.append(line('Nothing in the file tells these apart.'));
            if (!next) return;
            this.round(next);
            this.result.append(
                ...(isOne
                    ? [
                          line('Mistakes that these numbers would not show:'),
                          list(hidden.map(({ what }) => [what])),
                      ]
                    : []),
                line(`To ${isOne ? 'see them' : 'tell them apart'}, enter these numbers as well.`),
                this.rounds.at(-1).box,
                line(element('button', {}, 'And now?')),
            );
        }

        // Nothing fits: what is near, and what the numbers may be instead.
        none(found, [key, pair], at, bits) {
            const nearest = this.known.nearest(key, pair, bits),
                [{ entry, epsilons, allowed }] = nearest,
                { equation, what } = entry,
                isWrong = equation && nearest.every(one => one.entry.equation === equation),
                share = epsilons * 2 ** -Number(bits),
                isNear = share < NEAR,
                right = -Math.ceil(Math.log10(share)),
                hints = this.known.instead(key, pair, bits).map(hint => this.hint(hint, key, pair)),
                isOther = hints.length > 0;
            if (!isNear && !at && !isOther)
                hints.push(['Was it one step of h = 1/8, with g/L = 1, and in radians?']);
            if (isNear && !isOther && !isWrong)
                hints.push([
                    `It is near: ${right} digits are right. ` +
                        'Has a coefficient, or a part of the program, fewer digits than the rest?',
                ]);
            const silent = found.filter(one => !one.entry.answers.has(key)),
                before = silent.length ? silent : found;
            if (at)
                hints.unshift([
                    `Without the last two numbers it was ${this.some(before)}`,
                    silent.length ? ', for which the file has no answer to them.' : '.',
                ]);
            const far = `${about(epsilons)} ε away; ${Math.round(allowed)} ε are allowed.`;
            const said = isWrong
                ? `. To ${right} digits they are those of a wrong equation: ${what}.`
                : nearest.length > IN_FULL
                  ? `. The nearest are ${count(nearest.length)} entries, ${far}`
                  : `. The nearest is ${this.some(nearest)}, ${far}`;
            this.say(
                `No entry fits${at ? ' all of the numbers' : ''}` +
                    (isNear ? said : ', and none is near.'),
                hints,
                ...(isNear && !isOther && !isWrong && nearest.length === 1
                    ? [this.card([[key, pair]], true)(nearest[0])]
                    : []),
            );
        }

        // What it is: a name, up to three of which it is one, or how many fit; or a wrong equation,
        // if all agree on that.
        inWords(found) {
            const [{ entry }] = found,
                { equation, what } = entry,
                isWrong = equation && found.every(one => one.entry.equation === equation),
                methods = [...new Set(found.map(one => one.entry.of))];
            if (isWrong) return `the equation is wrong: ${what}; ${this.oneOf(methods, 'method')}`;
            if (found.length > 1) return this.oneOf(found.map(one => one.entry.name), 'entry');
            if (!isMistake(entry)) return `it is ${called(entry)}`;
            return `it is ${called(this.known.named(entry.of))} with a mistake`;
        }

        oneOf(names, kind) {
            const kinds = kind === 'method' ? 'methods' : 'entries';
            if (names.length > IN_FULL) return `${count(names.length)} ${kinds} fit`;
            const all = names.map(name => called(this.known.named(name)));
            if (names.length === 1) return `the ${kind} is ${all[0]}`;
            return `it is one of: ${listed(all)}`;
        }

        some(found) {
            if (found.length > IN_FULL) return `one of ${count(found.length)} entries`;
            return listed(found.map(({ entry }) => called(entry)));
        }

        hint([what, fits, other], key, pair) {
            const those = `they are those of ${this.some(fits)}`,
                swapped = texts(pair).reverse(),
                { precision } = this;
            return {
                single: () => [
                    `In single precision ${those}. `,
                    this.same('single', 'Compare them so'),
                ],
                scene: () => [`For ${task(this.known.scenes, other)}, ${those}.`],
                swapped: () => [
                    `With θ and ω exchanged ${those}. `,
                    this.same(precision, 'Exchange them', key, swapped),
                ],
                degrees: () => [`In degrees ${those}. A radian has 57.29578 of them.`],
                'degrees-alone': () => [`With θ in degrees, and ω in rad/s, ${those}.`],
            }[what]();
        }

        // Names alone.
        names(found) {
            const lines = ['Methods', 'Mistakes'].flatMap((title, i) => {
                const some = found.filter(({ entry }) => isMistake(entry) === i > 0),
                    end = j => (j < some.length - 1 ? ',' : '.'),
                    names = some.map((x, j) => span(x.entry.name + end(j)));
                return some.length ? [line(`${title}: `, ...names.flatMap(x => [x, ' ']))] : [];
            });
            const all = markup`<details><summary>Their names</summary>${lines}</details>`;
            all.open = found.length <= OPEN;
            return [all];
        }

        // An entry in full: what it is, and for what is wrong the numbers beside the right ones.
        card(pairs, isNearest = false) {
            return ({ entry, agrees, epsilons, allowed }) => {
                const [key, pair] = pairs.findLast(([key]) => entry.answers.has(key)),
                    right = isMistake(entry) && !isNearest ? this.known.named(entry.of) : entry,
                    answer = right !== entry || isNearest ? right.answers.get(key) : null,
                    [seen, zoo] = entry.seen?.split(/(this book's zoo)$/) ?? [];
                const most = Math.round(allowed);
                const asLong = (text, i) => text.slice(0, pair[i].text.length);
                const rows = [
                    ['also', entry.also?.join('; ')],
                    ['order', entry.order],
                    ['keeps', isMistake(entry) ? null : (entry.keeps?.join(', ') ?? 'nothing')],
                    ['source', entry.source],
                    ['what was done', entry.what],
                    ['solves', entry.equation],
                    ['effect', entry.effect],
                    ['a mistake in', isMistake(entry) && titled(this.known.named(entry.of))],
                    ['seen', zoo ? [seen, link('judging.html#the-zoo', zoo)] : seen],
                    ['how', entry.note],
                    ['off by', agrees && `${about(epsilons)} ε; ${most} ε are allowed`],
                    ['yours', answer && both(texts(pair))],
                    ['right', answer && both(answer.texts.map(asLong))],
                    ['apart', answer && both(this.apart(answer, pair))],
                ].filter(([, value]) => value);
                const each = ([name, value]) => [
                    markup`<dt>${name}</dt>`,
                    markup`<dd>${value}</dd>`,
                ];
                const section = markup`
                    <section>
                        <p><strong>${titled(entry)}</strong></p><dl>${rows.flatMap(each)}</dl>
                    </section>`;
                section.ariaLabel = entry.name;
                return section;
            };
        }

        apart(answer, pair) {
            const { bits } = PRECISIONS[this.precision],
                rounding = 2 ** (2 - Number(bits));
            return beside(answer, pair, bits).off.map((x, i) =>
                x < rounding ? 'rounding' : `${about(x)} ${UNITS[i]}`,
            );
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
