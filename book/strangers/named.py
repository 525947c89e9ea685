"""Holds the integrators of strangers.toml against the known answers of the judge.

    book/strangers/run --named

Each is asked for the scenes of the file, through its adapter, and compared with every method and
every mistake. `named` in strangers.toml is the method that its documentation says it is, by its
name in the file: several, where the documentation can mean either. `precision = "single"` says
that the documentation says so. The protocol begins at t = 0, and with one state: scenes that
begin later are left out, and methods of several steps begin in their own way.
"""

import collections
import concurrent.futures
import decimal
import json
import os
import re
import subprocess
import sys
import tomllib
from decimal import Decimal

# Seconds for all answers of an integrator.
LIMIT = 240
EPSILON = {"double": Decimal(2) ** -52, "single": Decimal(2) ** -23}
DRIVEN = "driven"
# No two entries of the file are nearer than ten tolerances: up to five there is one name at most.
NEARLY = 5
# How far an integrator is from an answer: in ε, and in tolerances.
Distance = collections.namedtuple("Distance", "scene steps epsilons tolerances")

decimal.getcontext().prec = 40


class Answers:
    """The file of known answers."""

    def __init__(self, root):
        known = json.loads((root / "book/judge/known-answers/known-answers.json").read_text())
        self.scenes = {n: s for n, s in known["scenes"].items() if s["t"] == "0"}
        self.entries = {e["name"]: e for e in known["methods"] + known["mistakes"]}
        tables = root / "book/judge/known-answers/tables/multistep.toml"
        several = tomllib.loads(tables.read_text())["method"]
        self.of_several_steps = {table["name"] for table in several}
        self.steps = dict.fromkeys(self.scenes, 0)
        for entry in self.entries.values():
            for a in entry["answers"]:
                if a["scene"] in self.steps:
                    self.steps[a["scene"]] = max(self.steps[a["scene"]], a["steps"])

    def request(self, name):
        s, n = self.scenes[name], self.steps[name]
        drive = [s["amplitude"], s["frequency"]] if s["amplitude"] != "0" else []
        words = [DRIVEN if drive else "pendulum", s["g_over_l"], *drive]
        return " ".join([*words, s["theta"], s["omega"], s["h"], str(n), "1"])

    def distances(self, name, states, epsilon):
        """From the entry of that name, in every scene that both have."""
        for a in self.entries[name]["answers"]:
            if a["scene"] in states:
                right = Decimal(a["theta"]), Decimal(a["omega"])
                said = states[a["scene"]][a["steps"] - 1]
                size = epsilon * max(map(abs, right))
                far = max(abs(x - y) for x, y in zip(said, right)) / size
                # A number that is none is nowhere.
                far = far if far.is_finite() else Decimal("Infinity")
                yield Distance(a["scene"], a["steps"], far, far / Decimal(a["tolerance"]))


def ask(answers, library, integrator, work, found):
    """The states of an integrator by scene; those that it does not answer are missing."""
    name = re.sub(r"[^\w.+-]+", "_", f"{library['name']}-{library['version']}-{integrator['name']}")
    kept = found / f"{name}.txt"
    lines = "\n".join(["hello 1", *map(answers.request, answers.scenes), "bye", ""])
    # What was said is kept below what was asked.
    if not kept.exists() or not kept.read_text().startswith(lines):
        command = [*library["run"], integrator["name"]]
        try:
            said = subprocess.run(command, cwd=work, input=lines, capture_output=True, text=True,
                                  timeout=LIMIT).stdout
        except subprocess.TimeoutExpired as late:
            said = (late.stdout or b"").decode()
        kept.write_text(lines + said)
        print(library["name"], integrator["name"], file=sys.stderr)
    replies, states = [[]], {}
    for line in kept.read_text().removeprefix(lines).splitlines()[1:]:
        if line.split()[0] in ("done", "unsupported", "error"):
            replies.append([])
        else:
            replies[-1].append(tuple(map(Decimal, line.split())))
    for scene, reply in zip(answers.scenes, replies):
        if len(reply) == answers.steps[scene]:
            states[scene] = reply
    return states


def told(d):
    number = f"{d.epsilons:.1f}" if d.epsilons < 1000 else f"{d.epsilons:.0e}".replace("+", "")
    parts = f"{d.tolerances:.2f}" if d.tolerances < 100 else f"{d.tolerances:.0e}".replace("+", "")
    return f"{number} ε, {parts} of the tolerance: {d.scene} {d.steps}"


def row(answers, library, integrator, states):
    """A row of the table, and the verdict."""
    epsilon = EPSILON[integrator.get("precision", "double")]
    far = {name: list(answers.distances(name, states, epsilon)) for name in answers.entries}
    worst = {n: max(d, key=lambda x: x.tolerances) for n, d in far.items() if d}
    found = [n for n, d in worst.items() if d.tolerances <= 1]
    nearly = [f"nearly {n}" for n, d in worst.items() if 1 < d.tolerances <= NEARLY]
    at_rest = {n: [x for x in d if x.scene != DRIVEN] for n, d in far.items()}
    undriven = [f"{n} without drive" for n, d in at_rest.items()
                if d and max(x.tolerances for x in d) <= 1]
    named = integrator.get("named", "").split()
    # In single precision a small mistake is as near as its method.
    found = [n for n in found if n in named] or found
    what = ", ".join(found or nearly or undriven) or "–"
    verdict, distance = "–", ", ".join(told(worst[n]) for n in found) or "–"
    if not states:
        verdict = "no answer"
    elif named and set(named) <= answers.of_several_steps:
        verdict = "begins in its own way"
    elif named:
        nearest = min((worst[n] for n in named), key=lambda x: x.tolerances)
        verdict = "within" if nearest.tolerances <= 1 else "outside"
        distance = told(nearest)
    why = integrator.get("outside", "")
    return [library["name"], f"`{integrator['name']}`", " or ".join(named) or "–", verdict,
            distance, what, why]


def rows(libraries, root, work, found):
    answers = Answers(root)
    libraries = sorted(libraries, key=lambda library: library["name"].lower())
    jobs = [(library, integrator) for library in libraries for integrator in library["integrator"]]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        states = pool.map(lambda job: ask(answers, *job, work, found), jobs)
        return [row(answers, *job, s) for job, s in zip(jobs, states)]
