import pathlib

from ._amble import Champion, Engine, Path, Recording, Run

class Page:
    html: str
    height: int
    def __init__(self, text: str, height: int = 720) -> None: ...
    def save(self, path: Path) -> pathlib.Path: ...

Shown = Champion | Run | Recording | Path

def view(champion: Shown | list[Shown] | tuple[Shown, ...], seconds: float | None = None, engine: Engine | None = None, *,
         level: str = "", noise: Path | None = None, trials: int = 0, undisturbed: bool = False, history: bool = False,
         title: str | None = None, height: int = 720) -> Page: ...
