"""Writes known-answers.json: python3 generate.py"""

import json
import math
import pathlib
import time
import tomllib

import mpmath
import numpy

import coefficients
import tables
from arithmetic import Digits, Rough, Spread, mpf
from steps import Method, Pendulum, combination, taylor

OUTPUT = pathlib.Path(__file__).with_name("known-answers.json")
SHOWN = 25
MARGIN = 2
LEAST = 4
# Decimals of the answers to wrong equations.
DECIMALS = 13
ORDERS_OF_OPERATIONS = [Spread(False, False), Spread(True, True)]

SCENES = tomllib.loads((tables.HERE / "tables" / "scenes.toml").read_text())
AT_REST = {"g_over_l": "1", "amplitude": "0", "frequency": "0"}
# After how many steps the answers are.
STEPS = {name: scene.pop("steps") for name, scene in SCENES.items()}
WHOLE = {name: AT_REST | scene for name, scene in SCENES.items()}
# What a mistake does not take over from its method.
OF_METHODS = ("also", "order", "keeps", "source", "digits")
FIELDS = "name of also what effect seen equation order keeps same_as digits source note".split()


def inputs(name, before=0):
    """The numbers of a scene, and of so many exact states before it."""
    scene = {key: mpf(value) for key, value in WHOLE[name].items()}
    scene["before"] = exact_before(scene, before)
    return scene


def exact_before(scene, count):
    states, (q, p) = [], (scene["theta"], scene["omega"])
    system = Pendulum(Digits, scene)
    for i in range(count):
        now = scene["t"] - i * scene["h"]
        q, p = taylor(Digits, system, None, now, q, p, -scene["h"], order=70)
        states.append((q, p))
    return states


def scenes_of(method):
    """Where the method has one answer: an implicit one may have several after a large step."""
    table = method.table
    if "scenes" in table:
        return {name: steps or STEPS[name] for name, steps in table["scenes"].items()}
    if method.kind == "multistep":
        return {"swinging": [1, 2], "driven": [1, 2]}
    left_out = [] if is_unique(method) else ["coarse"]
    if method.kind in ("discrete-gradient", "gonzalez", "processed") or "gradients" in table:
        left_out += ["driven", "driven-later"]
    return {name: steps for name, steps in STEPS.items() if name not in left_out}


def is_unique(method):
    """Whether a step of 1 with g/L = 1 has one answer: its stages in Nyström's form contract."""
    if method.explicit or method.kind == "discrete-gradient":
        # That of the discrete gradient has the derivative δ²/4 at most, δ < 1.1.
        return True
    if method.kind == "gonzalez":
        return False
    a = method.tableau()[1]
    if method.kind == "rk":
        angle = method.tableau("a_theta")[1] if "a_theta" in method.table else a
        a = (mpmath.matrix(angle) * mpmath.matrix(a)).tolist()
    return max(sum(abs(x) for x in row) for row in a) < 0.7


def shown(x):
    return mpmath.nstr(x, SHOWN, strip_zeros=False, min_fixed=-40, max_fixed=40)


def state(exact):
    return {"theta": shown(exact[0]), "omega": shown(exact[1])}


def answer(exact, roughs, size=None):
    """A state with its tolerance: by how much rough ones miss it, in units of the size, its own
    unless another is given."""
    pairs = [(r, float(e)) for rough in roughs for r, e in zip(rough, exact)]
    worst = max(abs(numpy.asarray(r) - e).max() for r, e in pairs) / Rough.UNIT
    size = float(size or max(abs(x) for x in exact))
    tolerance = math.ceil(max(LEAST, MARGIN * worst / size))
    return state(exact) | {"tolerance": str(tolerance)}


def answers(method):
    found = []
    for name, counts in scenes_of(method).items():
        scene = inputs(name, method.table.get("before", 0))
        states, memory = method.run(Digits, scene, max(counts))
        # The same errors for the same entry, whatever stands before it.
        Rough.used = 0
        for n in ORDERS_OF_OPERATIONS:
            n.sweeps = 60 if name == "coarse" else 24
        rough = [method.run(n, scene, max(counts)) for n in ORDERS_OF_OPERATIONS]
        for steps in counts:
            said = answer(states[steps - 1], [run[0][steps - 1] for run in rough])
            found.append({"scene": name, "steps": steps} | said)
        if name in ("swinging", "driven"):
            found[-len(counts)].update(extras(method, scene))
    return found


