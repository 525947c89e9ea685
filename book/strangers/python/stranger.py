"""Integrators of Python's libraries as programs for `pendula verify`:

    python3 stranger.py LIBRARY INTEGRATOR

An adapter is a function of the library's name in equations.py or mechanics.py. Of an integrator's
name it makes the functions that `pendula.serve` takes. It imports what it needs itself, as only one
library is loaded.
"""

import sys

import equations
import mechanics
import pendula

library, integrator = sys.argv[1:]
adapter = getattr(equations, library, None) or getattr(mechanics, library)
pendula.serve(**adapter(integrator), name=f"{library} {integrator}")
