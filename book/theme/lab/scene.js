// The lab's scenes: the allowed values, the lessons, and how a scene is written in the page's
// address.
'use strict';

const PAPERS = ['forward-euler', 'symplectic-euler', 'rk4', 'stormer-verlet'];
// What moves: its number in book/lab/src/exports.rs, its own sliders, of which the last two are
// the library's p and q, and where it starts.
const SYSTEMS = {
    pendulum: { number: 0, title: 'Pendulum', keys: ['beta'], given: {} },
    driven: {
        number: 1,
        title: 'Driven pendulum',
        keys: ['beta', 'gamma', 'Omega'],
        given: { theta0: 0, beta: 0.783, gamma: 1.15, Omega: 2.088 },
    },
    shaken: {
        number: 2,
        title: 'Shaken pendulum',
        keys: ['a', 'Omega'],
        given: { theta0: 3, dt: 0.002, a: 0.1, Omega: 60 },
    },
    double: {
        number: 3,
        title: 'Double pendulum',
        keys: ['theta2', 'omega2'],
        given: { methods: ['rk4', 'dop853'], theta0: 2, theta2: 2 },
    },
};
const OWN = [...new Set(Object.values(SYSTEMS).flatMap(({ keys }) => keys))];
// `until` is where the run stops (s), or zero for never. `lesson` and `step` say whose words
// stand beside the picture; `pin` is the address of the run that is compared with.
const SCENE = {
    system: 'pendulum',
    methods: PAPERS,
    theta0: 1,
    omega0: 0,
    dt: 0.01,
    g: 9.81,
    L: 1,
    beta: 0,
    gamma: 0,
    Omega: 1,
    a: 0,
    theta2: 0,
    omega2: 0,
    speed: 1,
    scale: 'linear',
    until: 0,
    lesson: 'over-the-top',
    step: 1,
    pin: '',
};
// The lessons of lab.md, by the ids of their headings, and of a small lab in a chapter the
// time at which it begins (s), and the plot that it shows.
const PRESETS = {
    'over-the-top': {
        title: 'Forward Euler goes over the top',
        theta0: 1.5,
        dt: 0.03,
        from: 6,
        shows: 'energy',
    },
    'kick-then-drift': {
        title: 'One index apart',
        methods: ['forward-euler', 'symplectic-euler'],
        theta0: 2,
        dt: 0.05,
        from: 10,
        shows: 'energy',
    },
    bounded: {
        title: 'Bounded, and how',
        methods: ['symplectic-euler', 'stormer-verlet'],
        theta0: 2,
        dt: 0.02,
        from: 12,
        shows: 'energy',
    },
    'for-an-hour': {
        title: 'RK4 against Verlet for an hour',
        methods: ['rk4', 'stormer-verlet'],
        theta0: 1,
        dt: 0.05,
        speed: 100,
        scale: 'log',
        until: 3600,
        from: 900,
        shows: 'energy',
    },
    'last-torus': {
        title: 'K = 0.97: the last fence',
        methods: ['symplectic-euler', 'stormer-verlet'],
        theta0: 3,
        dt: 0.314455,
        speed: 1000,
        from: 300,
        shows: 'energy',
    },
    'hidden-order': {
        // From here the period is 2.14 s, a whole number of steps.
        title: 'One period hides the order',
        methods: ['symplectic-euler', 'stormer-verlet'],
        theta0: 1.00304559,
        dt: 0.0214,
        scale: 'log',
        until: 2.14,
        shows: 'angle',
    },
    'too-long-a-step': {
        title: 'A step too long',
        theta0: 0.2,
        dt: 0.66,
        speed: 10,
        scale: 'log',
        from: 60,
        shows: 'energy',
    },
    friction: {
        title: 'Friction',
        methods: ['forward-euler', 'symplectic-euler', 'rk4'],
        theta0: 2,
        dt: 0.1,
        beta: 0.2,
        shows: 'energy',
    },
    driven: {
        title: 'Driven into chaos',
        system: 'driven',
        methods: ['rk4', 'stormer-verlet', 'dop853'],
        dt: 0.02,
        gamma: 0.9,
        speed: 10,
        shows: 'energy',
    },
    upright: {
        title: 'Upright, if shaken',
        system: 'shaken',
        methods: ['stormer-verlet', 'rk4'],
        theta0: 2.8,
        shows: 'energy',
    },
    'two-bobs': {
        title: 'Two bobs',
        system: 'double',
        methods: ['rk4', 'gauss-6', 'dop853'],
        dt: 0.02,
        shows: 'energy',
    },
};
// What is set, and its unit; from where to where the slider goes, by what steps, or by those of
// the logarithm; the least and the most that may be typed.
const slider = (label, unit, [from, to, by], [least, most], logarithmic = false) => ({
    label,
    unit,
    from,
    to,
    by,
    least,
    most,
    logarithmic,
});
const SLIDERS = {
    dt: slider('Step Δt', 's', [-3, 0.2, 0.01], [1e-5, 3], true),
    theta0: slider('Angle θ₀', 'rad', [-3.14, 3.14, 0.01], [-100, 100]),
    omega0: slider('Start velocity ω', 'rad/s', [-15, 15, 0.05], [-1000, 1000]),
    g: slider('Gravity g', 'm/s²', [0.1, 25, 0.01], [0.001, 1000]),
    L: slider('Length L', 'm', [0.1, 5, 0.01], [0.001, 1000]),
    beta: slider('Damping β', '1/s', [0, 2, 0.01], [0, 10]),
    gamma: slider('Drive γ', 'm g L', [0, 3, 0.01], [-100, 100]),
    a: slider('Amplitude a', 'm', [0, 0.5, 0.01], [0, 10]),
    Omega: slider('Frequency Ω', 'rad/s', [-1, 2.3, 0.01], [0.001, 1000], true),
    theta2: slider('Lower angle θ₂', 'rad', [-3.14, 3.14, 0.01], [-100, 100]),
    omega2: slider('Lower velocity ω₂', 'rad/s', [-15, 15, 0.05], [-1000, 1000]),
};
// The longest run (s): longer than any that the library takes.
const LONGEST = 1e9;
const SPEEDS = [0.1, 0.25, 1, 2, 10, 100, 1000];

