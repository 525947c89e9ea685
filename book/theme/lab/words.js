// Numbers in words, and elements of a page. Functions alone, so that a page may load this twice.
'use strict';

function raised(exponent) {
    return [...String(exponent)].map(sign => '⁰¹²³⁴⁵⁶⁷⁸⁹'[sign] ?? '⁻').join('');
}

// Thousands separated by no-break spaces.
function count(n) {
    return String(n).replace(/\B(?=(\d{3})+$)/g, '\u00a0');
}

// A measured time: two digits.
function rough(x) {
    return Number.isFinite(x) ? count(Number(x.toPrecision(2))) : '–';
}

// A measured number: four significant digits, as in the tables, and never fewer, so that the
// width of a column does not change.
function measured(x) {
    if (!Number.isFinite(x)) return '–';
    if (x === 0) return '0';
    const [mantissa, exponent] = x.toExponential(3).split('e');
    if (exponent >= -3 && exponent < 4)
        return Number(`${mantissa}e${exponent}`).toPrecision(4).replace('-', '−');
    return `${mantissa.replace('-', '−')}\u00a0×\u00a010${raised(Number(exponent))}`;
}

// A number on an axis: as short as it can be.
function tick(x) {
    const size = Math.abs(x);
    if (x === 0 || (size >= 1e-3 && size < 1e6)) {
        const short = Number(size.toPrecision(4));
        return (x < 0 ? '−' : '') + (short >= 1e4 ? count(short) : short);
    }
    const [mantissa, exponent] = Number(x.toPrecision(4))
        .toExponential()
        .replace('-', '−')
        .split('e');
    return `${mantissa}\u00a0×\u00a010${raised(Number(exponent.replace('−', '-')))}`;
}

// A time (s), with as many decimals as the step has, and no more than six.
function seconds(t, step) {
    // A step may be written 1e-5.
    const [digits, exponent = 0] = String(step).split('e');
    const decimals = (digits.split('.')[1] ?? '').length - exponent;
    return t.toFixed(Math.min(Math.max(decimals, 1), 6));
}

// 1, 2 or 5 times a power of ten, not below x.
function roundUp(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 2, 5, 10].map(m => m * power).find(tick => tick >= x * (1 - 1e-9));
}

function filled(made, attributes, children) {
    for (const [key, value] of Object.entries(attributes)) {
        if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
        else if (value !== false) made.setAttribute(key, value === true ? '' : value);
    }
    made.append(...children);
    return made;
}

// An element of a page.
function element(name, attributes = {}, ...children) {
    return filled(document.createElement(name), attributes, children);
}

// An element of a drawing.
function drawn(name, attributes = {}, ...children) {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    return filled(made, attributes, children);
}

// What the HTML says, with nodes, texts or lists of them where they stand in it.
function markup(strings, ...given) {
    const template = document.createElement('template');
    template.innerHTML = strings.map(text => text.replace(/\s*\n\s*/g, '')).join('<!---->');
    const content = document.importNode(template.content, true);
    const walker = document.createTreeWalker(content, NodeFilter.SHOW_COMMENT);
    const places = given.map(() => walker.nextNode());
    places.forEach((place, i) => place.replaceWith(...[given[i]].flat()));
    return content.firstChild;
}

function button(name, words, onclick) {
    return element('button', { type: 'button', class: name, onclick }, words);
}

// A field for a number, as a slider (range) or to be typed in (number).
function field(type, name, [min, max, step], more) {
    return element('input', { type, class: name, min, max, step, ...more });
}

// `options` are pairs of value and words.
function select(attributes, options) {
    const each = options.map(([value, words]) => element('option', { value }, words));
    return element('select', attributes, ...each);
}

function checkbox(name, words, isOn, changed) {
    const box = element('input', {
        type: 'checkbox',
        class: name,
        checked: isOn,
        onchange: () => changed(box.checked),
    });
    return { box, label: element('label', {}, box, words) };
}

// Numbers with every digit, [name, value, of what], and the command that prints the same.
function spelt(words, values, command = '') {
    const each = values.flatMap(([name, value, of]) => {
        const digits = element('data', { value, 'data-of': of }, value);
        return [element('span', { class: 'held' }, `${name} = `, digits), '  '];
    });
    const numbers = markup`<p class="numbers">${words}${each}</p>`;
    // No line ends between an option and its value, or within one.
    const options = command.split(/ (?=--)/).flatMap(words => [
        element('span', { class: 'held' }, words),
        ' ',
    ]);
    return command ? [numbers, markup`<pre><code>${options.slice(0, -1)}</code></pre>`] : [numbers];
}

// The command that takes these steps.
function simulate(method, { theta0, omega0, g, L, dt }, steps) {
    return (
        `pendula simulate --method ${method} --theta0 ${theta0} --omega0 ${omega0} ` +
        `--gravity ${g} --length ${L} --dt ${dt} --steps ${steps} --every ${Math.max(steps, 1)}`
    );
}

// Where every digit stands.
function everyDigit(inside) {
    return markup`
        <details class="digits">
            <summary>Every digit, and the same on the command line</summary>${inside}
        </details>`;
}
