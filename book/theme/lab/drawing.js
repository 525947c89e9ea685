// What a lab draws: pendulums, the phase portrait, and the errors over time.
(theLab => {
    'use strict';

    const { Plot, Portrait, Stage, conserves, isClosed, look } = theLab;

    class Drawing {
        constructor(lab) {
            this.lab = lab;
            this.stage = new Stage(lab);
            this.phase = new Portrait(lab);
            this.energy = new Plot(lab, pendulum => pendulum.energy);
            this.angle = new Plot(lab, pendulum => pendulum.angle);
        }

        colours() {
            const style = getComputedStyle(document.documentElement);
            const value = name => style.getPropertyValue(name).trim();
            this.ink = value('--fg') || '#000';
            this.paper = value('--bg') || '#fff';
            this.looks = new Map(
                this.lab.known.map(method => {
                    const { colour, marker, dash } = look(method);
                    return [
                        method.number,
                        { colour: value(colour), path: new Path2D(marker), dash },
                    ];
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
                    sheet === phase &&
                    lab.whole &&
                    isClosed(lab.scene) &&
                    own < 0.6 * stage.width;
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
            for (const [sheet, words] of [
                [
                    this.stage,
                    `Pendulums side by side: ${names}. ` +
                        (exact ? 'A ring on a dashed rod is the exact one. ' : '') +
                        'Drag a bob to set its angle.',
                ],
                [
                    this.phase,
                    `Phase portrait of ${names}` +
                        (exact ? ', over exact orbit and separatrix. ' : '. ') +
                        'Drag to set θ₀ and ω₀; arrow keys read it out.',
                ],
                [this.energy, `${energy} over time of ${names}; arrow keys read it out.`],
                [
                    this.angle,
                    `Angle error against the closed form, of ${names}; arrow keys read it out.`,
                ],
            ])
                sheet.canvas.setAttribute('aria-label', words);
        }
    }

    theLab.Drawing = Drawing;
})((globalThis.theLab ??= {}));
