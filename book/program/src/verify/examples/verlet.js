'use strict';
const lines = require('readline').createInterface({ input: process.stdin });
lines.on('line', (line) => {
    const [word, ...numbers] = line.split(' ');
    if (word === 'bye') return lines.close();
    if (word === 'hello') return console.log('hello 1 my verlet');
    if (word !== 'pendulum') return console.log('unsupported');
    let [gOverL, theta, omega, h, n, k] = numbers.map(Number);
    let [force, evaluations] = [-gOverL * Math.sin(theta), 1];
    const answer = [];
    for (let step = 1; step <= n; step++) {
        omega += h / 2 * force;
        theta += h * omega;
        force = -gOverL * Math.sin(theta);
        evaluations++;
        omega += h / 2 * force;
        if (step % k === 0) answer.push(`${theta} ${omega}`);
    }
    console.log([...answer, `done ${evaluations}`].join('\n'));
});
