import html
import pathlib

from ._amble import _page


class Page:
    """A page in which a robot walks, in 3-D: shows itself in a notebook. html: its text, complete and offline."""

    def __init__(self, text, height=720):
        self.html, self.height = text, height

    def save(self, path):
        """Writes the page as a file for any browser; returns its pathlib.Path."""
        path = pathlib.Path(path)
        path.write_text(self.html, encoding="utf-8")
        return path

    def _repr_html_(self):
        # Its scripts run, apart from the notebook's.
        return (f'<iframe srcdoc="{html.escape(self.html)}" sandbox="allow-scripts" width="100%" '
                f'height="{self.height}" style="border: 0"></iframe>')

    def __repr__(self):
        return f"<amble.Page of {len(self.html)} characters: show it in a notebook, or save() it>"


def view(champion, seconds=None, engine=None, *, undisturbed=False, height=720):
    """Lets a champion walk and returns a Page that shows it, the page of `amble view`: where it was evolved under noise the
    median of several trials, else, or with undisturbed=True, its trial without noise.

    champion: Champion, Run, Recording, or path of one of them. seconds: length, s (default: as in its evolution; not for
    recordings). engine: "ode", "batch" or "mujoco" (default: as in its evolution). height: in a notebook, pixels.
    Raises Error; Ctrl-C raises KeyboardInterrupt at once.
    """
    if not isinstance(height, int) or height < 1:
        raise ValueError(f"height: {height!r}: expected a whole number of pixels")
    return Page(_page(champion, seconds, engine, undisturbed), height)
