// Numbers in words, and elements of a page.
(theLab => {
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

    // A number that reads back to the same, as the command line writes it in its rows.
    function printed(x) {
        if (Object.is(x, -0)) return '-0.0';
        const [mantissa, exponent] = x.toExponential().split('e');
        const digits = mantissa.replace(/[-.]/g, ''),
            sign = x < 0 ? '-' : '',
            point = Number(exponent) + 1;
        if (point >= digits.length && point <= 16) return `${sign}${digits.padEnd(point, '0')}.0`;
        if (point > 0 && point <= 16)
            return `${sign}${digits.slice(0, point)}.${digits.slice(point)}`;
        if (point > -5 && point <= 0) return `${sign}0.${'0'.repeat(-point)}${digits}`;
        return `${mantissa}e${Number(exponent)}`;
    }

    function element(name, attributes = {}, ...children) {
        const made = document.createElement(name);
        for (const [key, value] of Object.entries(attributes)) {
            if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
            else if (value !== false) made.setAttribute(key, value === true ? '' : value);
        }
        made.append(...children);
        return made;
    }

    const button = (name, words, onclick) =>
        element('button', { type: 'button', class: name, onclick }, words);

    Object.assign(theLab, {
        button,
        count,
        element,
        measured,
        printed,
        raised,
        rough,
        roundUp,
        seconds,
        tick,
    });
})((globalThis.theLab ??= {}));
