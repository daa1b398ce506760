"""amble: evolves walking controllers for legged robots; NEAT and HyperNEAT on physics engines.

evolve() and resume() make runs; Run, Champion, Recording and gait() read what they leave. Search (ask and tell) and
evaluate() take search and simulation apart. Robots simulates many robots step by step. docs/PYTHON.md has recipes.
"""

from ._amble import (Champion, Config, Error, Genome, Problem, Recording, Robots, Run, Search, __commit__,
                     __version__, evaluate, evolve, gait, load_config, resume)

__all__ = ["Champion", "Config", "Error", "Genome", "Problem", "Recording", "Robots", "Run", "Search", "evaluate",
           "evolve", "gait", "load_config", "resume"]
