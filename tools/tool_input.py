"""What tools are given and read; where it is not what they expect, they end with one line that says so."""
import argparse
import contextlib
import csv
import glob
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tomllib

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(sys.argv[0])))  # of the tool that runs, where tools/ may be a link
NAME = "tools/" + os.path.basename(sys.argv[0])
AMBLE = os.environ.get("AMBLE", os.path.join(ROOT, "build/release/src/cli/amble"))


class Wrong(Exception):
    """What is wrong, in one line: where, what was expected, what to do."""


class Parser(argparse.ArgumentParser):
    """A tool's --help is its docstring, and what is wrong with its arguments one line."""

    def __init__(self, doc):
        super().__init__(prog=NAME, allow_abbrev=False)
        self.doc = doc

    def format_help(self):
        return self.doc.strip() + "\n"

    def error(self, message):
        self.exit(2, f"{NAME}: {message} ({NAME} --help)\n")


def run(main):
    """Calls a tool's main; anything wrong ends it with one line."""
    try:
        main()
        sys.stdout.flush()
    except Wrong as wrong:
        sys.exit(f"{NAME}: {wrong}")
    except BrokenPipeError:  # by `… | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except OSError as error:
        sys.exit(f"{NAME}: {error.filename}: {error.strerror}" if error.filename else f"{NAME}: {error}")
    except ImportError as error:
        sys.exit(f"{NAME}: {error}; expected a python3 that has it (Debian: /usr/bin/python3 with python3-{error.name})")
    except KeyboardInterrupt:
        sys.exit(130)


# Arguments.

def number(text, least=-math.inf, above=-math.inf):
    """Of an argument: finite, at least `least`, more than `above`."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if math.isfinite(value) and value >= least and value > above:
        return value
    bound = f" of at least {least:g}" if math.isfinite(least) else f" above {above:g}" if math.isfinite(above) else ""
    raise argparse.ArgumentTypeError(f"{text!r}: expected a number{bound}")


def count(text):
    if not (text.isascii() and text.isdecimal()) or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a whole number of at least 1")
    return int(text)


def program(name):
    """Where a program is."""
    found = shutil.which(name)
    if not found:
        raise Wrong(f"{name}: no such program; expected amble, as `make build` makes it in build/release/src/cli")
    return os.path.abspath(found)


def setting(text):
    if not re.match(r"[^=\s]+=", text):
        raise argparse.ArgumentTypeError(f"{text!r}: expected KEY=VALUE")
    return text


# Files.

@contextlib.contextmanager
def expecting(path, what):
    """Where something is missing in a file, or is of another kind: names the file, and what was expected."""
    try:
        yield
    except KeyError as error:
        raise Wrong(f"{path}: it has no {error.args[0]!r}; expected {what}") from error
    except (ValueError, TypeError, IndexError, AttributeError, ArithmeticError, RecursionError) as error:
        because = str(error).splitlines() if isinstance(error, ValueError) else []
        raise Wrong(f"{path}: {because[0] if because else 'it has another form'}; expected {what}") from error


def text_of(path):
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return file.read()
    except UnicodeDecodeError as error:
        raise Wrong(f"{path}: it is no text") from error


def json_of(path):
    with expecting(path, "whole JSON"):
        return json.loads(text_of(path))


def toml_of(path):
    with expecting(path, "TOML"):
        return tomllib.loads(text_of(path))


def rows_of(path, *columns, some=True):
    """The rows of a CSV file that has these columns, and, with `some`, at least one row."""
    with expecting(path, "CSV"):
        try:
            text = text_of(path)
            reader = csv.DictReader(io.StringIO(text, newline=""), strict=True)
            rows = list(reader)
        except csv.Error as error:
            raise ValueError(str(error)) from error
    if missing := [name for name in columns if name not in (reader.fieldnames or [])]:
        there = ", ".join(reader.fieldnames or []) or "none"
        raise Wrong(f"{path}: it has no column {missing[0]!r}; there are {there if len(there) < 300 else there[:300] + ' …'}")
    for at, row in enumerate(rows, 2):
        if None in row or None in row.values():
            raise Wrong(f"{path}: row {at} has not as many cells as the first; expected a whole file")
    if not text.endswith("\n"):
        raise Wrong(f"{path}: its last row has no end; expected a whole file")
    if some and not rows:
        raise Wrong(f"{path}: it has no rows")
    return rows


def table_of(folder, name, *columns, some=True):
    """The rows of NAME.csv in a folder of tables of a report."""
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        raise Wrong(f"{folder}: there is no {name}.csv; expected a folder that `amble report RESULTS --csv {folder}` wrote")
    return rows_of(path, *columns, some=some)


def records(results):
    """Path and record of each run in the ledger of a study's results, by name."""
    if not os.path.isdir(results):
        raise Wrong(f"{results}: no such folder; expected the results of `amble study`, such as results/noise")
    paths = sorted(glob.glob(os.path.join(glob.escape(str(results)), "ledger", "*.json")))
    if not paths:
        raise Wrong(f"{results}: it has no ledger with records; expected the results of `amble study`, such as results/noise")
    for path in paths:
        record = json_of(path)
        if not isinstance(record, dict) or record.get("format") != "amble-study-record":
            raise Wrong(f"{path}: no record of a run; expected those of `amble study` alone in this folder")
        yield path, record


def processor(record):
    """That of a run, with its instruction set as its makers call it, which Highway calls AVX3."""
    return record["provenance"]["cpu"].replace("AVX3", "AVX-512")


def line(cells):
    """A row of a Markdown table."""
    return "| " + " | ".join(cells) + " |"


def folder_for(path):
    """Makes a folder for what a tool makes, if it is not there."""
    if os.path.exists(path) and not os.path.isdir(path):
        raise Wrong(f"{path}: it is a file; expected a folder, or the name of one that is to be made")
    os.makedirs(path, exist_ok=True)


def kept(path, command, make):
    """What a file keeps that `make` made at an earlier call, and its first line says by which command; what another one made is refused."""
    if not os.path.exists(path):
        text = f"{command}\n{make()}"
        with open(path + ".new", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".new", path)
    by, _, text = text_of(path).partition("\n")
    if by != command:
        raise Wrong(f"{path}: it was made by `{by or 'nobody knows what'}`; expected `{command}`: remove what was made so, or name another folder")
    return text


# What programs do and say.

def do(command, **options):
    """Runs a command that says by itself what it does, and why it fails; then this ends as well."""
    if subprocess.run(list(map(str, command)), **options).returncode != 0:
        sys.exit(1)


def said(command, **options):
    """The output of a command. Where it fails: ends, with what it said of that."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.stderr.write(done.stderr or done.stdout or f"{NAME}: {command[0]} ended with {done.returncode} and said nothing\n")
        sys.exit(1)
    return done.stdout


def found(pattern, text, where):
    """The match of a pattern in what a program said."""
    match = re.search(pattern, text, re.MULTILINE)
    if not match:
        first = (text.strip().splitlines() or ["nothing"])[0]
        raise Wrong(f"{where}: it said {first[:80]!r}; expected what amble of these sources says")
    return match


def version(amble):
    """A program's name and version, as its results may depend on it."""
    return found(r"^amble \S+", said([amble, "--version"]), amble)[0]
