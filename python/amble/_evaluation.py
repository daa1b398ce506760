class Evaluation(tuple):
    """(objective, behaviour), as evaluate() returns them, and viable: bool [n], false where a simulation diverged."""

    def __new__(cls, objective, behaviour, viable):
        self = super().__new__(cls, (objective, behaviour))
        self.viable = viable
        return self

    def __reduce__(self):
        return Evaluation, (*self, self.viable)

    @property
    def objective(self):
        return self[0]

    @property
    def behaviour(self):
        return self[1]
