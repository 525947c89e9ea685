"""Reads the tables: names, sources and coefficients, the latter as expressions or decimals."""

import functools
import pathlib
import re
import tomllib

import mpmath

HERE = pathlib.Path(__file__).parent
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*(?:e[-+]?\d+)?|\.\d+(?:e[-+]?\d+)?)")
MPMATH = {"number": mpmath.mpf, "sqrt": mpmath.sqrt, "cos": mpmath.cos, "pi": mpmath.pi}

# What a mistake does not take over from its method's table.
OF_METHOD = ("name", "also", "same_as", "b_embedded", "interpolant")


def function(text, names):
    """The function of q that an expression says."""
    return evaluate(f"lambda q: {text}", names)


def evaluate(text, names):
    # The tables are part of this repository: nothing from outside is evaluated.
    return eval(NUMBER.sub(r"number('\1')", text), {"__builtins__": {}} | names)


def lines(text, names, q, p, h, force):
    """What a formula leads to, "name = expression" a line: its theta and its omega."""
    names = names | {"q": q, "p": p, "h": h, "f": force}
    for line in text.strip().splitlines():
        name, expression = line.split("=")
        names[name.strip()] = evaluate(expression.strip(), names)
    return names["theta"], names["omega"]


class Reader:
    """Reads the expressions of one table with one library of numbers."""

    def __init__(self, table, functions=MPMATH):
        self.names, self.zero = dict(functions), functions["number"](0)
        for name, text in table.get("let", {}).items():
            self.names[name] = self.expression(text)

    def expression(self, text):
        return evaluate(text, self.names) + self.zero

    def row(self, text):
        return [self.expression(token) for token in text.split()]

    def rows(self, text):
        """Nodes and rows of "c : a a a", filled up with zeros; without c, the sum of the row."""
        nodes, rows = [], []
        for line in text.strip().splitlines():
            node, colon, entries = line.rpartition(":")
            rows.append(self.row(entries))
            nodes.append(self.expression(node.strip()) if colon else sum(rows[-1], self.zero))
        return nodes, [row + [self.zero] * (len(rows) - len(row)) for row in rows]


def read():
    """All tables by name, and the names in the order of the files: (methods, mistakes)."""
    found = {"method": [], "mistake": []}
    for path in sorted((HERE / "tables").glob("*.toml")):
        file = tomllib.loads(path.read_text())
        for kind in found:
            found[kind] += file.get(kind, [])
        for equation in file.get("equation", []):
            found["mistake"] += on_each_method(equation, equation.get("of", file["methods"]))
    methods = {table["name"]: table for table in found["method"]}
    mistakes = {}
    for table in found["mistake"]:
        base = methods[table["of"]]
        merged = {key: value for key, value in base.items() if key not in OF_METHOD}
        merged["let"] = {**base.get("let", {}), **table.get("let", {})}
        merged.update({k: v for k, v in table.items() if k not in ("let", "change")})
        for change in table.get("change", []):
            exchange(merged, change)
        mistakes[table["name"]] = merged
    assert len(methods) + len(mistakes) == sum(map(len, found.values())), "a name twice"
    return methods, mistakes


@functools.lru_cache(None)
def equations():
    """The wrong equations that one step shows, by name."""
    file = tomllib.loads((HERE / "tables" / "equations.toml").read_text())
    return {x["suffix"]: x for x in file["equation"] if "swinging" in x["scenes"]}


def knows_the_sine(table):
    """Whether the method is made for this equation, or comes with older states of it."""
    return table["kind"] not in ("rk", "rkn", "splitting") or "gradients" in table


def on_each_method(equation, methods):
    """A wrong equation as a mistake in each of these methods."""
    seen = equation.get("seen_in", {})
    rest = {k: v for k, v in equation.items() if k not in ("suffix", "seen_in", "of")}
    for of in methods:
        named = {"name": f"{of}-{equation['suffix']}", "of": of}
        yield named | rest | {"seen": seen.get(of, equation["seen"])}


def exchange(table, change):
    """Replaces an entry of a table, counted from 1: "a 4 3 = 1/2", "c 3 = 1", "b 2 = 0"."""
    where, value = (side.strip() for side in change.split("="))
    field, *indices = where.split()
    if field in ("a", "c"):
        lines = [line.strip() for line in table["a"].strip().splitlines()]
        i = int(indices[0]) - 1
        node, colon, entries = lines[i].rpartition(":")
        # The node stays what it was: the change of an entry changes nothing else.
        node = node.strip() if colon else "+".join(f"({e})" for e in entries.split())
        entries = entries.split()
        if field == "c":
            node = value
        else:
            j = int(indices[1]) - 1
            entries += ["0"] * (j + 1 - len(entries))
            entries[j] = value
        lines[i] = f"{node} : {' '.join(entries)}"
        table["a"] = "\n".join(lines)
    else:
        entries = table[field].split()
        entries[int(indices[0]) - 1] = value
        table[field] = " ".join(entries)


def alternation(table, reader):
    """Kicks and drifts of a splitting: a list of ("kick" or "drift", length, gradient)."""
    first = table.get("first", "kick")
    lengths = reader.row(table["substeps" if "substeps" in table else "lengths"])
    if table.get("mirror"):
        lengths += lengths[-2::-1]
    if "substeps" in table:
        steps = lengths
        lengths = [steps[0] / 2] + [x for a, b in zip(steps, steps[1:]) for x in (a, (a + b) / 2)]
        lengths += [steps[-1], steps[-1] / 2]
    gradients = reader.row(table["gradients"]) if "gradients" in table else []
    names = ("kick", "drift") if first == "kick" else ("drift", "kick")
    return [
        (names[i % 2], length, gradients[i] if gradients else None)
        for i, length in enumerate(lengths)
    ]
