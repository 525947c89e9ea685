// Phase space as a drawing that can be moved: axes, curves, markers, arrows and a handle, in the
// look of the book's figures. Lengths are in units of the figure, which is 600 of them wide.
'use strict';

// The half of a touch target (CSS px), and the head of an arrow.
const TARGET = 22;
const HEAD = 14;
const TRUE_POINT = 'm-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z';

// Words with what stands _{below the line} set so.
function words(text, attributes) {
    const parts = text.split(/_\{(.+?)\}/);
    const made = drawn('text', attributes);
    parts.forEach((part, i) => {
        if (i % 2) made.append(drawn('tspan', { dy: 4, 'font-size': '72%' }, part));
        else if (part) made.append(i ? drawn('tspan', { dy: -4 }, part) : part);
    });
    return made;
}

// The class that gives a method its colour, or the text's colour for no method.
const colour = method => (method ? look(method).colour.replace('--pendula-', '') : '');

const short = number => Math.round(number * 10) / 10;

// The ticks of an axis, at most about seven, at round numbers.
function ticks(from, to) {
    const every = roundUp((to - from) / 7.5);
    const first = Math.ceil(from / every - 1e-9),
        last = Math.floor(to / every + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * every);
}

class Plane {
    // `box` is the frame [left, top, right, bottom] on the drawing, `theta` and `omega` are the
    // ends of the axes; `name` is for the ids, one for each plane of a page; `named` says which
    // axes have their names.
    constructor(svg, name, box, { theta, omega }, named = { theta: true, omega: true }) {
        const [left, top, right, bottom] = box;
        Object.assign(this, { svg, left, top, right, bottom, name });
        this.clip = drawn('rect', {
            x: left - 2,
            y: top - 2,
            width: right - left + 4,
            height: bottom - top + 4,
        });
        this.axes = drawn('g');
        this.curves = drawn('g', { 'clip-path': `url(#${name}-clip)` });
        this.labels = drawn('g');
        svg.append(
            drawn('clipPath', { id: `${name}-clip` }, this.clip),
            this.axes,
            this.curves,
            this.labels,
        );
        if (named.omega) svg.append(words('ω (rad/s)', { x: left - 38, y: top - 17 }));
        if (named.theta) {
            const middle = { x: (left + right) / 2, 'text-anchor': 'middle' };
            svg.append(words('θ (rad)', { ...middle, y: bottom + 44 }));
        }
        this.frame(theta, omega);
    }

    // Sets the ends of the axes.
    frame(theta, omega) {
        Object.assign(this, { theta, omega });
        const { left, top, right, bottom } = this;
        let grid = '',
            axis = `M${left},${top}V${bottom}H${right}`;
        const numbers = [];
        for (const value of ticks(...theta)) {
            const x = short(this.x(value));
            grid += `M${x},${top}V${bottom}`;
            axis += `M${x},${bottom}v6`;
            numbers.push(words(tick(value), { x, y: bottom + 22, 'text-anchor': 'middle' }));
        }
        for (const value of ticks(...omega)) {
            const y = short(this.y(value));
            grid += `M${left},${y}H${right}`;
            axis += `M${left},${y}h-6`;
            numbers.push(words(tick(value), { x: left - 9, y: y + 6, 'text-anchor': 'end' }));
        }
        this.axes.replaceChildren(
            drawn('path', { class: 'grid', d: grid }),
            drawn('path', { class: 'axis', d: axis }),
            ...numbers,
        );
    }

    x(theta) {
        const [from, to] = this.theta;
        return this.left + ((theta - from) / (to - from)) * (this.right - this.left);
    }

    y(omega) {
        const [from, to] = this.omega;
        return this.bottom - ((omega - from) / (to - from)) * (this.bottom - this.top);
    }

    // The angle and the velocity at a point of the drawing, within the axes.
    at(x, y) {
        const within = (share, [from, to]) => from + Math.min(Math.max(share, 0), 1) * (to - from);
        return [
            within((x - this.left) / (this.right - this.left), this.theta),
            within((this.bottom - y) / (this.bottom - this.top), this.omega),
        ];
    }

    // Pairs of θ and ω as a path, broken where there are none.
    path(points, closed = false) {
        let d = '',
            pen = 'M';
        for (let i = 0; i < points.length; i += 2) {
            const x = this.x(points[i]),
                y = this.y(points[i + 1]);
            // Far outside the frame a browser's own arithmetic gives out.
            if (Math.abs(x) + Math.abs(y) < 1e6) {
                d += `${pen}${short(x)},${short(y)}`;
                pen = 'L';
            } else pen = 'M';
        }
        return d && closed ? `${d}z` : d;
    }

    clear() {
        this.curves.replaceChildren();
        this.labels.replaceChildren();
    }

    curve(points, { method = null, dash = '', filled = false, thin = false } = {}) {
        const classes = ['line', colour(method), filled && 'fill', thin && 'thin'];
        const d = this.path(points, filled);
        if (!d) return;
        this.curves.append(
            drawn('path', {
                class: classes.filter(Boolean).join(' '),
                'stroke-dasharray': dash,
                d,
            }),
        );
    }

    // A marker at each point: the method's, or the circle of the true motion.
    markers(points, method = null, clipped = true) {
        const shape = method ? look(method).marker : TRUE_POINT;
        let d = '';
        for (let i = 0; i < points.length; i += 2) {
            const x = this.x(points[i]),
                y = this.y(points[i + 1]);
            if (Math.abs(x) + Math.abs(y) < 1e6) d += `M${short(x)},${short(y)}${shape}`;
        }
        const made = drawn('path', { class: `dot ${colour(method)}`, d });
        (clipped ? this.curves : this.labels).append(made);
        return made;
    }

