"""Refuses Pythons that cannot load the compiled part, with more than "No module named 'amble._amble'"."""

import importlib.machinery
import pathlib
import sys


def _check():
    here = pathlib.Path(__file__).resolve().parent
    loadable = importlib.machinery.EXTENSION_SUFFIXES
    found = sorted(file.name for file in here.glob("_amble.*") if file.suffix in (".so", ".pyd"))
    if any(name == "_amble" + suffix for name in found for suffix in loadable):
        return
    this = f"this is {sys.implementation.name} {sys.version_info[0]}.{sys.version_info[1]} ({sys.executable})"
    if not found:
        raise ImportError(f"amble's compiled part, _amble*.so, is not in {here}: build it by `make python`; {this}")
    # _amble.cpython-311-x86_64-linux-gnu.so
    tags = [name.split(".")[1] for name in found]
    versions = [f"{tag.split('-')[0]} {tag.split('-')[1][0]}.{tag.split('-')[1][1:]}" if tag.startswith("cpython-")
                else tag for tag in tags]
    raise ImportError(f"amble was built for {' and '.join(versions)} ({', '.join(found)}), and {this}: run it by that "
                      "Python, on Debian /usr/bin/python3, or build amble for this one (docs/PYTHON.md)")


_check()
