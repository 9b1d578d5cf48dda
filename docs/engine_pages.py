#!/usr/bin/env python3
"""Writes docs/engines/LIBRARY.md, one page for each library, from the cards of its engines and from the tables of docs/.

    ./touchstone engines --json | docs/engine_pages.py [DIRECTORY]

DIRECTORY defaults to docs/engines. tests/packages/docs_test.cpp checks that the stored pages are what this writes.
"""
import json
import pathlib
import re
import sys

DOCS = pathlib.Path(__file__).parent
# File, title, how the names of its engines begin, how its rows in the table of broad phases begin, its section of
# versions.md (None: its releases were not compared).
LIBRARIES = [
    ("fcl", "FCL", "fcl-", "FCL ", None),
    ("bullet", "Bullet", "bullet-", "Bullet ", None),
    ("libccd", "libccd", "libccd-", None, None),
    ("ode", "ODE", "ode", "ODE ", None),
    ("jolt", "Jolt Physics", "jolt", "Jolt ", "jolt"),
    ("rapier", "Rapier", "rapier", "Rapier", "rapier"),
    ("mujoco", "MuJoCo", "mujoco", None, "mujoco"),
    ("physx", "PhysX", "physx", "PhysX ", "physx-gjk"),
    ("havok", "Havok", "havok", None, "havok"),
    ("cannon", "cannon-es", "cannon", None, "cannon"),
]


def section(text, heading):
    """The text under '## heading', up to the next heading of that level."""
    found = re.search(rf"^## {re.escape(heading)}$(.*?)(?=^## |\Z)", text, re.M | re.S)
    if not found:
        sys.exit(f"engine_pages.py: no section '{heading}'")
    return found.group(1)


def rows(text):
    """The cells of the rows of the tables in a text, without heads and rulers."""
    lines = [[c.strip() for c in l.strip().strip("|").split("|")] for l in text.splitlines() if l.startswith("|")]
    return [cells for i, cells in enumerate(lines)
            if not set("".join(cells)) <= set("-: ")
            and not (i + 1 < len(lines) and set("".join(lines[i + 1])) <= set("-: ") and "".join(lines[i + 1]))]


def table(head, body):
    rule = "|" + "---|" * len(head)
    return "\n".join(["| " + " | ".join(head) + " |", rule] + ["| " + " | ".join(r) + " |" for r in body])


def roundoff(card):
    return "double" if card["unit_roundoff"] < 1e-12 else "single"


def card_lines(card):
    lines = [f"### `{card['name']}`", "", f"{card['library']} {card['version']}, {roundoff(card)} precision. Settings: {card['settings']}.", "",
             f"Documented tolerances, and where they are stated: {card['source'] or 'none'}."]
    biases = card.get("depth_biases") or {}
    for shapes, bias in biases.items():
        lines.append(f"For {shapes.replace(' ', ' and ')}, a normal may need {100 * bias:g} % more depth than the least.")
    if card.get("separate_triangles"):
        lines.append("Contacts with a mesh are those of its single triangles.")
    return lines + [""]


def faults(findings, prefix):
    return [c for c in rows(section(findings, "Faults of the engines as shipped")) if c[0].strip("`").startswith(prefix)]


def npm_faults(findings, prefix):
    return [c for c in rows(section(findings, "Engines installed on request")) if c[0].strip("`").startswith(prefix)]


def releases(findings, prefix):
    out, asked = [], {}
    for c in rows(section(findings, "Releases")):
        asked.setdefault(c[0], c[1])
        if c[0].strip("`").startswith(prefix):
            out.append([c[0], c[1] or asked[c[0]], c[2], c[3], c[4]])
    return out


def broad(findings, start):
    if not start:
        return []
    out, inside = [], False
    for c in rows(section(findings, "Broad phases")):
        inside = c[0].startswith(start) or (inside and c[0].startswith("the same"))
        if inside:
            out.append(c)
    return out


def page(library, cards, docs):
    file, title, prefix, start, versions = library
    own = [c for c in cards if c["name"].startswith(prefix) and c.get("library")]
    out = [f"# {title}", "", "Written by `docs/engine_pages.py` from the cards of the engines and the tables of "
           "[findings.md](../findings.md), [versions.md](../versions.md) and [upstream/](../upstream/README.md).", ""]
    out += ["## Engines", ""]
    if own:
        for card in own:
            out += card_lines(card)
    else:
        out += [f"`./touchstone engines --install {file}` installs it from npm ([engines.md](../engines.md#engines-from-npm)); "
                f"`./touchstone engines {file}` then prints its card.", ""]
    shown = faults(docs["findings"], prefix)
    if shown:
        out += ["## Faults", "", "`./touchstone replay CASE` shows each, and `./touchstone reproduce CASE --engine ENGINE` writes it as a "
                "program that needs only the library. A case is given by its name or by its file in `scenarios/corpus`.", "",
                table(["engine", "question", "fault", "answer", "case"], shown), ""]
    shown = npm_faults(docs["findings"], prefix)
    if shown:
        out += ["## Faults", "", "Each is shown by a program against the library alone.", "",
                table(["engine", "question", "answer", "truth, by hand"], shown), ""]
    shown = [c for c in rows(docs["upstream"]) if c[0] == title]
    if shown:
        out += ["## Faults traced to a line", "", table(["engine", "fault", "report"],
                [[c[0], c[1], re.sub(r"\]\(", "](../upstream/", c[2])] for c in shown]), ""]
    shown = broad(docs["findings"], start)
    if shown:
        out += ["## Broad phases", "", "[findings.md](../findings.md#broad-phases) says when and how they were certified.", "",
                table(["broad phase", "level of boxes", "smallest scripts", "level of bodies"], shown), ""]
    shown = releases(docs["findings"], prefix)
    if shown:
        out += ["## Releases", "", table(["engine", "releases asked", "cause", "introduced in", "gone since"], shown), ""]
        if versions and not re.search(rf"^## {versions} ", docs["versions"], re.M):
            sys.exit(f"engine_pages.py: versions.md has no section about {versions}")
        out += ["The full table is in [versions.md](../versions.md).", ""]
    return "\n".join(out)


def main():
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "engines"
    cards = json.load(sys.stdin)
    docs = {"findings": (DOCS / "findings.md").read_text(), "versions": (DOCS / "versions.md").read_text(),
            "upstream": (DOCS / "upstream" / "README.md").read_text()}
    out.mkdir(parents=True, exist_ok=True)
    for library in LIBRARIES:
        # A card lists what is installed here; the pages of engines from npm must not depend on it.
        known = cards if library[4] is None else []
        (out / f"{library[0]}.md").write_text(page(library, known, docs))


if __name__ == "__main__":
    main()
