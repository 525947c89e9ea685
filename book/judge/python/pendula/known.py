"""The file of known answers, which comes with the package.

Its README, ``book/judge/known-answers/README.md``, has the conventions and how the numbers were
computed, twice, to 25 digits.
"""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import Any

#: ε of a double; that of single precision is 2⁻²³.
DOUBLE = 2.0**-52
#: The largest that makes sense: of numbers with two digits.
MOST = 0.01


def checked(epsilon: float) -> float:
    """The ε of a precision. With none that a type of floats has everything would be right, or
    nothing."""
    # Half of a double's, as others define it, and that of floats of 16 bits.
    if not DOUBLE / 2 <= epsilon <= MOST:
        raise ValueError(
            f"epsilon is {epsilon!r}: it must be that of a precision, at least 2**-53 and at most "
            f"{MOST}; 2**-52 for doubles, 2**-23 in single precision"
        )
    return epsilon


@functools.cache
def _text() -> str:
    text = (Path(__file__).parent / "known-answers.json").read_text(encoding="utf-8")
    if not text.startswith("{"):
        # A link of git, where links are not made: its text is where it leads.
        raise RuntimeError("the package was made without known-answers.json: that is a link's text")
    return text


def known_answers() -> dict[str, Any]:
    """The file of known answers, as its JSON: ``scenes``, ``methods``, ``mistakes`` and the
    wrong ``equations``. Numbers are texts of 25 digits.

    >>> file = known_answers()
    >>> rk4 = next(method for method in file["methods"] if method["name"] == "rk4")
    >>> answer = rk4["answers"][0]
    >>> answer["scene"], answer["steps"], answer["theta"]
    ('swinging', 1, '1.055844631888095874787714')
    """
    file: dict[str, Any] = json.loads(_text())
    return file


@functools.cache
def read_once() -> dict[str, Any]:
    """The same, of which no copy is made: nobody changes it."""
    return known_answers()
