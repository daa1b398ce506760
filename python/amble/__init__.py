"""amble: evolves walking controllers for legged robots; NEAT and HyperNEAT on physics engines.

evolve() and resume() make runs; Run, Champion, Recording and gait() read what they leave; view() shows it in a notebook.
new_robot() makes a robot file and a config of a model. Map is a map of gaits, compare() lets champions walk in several engines.
Search (ask and tell), evaluate() and Controllers take search, simulation and control apart. Robots simulates many robots
step by step. docs/PYTHON.md has recipes.
"""

import copyreg as _copyreg
import types as _types

from . import _built  # first: says so if the module was built for another Python
from . import _amble
from ._amble import (Champion, Config, Controllers, Error, Genome, Map, Problem, Recording, Robots, Run, Search, __commit__,
                     __version__, compare, evaluate, evolve, gait, load_config, new_robot, resume)
from ._data import data_folder, robots
from ._evaluation import Evaluation
from ._view import Page, view

__all__ = ["Champion", "Config", "Controllers", "Error", "Evaluation", "Genome", "Map", "Page", "Problem", "Recording", "Robots",
           "Run", "Search", "compare", "data_folder", "evaluate", "evolve", "gait", "load_config", "new_robot", "resume", "robots",
           "view"]


def _by_name(function):
    """How pickle, and so multiprocessing, takes a function of the compiled part; all other built-in functions as before."""
    if getattr(_amble, function.__name__, None) is function:
        return function.__name__
    return function.__reduce__()


_copyreg.pickle(_types.BuiltinFunctionType, _by_name)
