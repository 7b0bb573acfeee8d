# SPDX-License-Identifier: BSD-3-Clause
"""What Documentation/pipelines.md and paraview.md say, for the tests that keep it true: code blocks and tables."""

import pathlib
import re
import textwrap

TREE = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^(?:<!-- (?P<source>\S+) -->\n)?```(?P<language>\w*)\n(?P<code>.*?)^```$",
                   re.DOTALL | re.MULTILINE)


def text(name="pipelines.md"):
    return (TREE / "Documentation" / name).read_text(encoding="utf-8")


def blocks(document):
    """The fenced blocks: dictionaries of language, code and source, the file that a comment above names or None."""
    return [match.groupdict() for match in FENCE.finditer(document)]


def is_part(code, whole):
    """Whether `code` stands in `whole`, line for line, perhaps indented."""
    wanted, lines = code.splitlines(), whole.splitlines()
    for first in range(len(lines) - len(wanted) + 1):
        if textwrap.dedent("\n".join(lines[first:first + len(wanted)])).split("\n") == wanted:
            return True
    return False


def untrue_blocks(document):
    """The code blocks that are not in the file that they name, or name none: a line each. Shell blocks are run."""
    found = []
    for block in blocks(document):
        if block["language"] == "sh":
            continue
        title = (block["code"].splitlines() or ["an empty block"])[0]
        if not block["source"]:
            found.append(f"{title}: no file is named")
        elif not (TREE / block["source"]).exists():
            found.append(f"{title}: {block['source']} does not exist")
        elif not block["code"].strip() or not is_part(block["code"],
                                                      (TREE / block["source"]).read_text(encoding="utf-8")):
            found.append(f"{title}: not in {block['source']}")
    return found


def outputs(document):
    """The table of outputs: tuples (class, port, where, name, type, least components, most components)."""
    rows, output = [], None
    for line in document.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 7 or cells[0] in ("output", "---"):
            continue
        if cells[0]:
            name, port = cells[0].split()
            output = (name.strip("`"), int(port))
        components = [int(number) for number in cells[5].split(" to ")]
        rows.append((*output, cells[2], cells[3].strip("`"), cells[4], components[0], components[-1]))
    return rows
