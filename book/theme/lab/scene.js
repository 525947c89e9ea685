// The lab's scenes: the allowed values, the lessons, and how a scene is written in the page's
// address.
(theLab => {
    'use strict';

    const PAPERS = ['forward-euler', 'symplectic-euler', 'rk4', 'stormer-verlet'];
    // `until` is where the run stops (s), or zero for never.
    const SCENE = {
        methods: PAPERS,
        theta0: 1,
        omega0: 0,
        dt: 0.01,
        g: 9.81,
        L: 1,
        beta: 0,
        speed: 1,
        scale: 'linear',
        until: 0,
    };
    // The lessons of lab.md, by the ids of their headings, and the plot that a small lab in a
    // chapter shows.
    const PRESETS = {
        'over-the-top': {
            title: 'Forward Euler goes over the top',
            theta0: 1.5,
            dt: 0.03,
            shows: 'energy',
        },
        'kick-then-drift': {
            title: 'One letter apart',
            methods: ['forward-euler', 'symplectic-euler'],
            theta0: 2,
            dt: 0.05,
            shows: 'energy',
        },
        bounded: {
            title: 'Bounded, and how',
            methods: ['symplectic-euler', 'stormer-verlet'],
            theta0: 2,
            dt: 0.02,
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
            shows: 'energy',
        },
        'last-torus': {
            title: 'K = 0.97: the last torus',
            methods: ['symplectic-euler', 'stormer-verlet'],
            theta0: 3,
            dt: 0.314455,
            speed: 1000,
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
            shows: 'energy',
        },
    };
    // Label, unit, range and step of the slider, range of the typed value; the step Δt is
    // logarithmic.
    const SLIDERS = {
        dt: {
            label: 'Step Δt',
            unit: 's',
            from: -3,
            to: 0.2,
            by: 0.01,
            least: 1e-5,
            most: 3,
            logarithmic: true,
        },
        theta0: {
            label: 'Angle θ₀',
            unit: 'rad',
            from: -3.14,
            to: 3.14,
            by: 0.01,
            least: -100,
            most: 100,
        },
        omega0: {
            label: 'Velocity ω₀',
            unit: 'rad/s',
            from: -15,
            to: 15,
            by: 0.05,
            least: -1000,
            most: 1000,
        },
        g: {
            label: 'Gravity g',
            unit: 'm/s²',
            from: 0.1,
            to: 25,
            by: 0.01,
            least: 0.001,
            most: 1000,
        },
        L: { label: 'Length L', unit: 'm', from: 0.1, to: 5, by: 0.01, least: 0.001, most: 1000 },
        beta: { label: 'Damping β', unit: '1/s', from: 0, to: 2, by: 0.01, least: 0, most: 10 },
    };
    // The longest run (s): longer than any that the library takes.
    const LONGEST = 1e9;
    const SPEEDS = [0.1, 0.25, 1, 2, 10, 100, 1000];

    function presetScene(name) {
        const { title, shows, ...given } = PRESETS[name];
        return { ...SCENE, ...given };
    }

    function address(scene) {
        const parts = [`m=${scene.methods.join(',')}`];
        for (const key of Object.keys(SLIDERS)) parts.push(`${key}=${scene[key]}`);
        parts.push(`speed=${scene.speed}`, `scale=${scene.scale}`);
        if (scene.until) parts.push(`until=${scene.until}`);
        return parts.join('&');
    }

    // The number that a text says; NaN for none, also where there is only white space, which
    // JavaScript takes for zero. Its −0 would not outlive an address.
    function number(text) {
        return text?.trim() ? Number(text) + 0 : NaN;
    }

    // The scene of an address, or null if it has none, with known methods only and no more than
    // `places`. Values that it does not name are as in SCENE; invalid ones are ignored.
    function addressed(hash, known, places) {
        const name = hash.replace(/^#/, '');
        if (Object.hasOwn(PRESETS, name)) return presetScene(name);
        if (!name.includes('=')) return null;
        const given = new URLSearchParams(name);
        const scene = { ...SCENE };
        const methods = (given.get('m') ?? '')
            .split(',')
            .filter((m, i, all) => known.includes(m) && all.indexOf(m) === i);
        if (methods.length) scene.methods = methods.slice(0, places);
        for (const [key, { least, most }] of Object.entries(SLIDERS)) {
            const value = number(given.get(key));
            if (value >= least && value <= most) scene[key] = value;
        }
        const speed = number(given.get('speed'));
        if (SPEEDS.includes(speed)) scene.speed = speed;
        if (given.get('scale') === 'log') scene.scale = 'log';
        const until = number(given.get('until'));
        if (until > 0 && until <= LONGEST) scene.until = until;
        return scene;
    }

    Object.assign(theLab, {
        LONGEST,
        PAPERS,
        PRESETS,
        SLIDERS,
        SPEEDS,
        address,
        addressed,
        presetScene,
    });
})((globalThis.theLab ??= {}));
