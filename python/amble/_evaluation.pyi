import numpy as np
from numpy.typing import NDArray

class Evaluation(tuple[NDArray[np.float64], NDArray[np.float32]]):
    viable: NDArray[np.bool_]
    @property
    def objective(self) -> NDArray[np.float64]: ...
    @property
    def behaviour(self) -> NDArray[np.float32]: ...