// The longest run (steps) that the library takes.
const MOST_STEPS = 36e6;

function startOf(system) {
    return { ...SCENE, ...SYSTEMS[system].given, system };
}

// The sliders of a system.
function keysOf(system) {
    return Object.keys(SLIDERS).filter(
        key => !OWN.includes(key) || SYSTEMS[system].keys.includes(key),
    );
}

// A value of a scene in words.
const worded = (scene, key) => {
    const { label, unit } = SLIDERS[key];
    return `${label.split(' ').at(-1)} = ${scene[key]} ${unit}`;
};

// Whether the energy is conserved, so that there is an error, and whether there is a closed
// form.
const conserves = ({ system, beta }) =>
    system === 'double' || (system === 'pendulum' && beta === 0);
const isClosed = ({ system, beta }) => system === 'pendulum' && beta === 0;

// The first step of a lesson.
function presetScene(name) {
    const { title, shows, from, ...given } = PRESETS[name];
    return { ...startOf(given.system ?? 'pendulum'), ...given, lesson: name };
}

// What is moved, by which methods and in which steps.
function physics(scene) {
    const parts = [`m=${scene.methods.join(',')}`];
    if (scene.system !== 'pendulum') parts.push(`system=${scene.system}`);
    for (const key of keysOf(scene.system)) parts.push(`${key}=${scene[key]}`);
    return parts;
}

function address(scene) {
    const parts = [...physics(scene), `speed=${scene.speed}`, `scale=${scene.scale}`];
    if (scene.until) parts.push(`until=${scene.until}`);
    if (scene.lesson !== SCENE.lesson) parts.push(`lesson=${scene.lesson}`);
    if (scene.step > 1) parts.push(`step=${scene.step}`);
    if (scene.pin) parts.push(`pin=${encodeURIComponent(scene.pin)}`);
    return parts.join('&');
}

// What a pinned run is recomputed from.
const pinOf = (scene, steps) => [...physics(scene), `steps=${steps}`].join('&');

// The number that a text says; NaN for none, also where there is only white space, which
// JavaScript takes for zero. Its −0 would not outlive an address.
function number(text) {
    return text?.trim() ? Number(text) + 0 : NaN;
}

const isCount = (x, most) => Number.isInteger(x) && x >= 1 && x <= most;

// Reads addresses: with known methods only, no more than `places`, and steps that the
// `lessons`, by name, have.
class Addresses {
    constructor(known, places, lessons) {
        Object.assign(this, { known, places, lessons });
    }

