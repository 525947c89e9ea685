// "Paste your rows": a table of a run is told what it is, by the judge's own identification in
// WebAssembly, which is loaded when it is first asked. Nothing is sent anywhere: the page's policy
// allows no address to send to. Without scripts and in print.html what stands in its place is
// shown.
(which => {
    'use strict';

    const spot = document.querySelector('.rows-spot'),
        isPrinted = /\/print\.html$/.test(location.pathname);
    if (!spot || !which || !globalThis.DecompressionStream || isPrinted) return;

    const ASSETS = new URL('../', document.currentScript.src),
        MOST = 256 << 20,
        [LEFT, RIGHT] = [64, 8];

    const script = (file, name) =>
        new Promise((resolve, reject) => {
            if (globalThis[name]) return resolve(globalThis[name]);
            const loaded = element('script', { src: new URL(file, ASSETS) });
            loaded.addEventListener('load', () => resolve(globalThis[name]));
            loaded.addEventListener('error', () => reject(new Error(`${file} is missing`)));
            document.head.append(loaded);
        });

    // The identification, compiled once.
    let once;
    async function compiled() {
        const text = await script('rows.wasm.js', 'pendulaRows'),
            packed = Uint8Array.from(atob(text), letter => letter.charCodeAt(0)),
            stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip')),
            bytes = await new Response(stream).arrayBuffer(),
            { instance } = await WebAssembly.instantiate(bytes, {});
        return instance.exports;
    }

    // What it says of these bytes.
    async function identified(bytes) {
        const judge = await (once ??= compiled()),
            at = judge.reserve(bytes.length);
        new Uint8Array(judge.memory.buffer, at, bytes.length).set(bytes);
        const length = judge.identify(),
            said = new Uint8Array(judge.memory.buffer, judge.answer_at(), length);
        return JSON.parse(new TextDecoder().decode(said));
    }

    // What a name between ⟦ and ⟧ is called: an entry's, or what is wrong in a mistake.
    function titled(known, name) {
        const is = entry => entry.name === name,
            wrong = known.mistakes.find(is),
            also = known.methods.find(is)?.also?.[0];
        if (wrong) return `${wrong.of} with a mistake: ${wrong.what} (${wrong.effect})`;
        return also ? `${name} (${also})` : name;
    }

    // A chart of lines over time: paths of [t, value], which a gap interrupts.
    function chart(title, lines, height, note) {
        const points = lines.flatMap(({ points }) => points),
            finite = points.filter(([, y]) => Number.isFinite(y)),
            // So that letters have their size on a telephone too.
            width = Math.min(640, Math.max(240, result.clientWidth)),
            [low, high] = [0, 1].map(i => finite.map(point => point[i])).map(range),
            across = t => LEFT + ((t - low[0]) / (low[1] - low[0] || 1)) * (width - LEFT - RIGHT),
            up = y => 8 + (1 - (y - high[0]) / (high[1] - high[0] || 1)) * (height - 34);
        const path = ({ points, name }) => {
            let pen = 'M';
            const d = points.map(([t, y]) => {
                if (!Number.isFinite(y)) {
                    pen = 'M';
                    return '';
                }
                const word = `${pen}${across(t).toFixed(1)} ${up(y).toFixed(1)}`;
                pen = 'L';
                return word;
            });
            return drawn('path', { class: name, d: d.join('') });
        };
        const label = (x, y, anchor, text) =>
            drawn('text', { x, y, 'text-anchor': anchor }, tick(Number(text.toPrecision(3))));
        const svg = drawn(
            'svg',
            { viewBox: `0 0 ${width} ${height}`, role: 'img' },
            drawn('title', {}, title),
            drawn('desc', {}, note),
            drawn('path', { class: 'frame', d: `M${LEFT} 8V${height - 26}H${width - RIGHT}` }),
            ...lines.map(path),
            label(LEFT - 6, 16, 'end', high[1]),
            label(LEFT - 6, height - 26, 'end', high[0]),
            label(LEFT, height - 8, 'start', low[0]),
            label(width - RIGHT, height - 8, 'end', low[1]),
        );
        return markup`<figure>${svg}<figcaption>${`${title}. ${note}`}</figcaption></figure>`;
    }

    // The least and the greatest; of very many too.
    function range(values) {
        const wider = ([a, b], x) => [Math.min(a, x), Math.max(b, x)];
        return values.reduce(wider, [Infinity, -Infinity]);
    }

    function charts({ t, theta, exact, off }) {
        const over = values => t.map((time, i) => [time, values[i] ?? NaN]),
            some = off.filter(Number.isFinite);
        const angles = chart(
            'Angle (rad) over time (s)',
            [
                { points: over(exact), name: 'exact' },
                { points: over(theta), name: 'rows' },
            ],
            220,
            'Your rows, and beneath them the exact motion of the equation from the first row.',
        );
        if (!some.length) return [angles];
        const residuals = chart(
            'How far each row is from what was found',
            [{ points: over(off), name: 'rows' }],
            150,
            'In what rounding of both rows does: between −1 and 1 they agree within their digits.',
        );
        return [angles, residuals];
    }

    function example() {
        const h = 0.02,
            lines = ['t,theta,omega'];
        for (let [n, theta, omega] = [0, 1, 0]; n < 100; n++) {
            lines.push([n * h, theta, omega].map((x, i) => x.toFixed(i ? 5 : 2)).join(','));
            omega -= h * 9.8 * Math.sin(theta);
            theta += h * omega;
        }
        return lines.join('\n');
    }

    const field = element('textarea', {
        rows: 7,
        spellcheck: 'false',
        autocomplete: 'off',
        placeholder: 't,theta,omega\n0.00,1.00000,0.00000\n0.02,0.99670,−0.16493',
    });
    const file = element('input', { type: 'file' }),
        said = element('output', { tabindex: -1, 'aria-live': 'polite' }),
        result = element('div', { class: 'result' });
    const form = markup`
        <form aria-label="Paste your rows">
            <label>${[element('span', {}, 'Rows of t, θ and ω'), field]}</label>
            <p class="ask">
                <button>What made them?</button>&#32;<label class="file">or a file: ${file}</label>
            </p>
            <p class="examples">
                ${button('try', 'Try an example', () => {
                    field.value = example();
                    ask();
                })}
                &#32;Nothing is sent anywhere: the rows stay in this page.
            </p>
            ${[said, result]}
        </form>`;

    function say(words, ...parts) {
        said.replaceChildren(element('strong', {}, words));
        result.replaceChildren(...parts);
    }

    // Says what the bytes are, or else the text in the field. Only the last question is answered.
    let asked = 0;
    async function ask(bytes) {
        const own = ++asked;
        say('Looking …');
        // That this is seen before the page is busy.
        await new Promise(done => setTimeout(done, 30));
        try {
            const given = bytes ?? new TextEncoder().encode(field.value),
                found = await identified(given),
                known = await script('known-answers.js', 'knownAnswers');
            if (own === asked) show(found, known);
        } catch (error) {
            once = undefined;
            if (own === asked) say(`It could not be read: ${error.message}.`);
        }
    }

    function show({ refused, said, faults, drawn: rows }, known) {
        if (refused) {
            say(refused);
            return;
        }
        // No line ends within a number.
        const held = text => text.replaceAll(' × ', '\u00a0×\u00a0');
        const words = text => held(text).replace(/⟦(.*?)⟧/g, (_, name) => titled(known, name));
        const [method] = said.filter(([heading]) => heading === 'The method'),
            [first, ...more] = words(method[1]).split('\n'),
            isName = method[1].startsWith('⟦'),
            capital = isName ? first : first[0].toUpperCase() + first.slice(1);
        const lists = said.map(([heading, text]) => {
            const isMethod = heading === 'The method',
                lines = isMethod ? more : words(text).split('\n');
            const told = heading === 'What was read' ? [...lines, ...faults.map(held)] : lines;
            return told.length
                ? [
                      element('dt', {}, heading),
                      ...told.map(line => element('dd', {}, line.trim())),
                  ]
                : [];
        });
        say(
            capital,
            element('dl', {}, ...lists.flat()),
            ...(rows ? charts(rows) : []),
        );
    }

    async function read(chosen) {
        if (!chosen) return;
        if (chosen.size > MOST) say('It is longer than 256 MB: give some thousand rows of it.');
        else ask(new Uint8Array(await chosen.arrayBuffer()));
    }

    form.addEventListener('submit', event => {
        event.preventDefault();
        ask();
    });
    file.addEventListener('change', () => read(file.files[0]));
    form.addEventListener('dragover', event => event.preventDefault());
    form.addEventListener('drop', event => {
        if (!event.dataTransfer.files.length) return;
        event.preventDefault();
        read(event.dataTransfer.files[0]);
    });
    spot.prepend(form);
    spot.classList.add('on');
})(globalThis.which);
