"""Walks the how-tos: carries out their own snippets, in order, in a copy of the sources.

Usage: walk.py SOURCE FOLDER [--build] [law | solver | command | board]...   All four if none is named.

A block ```diff begins with `+++ FILE`. Its lines that begin with a blank are in this file, in this order and
once; the lines that begin with + are added below them. A block without the former is added at the end of the
file, which may be new. A block ```sh of cp, mkdir and sed is carried out at once; a sed that changes nothing
is an error. Every other ```sh builds and tests: with --build they run after the edits of their how-to.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

HOW_TOS = {
    "law": ("firmware/friction/README.md", "How to add a friction law"),
    "solver": ("firmware/plant/README.md", "How to add a solver"),
    "command": ("host_sim/cli/README.md", "How to add a command"),
    "board": ("hal/README.md", "How to port the controller to a board"),
}
EDITS = ("cp ", "mkdir ", "sed ")


def section(text, title):
    """From its heading to the next one of its level."""
    begin = re.search(rf"^(#+) {re.escape(title)}$", text, re.MULTILINE)
    rest = text[begin.end():]
    # In code # begins no heading.
    prose = re.sub(r"```.*?```", lambda code: "`" * len(code[0]), rest, flags=re.DOTALL)
    end = re.search(rf"^#{{1,{len(begin[1])}}} ", prose, re.MULTILINE)
    return rest[:end.start()] if end else rest


def blocks(text):
    """(language, lines) of each fenced block, without the indent of the list that it stands in."""
    for match in re.finditer(r"^( *)```(\w+)\n(.*?)^ *```$", text, re.MULTILINE | re.DOTALL):
        indent = len(match[1])
        yield match[2], [line[indent:] for line in match[3].splitlines()]


def insert(tree, lines):
    file = tree / lines[0].removeprefix("+++ ")
    before = [line[1:] for line in lines[1:] if line[:1] != "+"]
    added = [line[1:] for line in lines[1:] if line[:1] == "+"]
    old = file.read_text().splitlines() if file.exists() else []
    if not before:
        file.write_text("\n".join(old + added) + "\n")
        return
    places = [i for i in range(len(old)) if old[i:i + len(before)] == before]
    if len(places) != 1:
        sys.exit(f"{file}: {len(places)} places in place of one for\n" + "\n".join(before))
    at = places[0] + len(before)
    file.write_text("\n".join(old[:at] + added + old[at:]) + "\n")


def snapshot(words, tree):
    return {word: (tree / word).read_bytes() for word in words if (tree / word).is_file()}


def edit(tree, command):
    files = command.replace("\\\n", " ").split()
    before = snapshot(files, tree)
    subprocess.run(["bash", "-e", "-c", command], cwd=tree, check=True)
    if command.startswith("sed ") and any(text == (tree / file).read_bytes() for file, text in before.items()):
        sys.exit(f"changes nothing: {command}")


def commands(lines):
    """One a command, which a backslash at its end continues."""
    text = "\n".join(line for line in lines if line and not line.startswith("#"))
    return re.split(r"(?<!\\)\n", text)


def carry_out_edits(tree, text):
    """And gives what builds and tests."""
    builds = []
    for language, lines in blocks(text):
        if language == "diff":
            insert(tree, lines)
        elif language == "sh" and lines[0].startswith(EDITS):
            for command in commands(lines):
                edit(tree, command)
        elif language == "sh":
            builds.append("\n".join(lines))
    return builds


def files_below(folder):
    for file in folder.rglob("*"):
        path = file.relative_to(folder)
        if file.is_file() and path.parts[0] not in (".git", "build", "out") and "__pycache__" not in path.parts:
            yield path


def copy_sources(source, tree):
    """What an earlier walk has edited gets the time of now: a build that is kept makes it again."""
    sources = set(files_below(source))
    for path in set(files_below(tree)) - sources:
        (tree / path).unlink()
        if not any((tree / path).parent.iterdir()):
            (tree / path).parent.rmdir()
    for path in sources:
        if not (tree / path).exists() or (tree / path).read_bytes() != (source / path).read_bytes():
            (tree / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / path, tree / path)
    # What tools/setup has fetched from npm serves the copy too.
    if (source / "build/npm").exists() and not (tree / "build/npm").exists():
        (tree / "build").mkdir(exist_ok=True)
        (tree / "build/npm").symlink_to(source / "build/npm")


def main():
    source, tree = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    chosen = [word for word in sys.argv[3:] if word != "--build"] or list(HOW_TOS)
    copy_sources(source, tree)
    if shutil.which("ccache"):
        os.environ["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    for document, title in (HOW_TOS[word] for word in chosen):
        builds = carry_out_edits(tree, section((tree / document).read_text(), title))
        for block in builds if "--build" in sys.argv else []:
            print(block, flush=True)
            subprocess.run(["bash", "-e", "-c", block], cwd=tree, check=True)


if __name__ == "__main__":
    main()