def extras(method, scene):
    """After the first step: the embedded estimate and the interpolant, where the table has them."""
    Rough.used = 0
    runs = [(n, *method.run(n, scene, 1)) for n in [Digits, *ORDERS_OF_OPERATIONS]]
    exact, *roughs = [extra(method, n, scene, states, memory) for n, states, memory in runs]
    size = max(abs(x) for x in runs[0][1][0])
    return {key: answer(z, [rough[key] for rough in roughs], size) for key, z in exact.items()}


def extra(method, n, scene, states, memory):
    c, h = memory["c"], n.number(scene["h"])
    found = {}
    if hasattr(c, "b_embedded"):
        both = [[n.number(0) if x is None else x for x in row] for row in (c.b, c.b_embedded)]
        differences = [a - b for a, b in zip(*both)]
        found["estimate"] = combination(n, differences, memory, h)
    if hasattr(c, "interpolant"):
        dq, dp = combination(n, c.interpolant, memory, h)
        found["at_0.3"] = n.number(scene["theta"]) + dq, n.number(scene["omega"]) + dp
    return found


def rounded(x):
    whole = int(mpmath.nint(abs(x) * 10**DECIMALS))
    text = str(whole).rjust(DECIMALS + 1, "0")
    return f"{'-' if x < 0 else ''}{text[:-DECIMALS]}.{text[-DECIMALS:]}"


def on_wrong_equations(table, mistakes):
    """One step of a method on each wrong equation that is not a mistake of the file in it."""
    found = {}
    for name, equation in tables.equations().items():
        if f"{table['name']}-{name}" not in mistakes and not tables.knows_the_sine(table):
            method = Method(table | {"force": equation["force"]})
            exact = method.run(Digits, inputs("swinging"), 1)[0][0]
            found[name] = dict(zip(("theta", "omega"), map(rounded, exact)))
    return found


def entry(table):
    method = Method(table)
    left_out = OF_METHODS if "of" in table else ()
    head = {key: table[key] for key in FIELDS if key in table and key not in left_out}
    return head, answers(method)


def line(value):
    return json.dumps(value, ensure_ascii=False)


def document():
    """The whole file as text: an answer a line."""
    methods, mistakes = tables.read()
    out = ["{", '"schema": 1,', '"about": ' + line(ABOUT) + ",", '"scenes": {']
    rows = []
    for name, scene in WHOLE.items():
        more = {}
        if name in ("swinging", "driven"):
            before = inputs(name, 4)["before"]
            more["before"] = [state(z) for z in before]
        rows.append(f"{line(name)}: {line({**scene, **more})}")
    out.append(",\n".join(rows) + "},")
    keys = ("what", "effect", "equation")
    rows = [
        f"{line(name)}: {line({key: wrong[key] for key in keys})}"
        for name, wrong in tables.equations().items()
    ]
    out.append('"equations": {\n' + ",\n".join(rows) + "},")
    for kind, entries in (("methods", methods), ("mistakes", mistakes)):
        texts = []
        for table in entries.values():
            head, found = entry(table)
            if kind == "methods" and (on := on_wrong_equations(table, mistakes)):
                head["on"] = on
            body = line(head)[:-1] + ', "answers": [\n'
            texts.append(body + ",\n".join(line(answer) for answer in found) + "]}")
        out.append(f"{line(kind)}: [\n" + ",\n".join(texts) + "],")
    return "\n".join(out)[:-1] + "}\n"


ABOUT = (
    "What one, two or eight steps of a named integrator of the pendulum, "
    "θ'' = -(g/L) sin θ + A cos(Ωt), lead to. Inputs are exact in binary, answers right to 25 "
    "digits; a program agrees if neither θ nor ω is further off than "
    "tolerance × ε × max(|θ|, |ω|), with the ε of its type. See book/judge/known-answers/README.md."
)

if __name__ == "__main__":
    start = time.time()
    text = document()
    OUTPUT.write_text(text)
    coefficients.OUTPUT.write_text(coefficients.document())
    print(f"{len(text.encode())} bytes, {time.time() - start:.1f} s")
