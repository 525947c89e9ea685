// What a lab draws: pendulums as they hang, the phase portrait, and the errors over time.
'use strict';

// Space below a pendulum for its name (px).
const NAME = 20;
// A trail is what a bob did in the last so many seconds of the reader, at most so many points.
const TRAIL_SECONDS = 0.7;
const TRAIL_POINTS = 240;

// Whether a scene's energy is that of one bob on a pivot at rest.
const hasBars = ({ system }) => system === 'pendulum' || system === 'driven';

class Stage extends Sheet {
    constructor(lab) {
        super();
        this.lab = lab;
        this.trails = this.bars = false;
    }

    // As wide as there is room for.
    layout(width) {
        const n = this.lab.pendulums.length || 1;
        this.down = Math.ceil(n / Math.max(1, Math.floor(width / 100)));
        this.across = Math.ceil(n / this.down);
        this.cell = Math.min(width / this.across, this.lab.whole || this.lab.hero ? 230 : 190);
        this.fit(width, this.down * (this.cell + NAME));
    }

    // The pivot of the i-th pendulum and the length of its rod (px).
    pivot(i) {
        const left = (this.width - this.across * this.cell) / 2;
        const { L, system, a, Omega } = this.lab.scene;
        // Grows with L, but not in proportion: the shortest rod must leave a bob to grasp.
        const reach = this.cell * (0.3 + (0.11 * L) / (L + 1));
        const rod = system === 'double' ? reach / 2 : reach;
        // A shaken pivot moves on the scale of its rod, and not out of the picture.
        const lift =
            system === 'shaken'
                ? Math.min((rod * a) / L, 0.2 * rod) * Math.cos(Omega * this.lab.time)
                : 0;
        return {
            x: left + ((i % this.across) + 0.5) * this.cell,
            y: Math.floor(i / this.across) * (this.cell + NAME) + this.cell / 2 - lift,
            rod,
            lift,
        };
    }

    // Where bobs at these angles are, the upper first.
    bobs({ x, y, rod }, theta, lower) {
        const first = [x + rod * Math.sin(theta), y + rod * Math.cos(theta)];
        if (Number.isNaN(lower)) return [first];
        return [first, [first[0] + rod * Math.sin(lower), first[1] + rod * Math.cos(lower)]];
    }

    draw() {
        const { lab, ink } = this;
        this.clear();
        lab.pendulums.forEach((pendulum, i) => {
            const pivot = this.pivot(i),
                { x, y, rod, lift } = pivot,
                { path, colour } = lab.drawing.looks.get(pendulum.method.number);
            const lower = pendulum.read(LOWER_THETA);
            ink.globalAlpha = 0.35;
            ink.strokeStyle = lab.drawing.ink;
            ink.lineWidth = 1;
            ring(ink, x, y, Number.isNaN(lower) ? rod : 2 * rod);
            ink.globalAlpha = 1;
            if (this.trails) this.trail(pendulum, pivot, colour);
            if (Number.isFinite(lab.exact)) {
                const [exact] = this.bobs(pivot, lab.exact, NaN);
                ink.strokeStyle = lab.drawing.ink;
                ink.lineWidth = 1;
                ink.setLineDash([3, 3]);
                line(ink, [[x, y], exact]);
                ink.setLineDash([]);
                ring(ink, ...exact, 6 * this.size());
            }
            const bobs = this.bobs(pivot, pendulum.read(THETA), lower);
            ink.lineWidth = 2;
            ink.strokeStyle = colour;
            line(ink, [[x, y], ...bobs]);
            for (const [bx, by] of bobs) mark(ink, path, bx, by, this.size(), colour);
            if (!lab.grasped) this.sign(pivot, bobs.at(-1));
            if (this.bars && hasBars(lab.scene)) this.energies(pendulum, pivot, colour);
            ink.fillStyle = lab.drawing.ink;
            ink.beginPath();
            ink.arc(x, y, 2.5, 0, TURN);
            ink.fill();
            const below = y + lift + this.cell / 2 + 12;
            const { title } = pendulum.method;
            write(ink, title, x, below, 'center', 'alphabetic', this.cell - 4);
        });
    }

    // Of a bob, so that it can be taken: its marker as a multiple of the smallest.
    size() {
        return Math.min(Math.max(this.cell / 75, 1.7), 2.6);
    }

    // Two heads of arrows beside a bob that nobody has taken yet: it can be moved.
    sign({ x, y }, [bx, by]) {
        const { ink } = this;
        const angle = Math.atan2(bx - x, by - y),
            away = 9 * this.size();
        ink.save();
        ink.translate(bx, by);
        ink.rotate(-angle);
        ink.strokeStyle = this.lab.drawing.ink;
        ink.lineWidth = 2;
        for (const side of [-1, 1])
            line(ink, [
                [side * away, -5],
                [side * (away + 5), 0],
                [side * away, 5],
            ]);
        ink.restore();
    }