    // An arrow with its name beside its middle, or, if that is `low`, below a point `along` it; or
    // `ahead` of its tip.
    arrow([theta, omega], [theta1, omega1], method, name, how = {}) {
        const { taken = -Infinity, along = 0.5, bold = false, low = false, ahead = false } = how;
        const [x, y, x1, y1] = [this.x(theta), this.y(omega), this.x(theta1), this.y(omega1)];
        const length = Math.hypot(x1 - x, y1 - y);
        if (!(length < 1e6)) return;
        const [ux, uy] = length > 0 ? [(x1 - x) / length, (y1 - y) / length] : [0, 0];
        const head = Math.min(HEAD, length),
            wide = 0.36 * head;
        const [bx, by] = [x1 - ux * head, y1 - uy * head];
        this.curves.append(
            drawn('path', {
                class: `line ${bold ? 'bold ' : ''}${colour(method)}`,
                d: `M${short(x)},${short(y)}L${short(bx)},${short(by)}`,
            }),
            drawn('path', {
                class: `dot ${colour(method)}`,
                d:
                    `M${short(x1)},${short(y1)}` +
                    `L${short(bx - uy * wide)},${short(by + ux * wide)}` +
                    `L${short(bx + uy * wide)},${short(by - ux * wide)}z`,
            }),
        );
        const place = (value, from, to) => Math.min(Math.max(value, from), to);
        const at = [x + along * (x1 - x), y + along * (y1 - y)];
        const inside =
            at[0] > this.left && at[0] < this.right && at[1] > this.top && at[1] < this.bottom;
        // One that is short, or outside the frame, has no name.
        if (!inside || length < 1.5 * HEAD) return;
        const note = (dx, dy, anchor) => {
            const [y, from, to] = [at[1] + dy, this.top + 16, this.bottom - 6];
            this.note(at[0] + dx, place(y, from, to), name, anchor);
        };
        if (ahead) return note(18 * ux, 18 * uy + 6, 'middle');
        if (low) {
            const side = Math.sign(ux) || 1,
                [dx, dy] = [-side * uy, side * ux];
            return note(9 * dx, 6 + 16 * dy, dx > 0.2 ? 'start' : dx < -0.2 ? 'end' : 'middle');
        }
        // Beside an upright arrow, on the left where there is room and the right is `taken`,
        // and above one that goes across.
        if (Math.abs(uy) <= 0.7) return note(0, -9, 'middle');
        const left = this.x(taken) > at[0] && at[0] > this.left + 80;
        note(left ? -10 : 10, 5, left ? 'end' : 'start');
    }

    note(x, y, text, anchor = 'start') {
        const half = anchor === 'middle' ? 50 : 0;
        const inside = Math.min(Math.max(x, this.left + 4 + half), this.right - 50);
        this.labels.append(
            words(text, {
                class: 'halo',
                x: short(inside),
                y: short(y),
                'text-anchor': anchor,
            }),
        );
    }
}

// A point that is dragged, or moved by the arrow keys; `moved(θ, ω)` is told where to, and
// `by` is how far a key moves it. A touch elsewhere scrolls the page.
function handle(plane, name, by, moved) {
    const finger = drawn('circle', { class: 'finger', r: TARGET });
    const ring = drawn('circle', { class: 'ring', r: 11 });
    const knob = drawn(
        'g',
        {
            class: 'handle',
            tabindex: 0,
            role: 'slider',
            'aria-label': name,
        },
        finger,
        ring,
    );
    let here = [0, 0];
    const clamp = ([theta, omega]) => plane.at(plane.x(theta), plane.y(omega));
    const KEYS = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowDown: [0, -1],
        ArrowUp: [0, 1],
    };
    knob.addEventListener('keydown', event => {
        const way = KEYS[event.key];
        if (!way || event.altKey || event.ctrlKey || event.metaKey) return;
        // The book turns its page at these keys.
        event.preventDefault();
        event.stopPropagation();
        const part = event.shiftKey ? 0.1 : 1;
        moved(...clamp(here.map((value, i) => value + part * way[i] * by[i])));
    });
    const seen = event => {
        const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(
            plane.svg.getScreenCTM().inverse(),
        );
        return [x, y];
    };
    draggable(
        knob,
        point => {
            const [x, y] = seen(point);
            // Where it is taken hold of, it stays under the hand.
            return [plane.x(here[0]) - x, plane.y(here[1]) - y];
        },
        (held, point) => {
            const [x, y] = seen(point);
            moved(...plane.at(x + held[0], y + held[1]));
        },
    );
    plane.svg.append(knob);
    return {
        // Puts it at a point, which is put into words for those who do not see it.
        put(theta, omega, text) {
            here = [theta, omega];
            const { a: scale } = plane.svg.getScreenCTM() ?? { a: 1 };
            finger.setAttribute('r', TARGET / scale);
            const [x, y] = [short(plane.x(theta)), short(plane.y(omega))];
            knob.setAttribute('transform', `translate(${x},${y})`);
            knob.setAttribute('aria-valuemin', plane.theta[0]);
            knob.setAttribute('aria-valuemax', plane.theta[1]);
            knob.setAttribute('aria-valuenow', theta);
            knob.setAttribute('aria-valuetext', text);
        },
    };
}
