import pathlib

from ._amble import Champion, Engine, Path, Recording, Run

class Page:
    html: str
    height: int
    def __init__(self, text: str, height: int = 720) -> None: ...
    def save(self, path: Path) -> pathlib.Path: ...

def view(champion: Champion | Run | Recording | Path, seconds: float | None = None, engine: Engine | None = None, *,
         undisturbed: bool = False, height: int = 720) -> Page: ...