    // The potential energy with the kinetic on top, beside the pendulum, and a line where the sum
    // was at the start. What does not fit ends in an arrow.
    energies(pendulum, pivot, colour) {
        const { ink, cell, lab } = this;
        const { g, L, theta0, omega0 } = lab.scene;
        const parts = (theta, omega) => [g * L * (1 - Math.cos(theta)), (L * omega) ** 2 / 2];
        const [potential, kinetic] = parts(pendulum.read(THETA), pendulum.read(OMEGA));
        const start = parts(theta0, omega0).reduce((a, b) => a + b);
        const height = 0.72 * cell,
            full = 1.15 * Math.max(2 * g * L, start);
        const left = pivot.x + cell / 2 - 16,
            bottom = pivot.y + pivot.lift + height / 2,
            y = energy => bottom - (Math.min(energy, full) / full) * height;
        if (!Number.isFinite(potential + kinetic)) return;
        ink.fillStyle = colour;
        ink.globalAlpha = 0.45;
        ink.fillRect(left, y(potential), 11, bottom - y(potential));
        ink.globalAlpha = 1;
        ink.fillRect(left, y(potential + kinetic), 11, y(potential) - y(potential + kinetic));
        ink.fillStyle = lab.drawing.ink;
        ink.fillRect(left - 3, y(start) - 1, 17, 2);
        if (potential + kinetic > full)
            write(ink, '▲', left + 5.5, bottom - height - 12, 'center');
    }

    // What the last bob did before, fading.
    trail(pendulum, pivot, colour) {
        const { lab, ink } = this;
        const since = lab.taken - (TRAIL_SECONDS * lab.scene.speed) / lab.scene.dt;
        const from = Math.max(pendulum.oldest, pendulum.points - TRAIL_POINTS);
        ink.strokeStyle = colour;
        ink.lineWidth = 3;
        let before = null;
        for (let k = from; k < pendulum.points; k++) {
            const { steps, theta, lower } = pendulum.point(k);
            if (steps < since) continue;
            const at = this.bobs(pivot, theta, lower).at(-1);
            ink.globalAlpha = (0.6 * (steps - since)) / Math.max(lab.taken - since, 1);
            line(ink, before ? [before, at] : [at]);
            before = at;
        }
        ink.globalAlpha = 1;
    }
}

class Drawing {
    constructor(lab) {
        this.lab = lab;
        this.stage = new Stage(lab);
        this.phase = new Portrait(lab);
        const { energyScale } = Plot;
        this.energy = new Plot(lab, pendulum => pendulum.energy, 'J', energyScale);
        this.angle = new Plot(lab, pendulum => pendulum.angle, 'rad', () => TURN);
    }

    // What a custom property stands for on the page, which a canvas does not know by its name.
    value(name) {
        return getComputedStyle(this.lab.spot).getPropertyValue(name).trim();
    }

    colours() {
        this.ink = this.value('--fg') || '#000';
        this.paper = this.value('--bg') || '#fff';
        // Those of the scene first.
        const { known, scene } = this.lab;
        const place = ({ name }) => (scene.methods.indexOf(name) + 1 || Infinity);
        const sorted = [...known].sort((a, b) => (place(a) > place(b)) - (place(a) < place(b)));
        const looks = looksOf(sorted);
        this.looks = new Map(
            sorted.map(({ number }, i) => {
                const { colour, marker, dash } = looks[i];
                const [css, path] = [this.value(colour), new Path2D(marker)];
                return [number, { colour: css, name: colour, path, dash }];
            }),
        );
    }

    // Sets the sizes from the available width and redraws everything.
    layout() {
        this.colours();
        const { lab, stage, phase } = this;
        const width = sheet => sheet.canvas.parentElement?.clientWidth ?? 0;
        stage.layout(width(stage));
        for (const sheet of [phase, this.energy, this.angle].filter(
            sheet => sheet.canvas.isConnected,
        )) {
            const own = width(sheet);
            const height = Math.round(Math.min(Math.max(own * 0.62, 200), 300));
            // Beside the two plots it is as high as both.
            const tall =
                sheet === phase && lab.whole && isClosed(lab.scene) && own < 0.6 * stage.width;
            if (own) sheet.fit(own, tall ? 2 * height - 12 : height);
        }
        // During a drag the axis keeps its scale; otherwise the point under the pointer would
        // run away.
        if (!lab.held) phase.reach = 0;
        phase.base();
        this.all();
    }

    all() {
        this.stage.draw();
        this.phase.draw();
        this.plots();
    }

    plots() {
        const { scene } = this.lab;
        this.energy.draw(conserves(scene) ? 'energy error (J)' : 'energy (J)');
        if (isClosed(scene)) this.angle.draw('angle error (rad)');
    }

    // Text alternatives for the drawings.
    describe() {
        const { scene, pendulums } = this.lab,
            names = pendulums.map(pendulum => pendulum.method.title).join(', ');
        const energy = conserves(scene) ? 'Energy error' : 'Energy';
        const exact = isClosed(scene);
        const ring = exact ? 'The ring on a dashed rod is the exact motion. ' : '';
        const over = exact ? ', with the exact orbit and the separatrix' : '';
        const keys = 'the arrow keys read it out.';
        const say = ({ canvas }, words) => {
            canvas.ariaLabel = words;
        };
        say(this.stage, `Pendulums side by side: ${names}. ${ring}Drag one to set its angle.`);
        say(this.phase, `Phase portrait of ${names}${over}. Drag to set the start; ${keys}`);
        say(this.energy, `${energy} of ${names} over time; ${keys}`);
        say(this.angle, `Angle error of ${names} against the closed form; ${keys}`);
    }
}
