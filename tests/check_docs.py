#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails where the documents say what is not so: a link or a path that leads nowhere, a name that is not in the file
that is said to hold it, a line of prose longer than 120 characters, British spelling in documents or sources.

Usage: tests/check_docs.py [ROOT]
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
FOLDERS = ("app", "renderer", "shaders", "tests", "docs", "assets", "third_party", "cmake", "tools")
SHADER_FOLDERS = ("denoise", "lighting", "post", "scene", "shared", "lib")  # the pipeline is written from shaders/
BRITISH = re.compile(
    r"\b(colour\w*|centres?|centred|grey(?:scale)?|normalis\w+|neighbour\w*|behaviour\w*|metres|artefacts?|optimis\w+|"
    r"initialis\w+|organis\w+|licences?|favour\w*|modelling|labelled|quantis\w+|rasteris\w+|summaris\w+|recognis\w+|"
    r"travelled|catalogue)\b",
    re.IGNORECASE)


def tracked(*patterns):
    names = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [ROOT / name for name in names.split("\n") if name and (ROOT / name).is_file()]


def prose(lines):
    """Numbers and lines outside code blocks, whether fenced or indented."""
    fenced = False
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            yield number, line


def exists(path):
    if any(mark in path for mark in "*<>{}$") or "NAME" in path or "..." in path:
        return True  # a pattern, not a path
    first = path.split("/")[0]
    if first in FOLDERS:
        return (ROOT / path).exists()
    if first in SHADER_FOLDERS and path.endswith((".comp", ".glsl", ".h", ".vert", ".frag")):
        return (ROOT / "shaders" / path).exists()
    return True


def faults_of(document):
    lines = document.read_text().split("\n")
    name = document.relative_to(ROOT)
    for number, line in prose(lines):
        where = f"{name}:{number}"
        if len(line) > 120 and not line.startswith("|"):
            yield f"{where}: {len(line)} characters; wrap at 120"
        for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", line):
            if "://" not in target and not (document.parent / target).exists():
                yield f"{where}: the link {target} leads nowhere"
        for code in re.findall(r"`([^`]+)`", line):
            if "/" in code and " " not in code and not exists(code.rstrip("/.")):
                yield f"{where}: there is no {code}"
        for names, path in re.findall(r"((?:`\w+`, )*`\w+`) in `([^`]+)`", line):
            if "/" in path and (ROOT / path).is_file():
                text = (ROOT / path).read_text()
                for word in re.findall(r"`(\w+)`", names):
                    if not re.search(rf"\b{word}\b", text):
                        yield f"{where}: {path} has no {word}"


def spelling_of(source):
    for number, line in enumerate(source.read_text(errors="replace").split("\n"), 1):
        for word in BRITISH.findall(line):
            yield f"{source.relative_to(ROOT)}:{number}: American spelling, please: {word}"


def main():
    documents = tracked("*.md")
    sources = tracked("app/*", "renderer/*", "shaders/*", "tests/*", "tools/*", "cmake/*", "docs/*.py", "docs/*.sh")
    sources = [s for s in sources if s.suffix in {".h", ".cpp", ".comp", ".glsl", ".vert", ".frag", ".js", ".py", ".sh",
                                                  ".cmake", ".txt", ".mjs"} and s != pathlib.Path(__file__).resolve()]
    faults = [fault for document in documents for fault in faults_of(document)]
    faults += [fault for source in documents + sources for fault in spelling_of(source)]
    if len(documents) < 8:
        faults.append(f"only {len(documents)} documents below {ROOT}: is it the source folder?")
    print("\n".join(faults) if faults else f"{len(documents)} documents say what is so")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
