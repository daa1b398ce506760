import pathlib
import tomllib

_HERE = pathlib.Path(__file__).resolve()


def data_folder():
    """The folder with amble's own robots/ and configs/, a pathlib.Path. Raises FileNotFoundError."""
    # Beside the package (a wheel, a build folder), or below the prefix of lib/python3/dist-packages/amble.
    for folder in [_HERE.parent / "data", *(prefix / "share/amble" for prefix in _HERE.parents[4:5])]:
        if (folder / "robots").is_dir():
            return folder
    raise FileNotFoundError(f"amble's robots and configs are not installed beside {_HERE.parent}")


def robots():
    """amble's own robots: name → path of the robot file, a dict. "quadruped" is the authors', "quadruped/paper" the paper's."""
    found = {}
    for file in sorted(data_folder().glob("robots/*/*.toml")):
        kind, variant = file.parent.name, file.stem
        if "model" in tomllib.loads(file.read_text(encoding="utf-8")):  # others there are configs
            found[kind if variant in (kind, "authors") else f"{kind}/{variant}"] = file
    return found
