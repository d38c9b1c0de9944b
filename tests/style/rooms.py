# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that no two folders of framework/src include each other, directly or by way of others, and that no folder
includes what it must not know (framework/README.md)."""
import re
import sys
from pathlib import Path

# folder -> folders that it must not include
UNKNOWN = {
    "state": {"neighbourhood", "operator", "contact", "time", "case"},
    "neighbourhood": {"model", "operator", "contact", "time", "case"},
    "model": {"operator", "contact", "time", "case"},
    "case": {"state", "model", "operator", "contact", "time", "scheduler"},
    "operator": {"time", "contact", "case", "scheduler"},
    "contact": {"operator", "time", "case", "scheduler"},
    "time": {"case", "scheduler", "io"},
    "plugins": {"state", "model", "operator", "contact", "time", "case", "scheduler"},
}


def includes(root):
    """(folder, folder) -> files of the first that include the second."""
    folders = {folder.name for folder in root.iterdir() if folder.is_dir()}
    found = {}
    for file in sorted(root.rglob("*.[ch]pp")):
        own = file.relative_to(root).parts[0]
        for other, header in re.findall(r'^#include "(\w+)/([^"]+)"', file.read_text(), re.MULTILINE):
            if other in folders and other != own:
                found.setdefault((own, other), []).append(f"{file.relative_to(root)} includes {other}/{header}")
    return found


def way_back(start, edges):
    """Folders from `start` over others to itself, or None."""
    queue = [[start]]
    seen = set()
    while queue:
        path = queue.pop(0)
        for own, other in edges:
            if own != path[-1]:
                continue
            if other == start:
                return path + [other]
            if other not in seen:
                seen.add(other)
                queue.append(path + [other])
    return None


def main():
    found = includes(Path(sys.argv[1]))
    failures = [line for (own, other), lines in found.items() if other in UNKNOWN.get(own, ()) for line in lines]
    for folder in sorted({own for own, _ in found}):
        path = way_back(folder, found)
        if path:
            failures.append("folders include each other: " + " -> ".join(path))
            failures += [found[edge][0] for edge in zip(path, path[1:])]
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
