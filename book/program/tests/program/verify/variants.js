// The integrators of variants.py in another language, as far as they are judged in both.
'use strict';

const lines = require('node:readline').createInterface({ input: process.stdin });
const name = process.argv[2];

function kicks(first, second, stale) {
    return (force, t, [theta, omega], h) => {
        const before = force(t, theta);
        const half = omega + first * h * before;
        const next = theta + h * half;
        return [next, half + second * h * (stale ? before : force(t + h, next))];
    };
}

function rungeKutta(a, b, times = 1) {
    return (force, t, z, h) => {
        const slopes = [];
        for (const row of a) {
            const sum = (i) => row.reduce((s, x, j) => s + x * slopes[j][i], 0);
            const at = [0, 1].map((i) => z[i] + h * sum(i));
            const node = row.reduce((s, x) => s + x, 0);
            slopes.push([at[1], force(t + times * node * h, at[0])]);
        }
        return [0, 1].map((i) => z[i] + h * b.reduce((s, x, j) => s + x * slopes[j][i], 0));
    };
}

const a = [[], [0.5], [0, 0.5], [0, 0, 1]];
const b = [1 / 6, 1 / 3, 1 / 3, 1 / 6];
const STEPS = {
    verlet: kicks(0.5, 0.5),
    rk4: rungeKutta(a, b),
    heun: rungeKutta([[], [1]], [0.5, 0.5]),
    'three-eighths': rungeKutta(
        [[], [1 / 3], [-1 / 3, 1], [1, -1, 1]], [1 / 8, 3 / 8, 3 / 8, 1 / 8]),
    'position-verlet': (force, t, [theta, omega], h) => {
        const middle = theta + 0.5 * h * omega;
        const after = omega + h * force(t + 0.5 * h, middle);
        return [middle + 0.5 * h * after, after];
    },
    'wrong-stage-times': rungeKutta(a, b, 0),
    'drift-kick': (force, t, [theta, omega], h) => {
        const next = theta + h * omega;
        return [next, omega + h * force(t + h, next)];
    },
    'half-step-velocities': (force, t, [theta, omega], h) => {
        const after = omega + (t === 0 ? 0.5 : 1) * h * force(t, theta);
        return [theta + h * after, after];
    },
    truncated: rungeKutta(a, [0.1667, 0.3333, 0.3333, 0.1667]),
    'k4-from-k2': rungeKutta([[], [0.5], [0, 0.5], [0, 1, 0]], b),
    'stale-force': kicks(0.5, 0.5, true),
    'fifth-digit': kicks(0.50001, 0.5),
    gravity: kicks(0.5, 0.5),
    error: kicks(0.5, 0.5),
    unsupported: kicks(0.5, 0.5),
    'error-later': kicks(0.5, 0.5),
};

/** The answer to a request. */
function answer(driven, words) {
    const numbers = words.map(Number);
    const g = numbers.shift() * (name === 'gravity' ? 9.8 / 9.81 : 1);
    const [amplitude, frequency] = driven ? numbers.splice(0, 2) : [0, 0];
    let [theta, omega, h, n, k] = numbers;
    const force = (t, x) => (driven ? amplitude * Math.cos(frequency * t) : 0) - g * Math.sin(x);
    let z = [theta, omega];
    const out = [];
    for (let step = 0; step < n; step++) {
        z = STEPS[name](force, step * h, z, h);
        if ((step + 1) % k === 0) out.push(z.join(' '));
    }
    out.push('done');
    return out.join('\n');
}

let asked = 0;
lines.on('line', (line) => {
    const [word, ...words] = line.trim().split(/\s+/);
    asked += 1;
    if (word === 'bye') {
        process.exit();
    } else if (word === 'hello') {
        console.log(`hello 1 ${name}`);
    } else if (name === 'error' || (name === 'error-later' && asked > 7)) {
        console.log('error the table is empty');
    } else if (name === 'unsupported' || (word !== 'pendulum' && word !== 'driven')) {
        console.log('unsupported');
    } else {
        console.log(answer(word === 'driven', words));
    }
});
