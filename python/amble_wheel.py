"""What `pip wheel .` and `pip install .` call (PEP 517): CMake builds the module, and this packs it with its robots and configs.

It needs nothing from Python's package index: what setup.d/packages-python.txt lists must be there (`./setup --python`).
`--config-settings=build-dir=build/dev` packs a build that is there already; by default there is one in build/wheel.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
TAG = f"cp{sys.version_info[0]}{sys.version_info[1]}-cp{sys.version_info[0]}{sys.version_info[1]}-" + re.sub(
    "[-.]", "_", sysconfig.get_platform())

_WHEEL = f"Wheel-Version: 1.0\nGenerator: amble\nRoot-Is-Purelib: false\nTag: {TAG}\n"


def _project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def _version():
    return re.search(r"project\(amble VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", "Name: amble", f"Version: {_version()}", f"Summary: {project['description']}",
             f"Requires-Python: {project['requires-python']}", "Description-Content-Type: text/markdown"]
    lines += [f"Requires-Dist: {each}" for each in project["dependencies"]]
    for extra, wanted in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {each}; extra == '{extra}'" for each in wanted)]
    return "\n".join(lines) + "\n\n" + (ROOT / project["readme"]).read_text()


def _run(*command):
    # pip hides Debian's packages from what it builds; CMake looks for their numpy.
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONNOUSERSITE")}
    subprocess.run([str(part) for part in command], check=True, env=environment)


def _build():
    folder = ROOT / "build/wheel"
    _run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DAMBLE_PYTHON=ON",
         f"-DPython_EXECUTABLE={getattr(sys, '_base_executable', sys.executable)}")
    _run("cmake", "--build", folder, "--target", "_amble", "amble_python_files")
    return folder


def _files(build, stage):
    """The package as it is installed: path in the wheel → bytes."""
    for component in ("python", "wheel"):
        _run("cmake", "--install", build, "--component", component, "--prefix", stage)
    package, = stage.glob("**/amble/__init__.py")
    root = package.parents[1]
    return {str(file.relative_to(root)): file for file in sorted(root.rglob("*")) if file.is_file()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = f"amble-{_version()}.dist-info"
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(_WHEEL)
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = (config_settings or {}).get("build-dir")
    build = ROOT / build if build else _build()
    info = f"amble-{_version()}.dist-info"
    name = f"amble-{_version()}-{TAG}.whl"
    record = []
    with tempfile.TemporaryDirectory() as scratch, \
            zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:

        def add(path, data):
            entry = zipfile.ZipInfo(path)  # of 1980: the same files make the same wheel
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(data)}\n")

        for path, file in _files(build, pathlib.Path(scratch)).items():
            add(path, file.read_bytes())
        add(f"{info}/METADATA", _metadata().encode())
        add(f"{info}/WHEEL", _WHEEL.encode())
        add(f"{info}/LICENSE", (ROOT / "LICENSE").read_bytes())
        record.append(f"{info}/RECORD,,\n")
        wheel.writestr(f"{info}/RECORD", "".join(record))
    return name


def build_sdist(sdist_directory, config_settings=None):
    """All files that git knows."""
    top = f"amble-{_version()}"
    files = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True, text=True).stdout
    with tempfile.TemporaryDirectory() as scratch, \
            tarfile.open(pathlib.Path(sdist_directory) / f"{top}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        info = pathlib.Path(scratch) / "PKG-INFO"
        info.write_text(_metadata())
        archive.add(info, f"{top}/PKG-INFO")
        for file in filter(None, files.split("\0")):
            archive.add(ROOT / file, f"{top}/{file}", recursive=False)
    return f"{top}.tar.gz"
