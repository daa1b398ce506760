import html
import pathlib

from ._amble import _page, _save_page


class Page:
    """A page in which a robot walks, in 3-D: shows itself in a notebook. html: its text, complete and offline."""

    def __init__(self, text, height=720):
        self.html, self.height = text, height

    def save(self, path):
        """Writes the page as FILE.html for any browser; returns its pathlib.Path, absolute. Raises Error: replaces pages alone."""
        return pathlib.Path(_save_page(path, self.html))

    def _repr_html_(self):
        # Its scripts run, apart from the notebook's.
        return (f'<iframe srcdoc="{html.escape(self.html)}" sandbox="allow-scripts" width="100%" '
                f'height="{self.height}" style="border: 0"></iframe>')

    def __repr__(self):
        return f"<amble.Page of {len(self.html)} characters: show it in a notebook, or save() it>"


def view(champion, seconds=None, engine=None, *, level="", noise=None, trials=0, undisturbed=False, history=False,
         title=None, height=720):
    """Lets a champion walk and returns a Page that shows it, the page of `amble view`: where it was evolved under noise the
    median of several trials, else, or with undisturbed=True, its trial without noise.

    champion: Champion, Run, Recording, or path of one of them; a list of them walks side by side. seconds: length, s
    (default: as in its evolution; not for recordings). engine: "ode", "batch" or "mujoco" (default: as in its
    evolution). level, noise, trials: what disturbs, as in Champion.typical(). history: of one run up to eight
    champions, from the first to the last. title: of the page. height: in a notebook, pixels.
    Raises Error; Ctrl-C raises KeyboardInterrupt at once.
    """
    if not isinstance(height, int) or height < 1:
        raise ValueError(f"height: {height!r}: expected a whole number of pixels")
    shown = list(champion) if isinstance(champion, (list, tuple)) else [champion]
    return Page(_page(shown, seconds, engine, level, noise, trials, undisturbed, history, title), height)
