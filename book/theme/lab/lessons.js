// The lessons of a lab: their words, which stand in the chapter, shown step by step beside the
// picture.
(theLab => {
    'use strict';

    const { PRESETS, button, element } = theLab;

    // The steps of each lesson in the page, by name: their words, what they change of the lesson's
    // scene, and for how long (s) they compare it with the step before.
    function lessonsOf(page) {
        const lessons = {};
        for (const list of page.querySelectorAll('.lesson-steps[data-lesson]')) {
            lessons[list.dataset.lesson] = [...list.children].map(words => ({
                words,
                changes: words.dataset.changes ?? '',
                compares: Number(words.dataset.compares ?? 0),
            }));
        }
        return lessons;
    }

    class Lessons {
        constructor(lab) {
            this.lab = lab;
            this.names = Object.keys(PRESETS);
            this.links = this.names.map(name =>
                element(
                    'a',
                    {
                        href: `#${name}`,
                        onclick: event => {
                            event.preventDefault();
                            lab.lesson(name, 1);
                        },
                    },
                    PRESETS[name].title,
                ),
            );
            this.nav = element('nav', { class: 'lessons', 'aria-label': 'Lessons' }, ...this.links);
            this.title = element('strong');
            this.where = element('span', { class: 'note' });
            // Said when the step changes, after what is being said.
            this.words = element('div', { class: 'words', 'aria-live': 'polite' });
            this.changed = element('p', { class: 'note changed' });
            this.back = button('back', 'Back', () => this.turn(-1));
            this.next = button('next', 'Next', () => this.turn(1));
            this.set = button('set', 'Set it again', () => {
                const { lesson, step } = lab.scene;
                lab.lesson(lesson, step);
            });
            this.beside = element(
                'section',
                { class: 'beside', 'aria-label': 'Lesson' },
                element('p', { class: 'title' }, this.title, this.where),
                this.words,
                element('div', { class: 'buttons' }, this.back, this.next, this.set),
                this.changed,
            );
        }

        // The step before or after the present one, across lessons; null beyond the ends.
        neighbour(by) {
            const { lesson, step } = this.lab.scene,
                steps = this.lab.lessons[lesson]?.length ?? 1;
            if (step + by >= 1 && step + by <= steps) return [lesson, step + by];
            const other = this.names[this.names.indexOf(lesson) + by];
            return other ? [other, by > 0 ? 1 : (this.lab.lessons[other]?.length ?? 1)] : null;
        }

        turn(by) {
            const to = this.neighbour(by);
            if (to) this.lab.lesson(...to);
        }

        // Shows the step of the scene.
        settle() {
            const { lab } = this,
                { lesson, step } = lab.scene,
                steps = lab.lessons[lesson] ?? [];
            this.links.forEach((link, i) => {
                if (this.names[i] === lesson) link.setAttribute('aria-current', 'true');
                else link.removeAttribute('aria-current');
            });
            const [before, after] = [this.neighbour(-1), this.neighbour(1)];
            // Kept in the order of the keyboard, so that the focus is not lost.
            this.back.setAttribute('aria-disabled', before === null);
            this.next.setAttribute('aria-disabled', after === null);
            this.next.textContent = after && after[0] !== lesson ? 'Next lesson' : 'Next';
            const off = !lab.isStep();
            this.set.hidden = !off;
            this.changed.hidden = !off;
            this.changed.textContent = off ? 'You have changed the scene of this step.' : '';
            const shown = `${lesson}/${step}`;
            if (this.shown === shown) return;
            this.shown = shown;
            this.title.textContent = PRESETS[lesson].title;
            this.where.textContent = `Step ${step} of ${Math.max(steps.length, 1)}`;
            const words = steps[step - 1]?.words.cloneNode(true);
            this.words.replaceChildren(...(words ? words.childNodes : []));
        }
    }

    Object.assign(theLab, { Lessons, lessonsOf });
})((globalThis.theLab ??= {}));
