// A canvas to draw on, and what the lab's drawings have in common: the colour, marker and dash of a
// method.
'use strict';

// As in the figures: a method's colour, marker and dash follow from its place in a list, and the
// first four have a colour for themselves. Tests in book/charts/src/style.rs and
// book/study/src/report/figures check that both agree.
const COLOURS = [
    'vermilion',
    'blue',
    'green',
    'purple',
    'indigo',
    'ochre',
    'sky',
    'brown',
    'olive',
    'slate',
];
const OWN_COLOURS = 4;
const STYLED = `
    forward-euler symplectic-euler rk4 stormer-verlet
    blanes-moan-6 taylor-24 processed-6 deuflhard gauss-16 processed-4
    blanes-moan-srkn-6b dop853 explicit-midpoint forest-ruth gauss-6 implicit-midpoint
    yoshida-6 dormand-prince heun suzuki-4 gauss-4 trapezoidal
    yoshida-8 ruth-3 position-verlet kahan-li-8 discrete-gradient cieslinski-ratkiewicz
`
    .trim()
    .split(/\s+/);
const MARKERS = [
    'm-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z',
    'm-4.6,-4.6h9.2v9.2h-9.2z',
    'm0,-6.4l6.4,6.4 -6.4,6.4 -6.4,-6.4z',
    'm0,-6.4l6,10.4h-12z',
    'm-2,-6h4v4h4v4h-4v4h-4v-4h-4v-4h4z',
    'm0,-2.6l3.4,-3.4 2.6,2.6 -3.4,3.4 3.4,3.4 -2.6,2.6 -3.4,-3.4 -3.4,3.4 -2.6,-2.6 3.4,-3.4 -3.4,-3.4 2.6,-2.6z',
    'm0,6.4l6,-10.4h-12z',
    'm-5.4,-5.4h10.8l-10.8,10.8h10.8z',
];
const DASHES = [[], [14, 5], [14, 4, 2, 4], [7, 4]];
const FONT = '13px "Open Sans", system-ui, sans-serif';
const TURN = 2 * Math.PI;

// A canvas at the resolution of the screen, drawn in CSS pixels.
class Sheet {
    constructor() {
        this.canvas = document.createElement('canvas');
        this.canvas.setAttribute('role', 'img');
        this.width = this.height = 0;
        this.ink = this.canvas.getContext('2d');
    }

    fit(width, height) {
        const scale = Math.min(devicePixelRatio || 1, 2);
        const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
        if (this.canvas.width !== w || this.canvas.height !== h) {
            Object.assign(this.canvas, { width: w, height: h });
            this.canvas.style.height = `${height}px`;
        }
        Object.assign(this, { width, height, scale });
        this.ink.setTransform(scale, 0, 0, scale, 0, 0);
    }

    clear() {
        this.ink.clearRect(0, 0, this.width, this.height);
    }
}

// A marker; hollow, it shows what is below.
function mark(ink, path, x, y, size, colour, hollow = false) {
    ink.save();
    ink.translate(x, y);
    ink.scale(size, size);
    ink.fillStyle = ink.strokeStyle = colour;
    ink.lineWidth = 2 / size;
    if (hollow) ink.stroke(path);
    else ink.fill(path);
    ink.restore();
}

// A line through points, and a circle.
function line(ink, points) {
    ink.beginPath();
    for (const [x, y] of points) ink.lineTo(x, y);
    ink.stroke();
}

function ring(ink, x, y, radius) {
    ink.beginPath();
    ink.arc(x, y, radius, 0, TURN);
    ink.stroke();
}

function write(ink, words, x, y, align, baseline = 'top', width = undefined) {
    Object.assign(ink, { font: FONT, textAlign: align, textBaseline: baseline });
    ink.fillText(words, x, y, width);
}

// A frame, with a mark below its left, its middle and its right, and what they measure.
function axis(ink, { left, right, top, bottom }, marks, name) {
    const middle = (left + right) / 2;
    ink.lineWidth = 1;
    ink.strokeRect(left, top, right - left, bottom - top);
    write(ink, marks[0], left, bottom + 4, 'left');
    write(ink, marks[1], middle, bottom + 4, 'center');
    write(ink, marks[2], right, bottom + 4, 'right');
    write(ink, name, middle, bottom + 17, 'center');
}

// Draws what of it is within a frame.
function within(ink, { left, right, top, bottom }, draw) {
    ink.save();
    ink.beginPath();
    ink.rect(left, top, right - left, bottom - top);
    ink.clip();
    draw();
    ink.restore();
}

// The colour, the marker and the dash of a method; of one that is not in the list by its number.
function look({ name, number }) {
    const place = STYLED.indexOf(name),
        index = place < 0 ? STYLED.length + number : place;
    const shared = COLOURS.length - OWN_COLOURS;
    const hue = index < OWN_COLOURS ? index : OWN_COLOURS + ((index - OWN_COLOURS) % shared);
    return {
        hue,
        colour: `--pendula-${COLOURS[hue]}`,
        marker: MARKERS[index % MARKERS.length],
        dash: DASHES[index % DASHES.length],
    };
}

// The looks of some methods, of which no two have the same colour as long as there are others: the
// first has its own.
function looksOf(methods) {
    const free = new Set(COLOURS.slice(OWN_COLOURS));
    return methods.map(method => {
        const own = look(method);
        if (own.hue < OWN_COLOURS) return own;
        const [next = COLOURS[own.hue]] = free;
        const colour = free.has(COLOURS[own.hue]) ? COLOURS[own.hue] : next;
        free.delete(colour);
        return { ...own, colour: `--pendula-${colour}` };
    });
}
