'use strict';
// As variants.py, in another language.

const lines = require('node:readline').createInterface({ input: process.stdin });
const name = process.argv[2];

function verlet(force, t, [theta, omega], h) {
    const half = omega + 0.5 * h * force(t, theta);
    const next = theta + h * half;
    return [next, half + 0.5 * h * force(t + h, next)];
}

function rk4(force, t, [theta, omega], h) {
    const a = force(t, theta);
    const b = force(t + h / 2, theta + (h / 2) * omega);
    const c = force(t + h / 2, theta + (h / 2) * (omega + (h / 2) * a));
    const d = force(t + h, theta + h * (omega + (h / 2) * b));
    return [
        theta + h * omega + ((h * h) / 6) * (a + b + c),
        omega + (h / 6) * (a + 2 * (b + c) + d),
    ];
}

/** The answer to a request. */
function answer(driven, words) {
    const numbers = words.map(Number);
    const g = numbers.shift() * (name === 'gravity' ? 9.8 / 9.81 : 1);
    const [amplitude, frequency] = driven ? numbers.splice(0, 2) : [0, 0];
    const [theta, omega, h, n, k] = numbers;
    const force = (t, x) => (driven ? amplitude * Math.cos(frequency * t) : 0) - g * Math.sin(x);
    const one = name === 'rk4' ? rk4 : verlet;
    let z = [theta, omega];
    const out = [];
    for (let step = 0; step < n; step++) {
        z = one(force, step * h, z, h);
        if ((step + 1) % k === 0) out.push(z.join(' '));
    }
    out.push('done');
    return out.join('\n');
}

lines.on('line', (line) => {
    const [word, ...words] = line.trim().split(/\s+/);
    if (word === 'bye') {
        process.exit();
    } else if (word === 'hello') {
        console.log(`hello 1 ${name}`);
    } else if (word === 'pendulum' || word === 'driven') {
        console.log(answer(word === 'driven', words));
    } else {
        console.log('unsupported');
    }
});
