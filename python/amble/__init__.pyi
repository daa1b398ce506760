from ._amble import (Champion as Champion, Config as Config, Controllers as Controllers, Error as Error, Genome as Genome, Map as Map,
                     Problem as Problem, Recording as Recording, Robots as Robots, Run as Run, Search as Search,
                     __commit__ as __commit__, __version__ as __version__, compare as compare, evaluate as evaluate, evolve as evolve,
                     gait as gait, load_config as load_config, new_robot as new_robot, resume as resume)
from ._data import data_folder as data_folder, robots as robots
from ._evaluation import Evaluation as Evaluation
from ._view import Page as Page, view as view