    // The scene of an address, or null if it has none. Values that it does not name are as at
    // the start of its system; invalid ones are ignored.
    scene(hash) {
        const name = hash.replace(/^#/, '');
        const [lesson, step = '1'] = name.split('/');
        if (Object.hasOwn(PRESETS, lesson)) return this.step(lesson, number(step));
        if (!name.includes('=')) return null;
        const given = new URLSearchParams(name);
        const named = given.get('system');
        const system = Object.hasOwn(SYSTEMS, named) ? named : 'pendulum';
        return this.changed(startOf(system), given);
    }

    // A scene with the values that are given.
    changed(before, given) {
        const scene = { ...before };
        const methods = (given.get('m') ?? '')
            .split(',')
            .filter((m, i, all) => this.known.includes(m) && all.indexOf(m) === i);
        if (methods.length) scene.methods = methods.slice(0, this.places);
        for (const key of keysOf(scene.system)) {
            const value = number(given.get(key)),
                { least, most } = SLIDERS[key];
            if (value >= least && value <= most) scene[key] = value;
        }
        const speed = number(given.get('speed'));
        if (SPEEDS.includes(speed)) scene.speed = speed;
        if (given.has('scale')) scene.scale = given.get('scale') === 'log' ? 'log' : 'linear';
        const until = number(given.get('until'));
        if (until >= 0 && until <= LONGEST) scene.until = until;
        const lesson = given.get('lesson'),
            step = number(given.get('step'));
        if (Object.hasOwn(PRESETS, lesson)) scene.lesson = lesson;
        if (isCount(step, this.lessons[scene.lesson]?.length ?? 1)) scene.step = step;
        const pinned = this.pinned(given.get('pin') ?? '');
        if (pinned) scene.pin = pinOf(pinned.scene, pinned.steps);
        return scene;
    }

    // The parts of an address, in words, of which nothing came into its scene: names that are none
    // and values that are not allowed.
    doubts(hash, more = []) {
        const name = hash.replace(/^#/, '');
        const [lesson, step = '1'] = name.split('/');
        const has = (lesson, step) => isCount(number(step), this.lessons[lesson]?.length ?? 1);
        if (Object.hasOwn(PRESETS, lesson)) return has(lesson, step) ? [] : ['the step'];
        const scene = this.scene(hash);
        // The address of a place on the page is none of the lab's.
        if (!scene) return !name || document.getElementById(name) ? [] : ['all of it'];
        const isMethod = (name, i, all) => this.known.includes(name) && all.indexOf(name) === i;
        const parts = {
            system: ['the system', text => Object.hasOwn(SYSTEMS, text)],
            m: [
                'the methods',
                text => text.split(',').every(isMethod) && text.split(',').length <= this.places,
            ],
            speed: ['the speed', text => SPEEDS.includes(number(text))],
            scale: ['the scale', text => ['linear', 'log'].includes(text)],
            until: ['the end', text => number(text) >= 0 && number(text) <= LONGEST],
            lesson: ['the lesson', text => Object.hasOwn(PRESETS, text)],
            step: ['the step', text => has(scene.lesson, text)],
            pin: [
                'the pinned run',
                text => Boolean(this.pinned(text)) && !this.doubts(text, ['steps']).length,
            ],
        };
        for (const key of keysOf(scene.system)) {
            const { label, least, most } = SLIDERS[key];
            parts[key] = [label, text => number(text) >= least && number(text) <= most];
        }
        const found = new Set();
        for (const [key, text] of new URLSearchParams(name)) {
            if (more.includes(key)) continue;
            const [words, fits] = Object.hasOwn(parts, key)
                ? parts[key]
                : [SLIDERS[key]?.label ?? 'a name that is none', () => false];
            if (!fits(text)) found.add(words);
        }
        return [...found];
    }

    // The scene and the steps of a pinned run, or null.
    pinned(text) {
        const steps = number(new URLSearchParams(text).get('steps'));
        const scene = isCount(steps, MOST_STEPS) && this.scene(text);
        return scene ? { scene, steps } : null;
    }

    // A step of a lesson: the first is its preset, and each other says what it changes of that,
    // and for how long (s) it goes on with the one before, to be compared with.
    step(lesson, step) {
        const scene = presetScene(lesson),
            steps = this.lessons[lesson] ?? [];
        if (!isCount(step, steps.length)) return scene;
        const at = this.changed(scene, new URLSearchParams(steps[step - 1].changes));
        const { compares } = steps[step - 1];
        if (compares && step > 1) {
            const before = this.step(lesson, step - 1);
            at.pin = pinOf(before, Math.round(compares / before.dt));
        }
        return { ...at, lesson, step };
    }
}
