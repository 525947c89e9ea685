'use strict';
const { spawn } = require('child_process');
const lines = require('readline').createInterface;

// Whether the claims hold, and the report.
async function judge(method, claims) {
    const judge = spawn('pendula', ['verify', '--stdio', '--claims', claims],
        { stdio: ['pipe', 'pipe', 'inherit'] });
    judge.stdin.on('error', () => {}); // It says itself why it does not wait.
    const ended = new Promise((resolve) => judge.on('close', resolve));
    let report;
    for await (const line of lines({ input: judge.stdout })) {
        if (report) report.push(line);
        else if (line === 'bye') report = [];
        else judge.stdin.write(`${answer(method, line)}\n`);
    }
    return [await ended === 0, (report || []).join('\n')];
}

function answer(method, line) {
    const [word, ...numbers] = line.split(' ');
    if (word === 'hello') return `hello 1 ${method.name}`;
    if (word !== 'pendulum') return 'unsupported';
    let [gOverL, theta, omega, h, n, k] = numbers.map(Number);
    let [evaluations, states] = [0, []];
    const force = (angle) => (evaluations++, -gOverL * Math.sin(angle));
    for (let step = 1; step <= n; step++) {
        [theta, omega] = method(force, theta, omega, h);
        if (step % k === 0) states.push(`${theta} ${omega}`);
    }
    return [...states, `done ${evaluations}`].join('\n');
}

function verlet(force, theta, omega, h) {
    omega += h / 2 * force(theta);
    theta += h * omega;
    return [theta, omega + h / 2 * force(theta)];
}

judge(verlet, 'order=2 symplectic symmetric').then(([holds, report]) => {
    console.log(report);
    process.exitCode = holds ? 0 : 1;
});
