// Which integrator leads to these numbers? The known answers beside a pair of typed decimals. A
// tolerance is a few ε, so that nothing is rounded here: a number is a whole multiple of 10⁻⁶⁰.
(which => {
    'use strict';

    const PLACES = 60,
        ONE = 10n ** BigInt(PLACES),
        PI = 3141592653589793238462643383279502884197169399375105820974944n;

    // ε is 2 to the power of minus these; and so many digits tell any number from the next.
    const PRECISIONS = {
        double: { bits: 52n, digits: 17 },
        single: { bits: 23n, digits: 9 },
    };
    // The first pair that is asked for.
    const FIRST = 'swinging-1';
    // A name is given where no other entry lies within so many times what the name is given by.
    const ALONE = 10n;
    // So many decimals have the steps on wrong equations.
    const DECIMALS = 13;

    const size = x => (x < 0n ? -x : x);
    const larger = (x, y) => (x > y ? x : y);

    // A decimal as it was typed or printed: its value, the unit of its last place, how many digits
    // it has, whether it may be one in single precision. A sentence if it is none.
    function decimal(typed) {
        const text = typed
            .replace(/\b(?:np\.)?float(?:32|64)?\(|_?f(?:32|64)\s*$|[\s()[\]]|[,;]$/g, '')
            .replace(/[−–]/g, '-')
            .replace(/^([-+]?\d*),(\d*)$/, '$1.$2')
            .replace(/d/i, 'e');
        if (!text) return 'is empty';
        if (/^[-+]?(nan|inf)/i.test(text)) return 'is not finite: the step overflowed';
        const parts = /^([-+]?)(\d*)\.?(\d*)(?:e([-+]?\d{1,4}))?$/i.exec(text);
        if (!parts?.[2] && !parts?.[3]) return `is no decimal number: “${typed.trim()}”`;
        const [, sign, whole, fraction, exponent = 0] = parts;
        if (whole.length + Number(exponent) > 30) return 'is too large for a pendulum';
        const last = PLACES + Number(exponent) - fraction.length,
            scale = 10n ** BigInt(Math.abs(last)),
            scaled = x => (last < 0 ? x / scale : x * scale),
            value = scaled(BigInt(`${sign}${whole}${fraction}`.replace(/^\+/, '')));
        const digits = `${whole}${fraction}`.replace(/^0+/, '').length;
        const isSingle = digits <= PRECISIONS.single.digits || Math.fround(text) === Number(text);
        return { value, unit: scaled(1n), digits, isSingle, text };
    }

    // Two numbers in one field, as a program prints them; null if there are not two.
    function two(text) {
        if (/^\s*[-+−]?\d*,\d+\s*$/.test(text)) return null;
        const found = text
            .replace(/float(?:32|64)/g, '')
            .match(/[-+−]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?/gi);
        return found?.length === 2 ? found : null;
    }

    // θ and ω are printed alike: one of them that ended in zeros, which were left out, is as exact
    // as the other.
    function pairOf(...numbers) {
        const [a, b] = numbers.map(({ unit }) => 10n * unit);
        return numbers.map(x => ({ ...x, unit: [x.unit, a, b].reduce((u, v) => (u < v ? u : v)) }));
    }

    // How far a pair is from an answer: in rad and rad/s, and in ε; whether it agrees, or is near,
    // and whether it does as far as it was typed.
    function beside({ values, scale, allowed, decimals = 0n }, pair, bits) {
        const off = pair.map((x, i) => size(x.value - values[i])),
            limit = (allowed >> bits) + decimals,
            within = (times, units) =>
                off.every((x, i) => x <= times * (limit + (units ? pair[i].unit : 0n)));
        return {
            off: off.map(x => Number(x) / Number(ONE)),
            epsilons: Number(larger(...off) << bits) / Number(scale),
            allowed: Number(limit << bits) / Number(scale),
            agrees: within(1n, false),
            soFar: within(1n, true),
            isNear: within(ALONE, false),
            isNearSoFar: within(ALONE, true),
        };
    }

    // What is compared with a pair of numbers.
    function answer({ theta, omega, tolerance }) {
        const values = [theta, omega].map(text => decimal(text).value),
            scale = larger(...values.map(size));
        return { values, scale, allowed: BigInt(tolerance) * scale, texts: [theta, omega] };
    }

    // A method on each wrong equation, as mistakes in it.
    function onWrongEquations({ name, on = {}, answers: [{ tolerance }] }, equations) {
        const decimals = 10n ** BigInt(PLACES - DECIMALS);
        return Object.entries(on).map(([wrong, state]) => ({
            name: `${name}-${wrong}`,
            of: name,
            ...equations[wrong],
            answers: new Map([[FIRST, { ...answer({ ...state, tolerance }), decimals }]]),
        }));
    }

    // The entries of the file, methods first, with their answers by scene and number of steps.
    class Known {
        constructor({ scenes, equations, methods, mistakes }) {
            this.scenes = scenes;
            const wrong = methods.flatMap(method => onWrongEquations(method, equations));
            // Those of the library, which have titles, are the likeliest.
            const likely = [...methods].sort((a, b) => Boolean(b.title) - Boolean(a.title));
            this.entries = [...likely, ...mistakes].map(entry => {
                const answers = entry.answers.map(({ scene, steps, ...rest }) => [
                    `${scene}-${steps}`,
                    answer(rest),
                ]);
                return { ...entry, answers: new Map(answers) };
            });
            // What the file has as a mistake in it is that, as twice the force in both kicks.
            const isKnown = ({ of, answers }) => {
                const { values, decimals } = answers.get(FIRST);
                return this.entries.some(entry => {
                    const other = entry.of === of && entry.answers.get(FIRST);
                    return other && values.every((x, i) => size(x - other.values[i]) <= decimals);
                });
            };
            this.entries.push(...wrong.filter(entry => !isKnown(entry)));
            this.keys = [...new Set(this.entries.flatMap(({ answers }) => [...answers.keys()]))];
        }

        named(name) {
            return this.entries.find(entry => entry.name === name);
        }

        // All entries with an answer to this.
        beside(key, pair, bits, among = this.entries) {
            return among
                .filter(({ answers }) => answers.has(key))
                .map(entry => ({ entry, ...beside(entry.answers.get(key), pair, bits) }));
        }

        // The nearest first, with those that are not ten times as far.
        nearest(key, pair, bits) {
            const all = this.beside(key, pair, bits).sort((a, b) => a.epsilons - b.epsilons),
                most = all[0].epsilons * Number(ALONE);
            return all.filter(({ epsilons }) => epsilons <= most);
        }

        // Those that agree; if there are none, those that agree as far as the numbers were typed.
        // With either stand those that are near: only one that is alone has a name.
        fits(key, pair, bits, among) {
            const all = this.beside(key, pair, bits, among);
            if (all.some(found => found.agrees)) return all.filter(found => found.isNear);
            if (all.some(found => found.soFar)) return all.filter(found => found.isNearSoFar);
            return [];
        }

        // Whether two entries are so far apart there that each can be alone.
        apart(a, b, key, bits) {
            const [x, y] = [a.answers.get(key), b.answers.get(key)];
            if (!x || !y) return false;
            const limit = (x.allowed > y.allowed ? x.allowed : y.allowed) >> bits;
            return x.values.some((value, i) => size(value - y.values[i]) > (ALONE + 1n) * limit);
        }

        // What is left after each pair, [[key, pair], …]: `found`, which agree; `hidden`, mistakes
        // in these methods that no pair so far can show; `at`, the number of a pair that fits none.
        left(pairs, bits) {
            let found = [],
                hidden = this.entries;
            for (const [at, [key, pair]] of pairs.entries()) {
                const before = [...found.map(({ entry }) => entry), ...hidden],
                    fits = this.fits(key, pair, bits, before),
                    names = fits.map(({ entry }) => entry.name);
                // A mistake without an answer here does here what its method does.
                const stays = entry => !entry.answers.has(key) && names.includes(entry.of);
                if (!fits.length) return { found, hidden: [], at };
                found = [...fits, ...found.filter(({ entry }) => stays(entry))];
                hidden = hidden.filter(stays);
            }
            return { found, hidden };
        }

        // The scene and the number of steps that tell most of what is left apart, if any does.
        question({ found, hidden }, asked, bits) {
            const known = found.map(({ entry }) => entry),
                all = [...known, ...hidden];
            const told = key =>
                known.flatMap((a, i) => all.slice(i + 1).filter(b => this.apart(a, b, key, bits)));
            return this.keys
                .filter(key => !asked.includes(key))
                .map(key => [key, told(key).length])
                .reduce((best, next) => (next[1] > best[1] ? next : best), [null, 0])[0];
        }

        // What a pair that fits nothing may be instead: [what, those that fit, their scene].
        instead(key, pair, bits) {
            const degrees = pair.map(({ value, unit }) => ({
                value: (value * PI) / (180n * ONE),
                // Its own rounding, and that of π/180.
                unit: unit / 57n + (size(value) >> (bits + 4n)),
            }));
            // A few digits are those of many entries.
            const isRough = pair.every(x => x.digits < 6);
            const others = this.keys.filter(other => other !== key && !isRough);
            const isSingle = pair.every(x => x.isSingle);
            return [
                ['single', isSingle ? this.fits(key, pair, PRECISIONS.single.bits) : []],
                ...others.map(other => ['scene', this.fits(other, pair, bits), other]),
                ['swapped', this.fits(key, [...pair].reverse(), bits)],
                ['degrees', this.fits(key, degrees, bits)],
                ['degrees-alone', this.fits(key, [degrees[0], pair[1]], bits)],
            ].filter(([, fits]) => fits.length);
        }
    }

    Object.assign(which, { FIRST, Known, PRECISIONS, beside, decimal, pairOf, two });
})((globalThis.which ??= {}));
