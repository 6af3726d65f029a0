#!/usr/bin/env python3
"""Writes what follows from what the program says of itself: docs/reference/ (keys.md, materials.md, and scene.schema.json for
editors) and scripts/completion.bash.

scripts/reference.py            writes the files
scripts/reference.py --check    fails if they are not what the program says (a test runs this)

--titin PROGRAM names the program (default: build/bin/titin).
"""
import argparse
import json
import pathlib
import subprocess
import sys

from completion import completion_of
from schema import schema_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "reference"
KINDS = {
    "matrix": "Matrix: isotropic, or with a texture of its own",
    "fibre": "Fibres: passive",
    "active": "Fibres: active",
    "volumetric": "Volumetric functions",
    "fluid": "Fluids and equations of state",
}


def ask(titin, *words):
    return json.loads(subprocess.run([titin, *words, "--json"], check=True, capture_output=True, text=True).stdout)


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def type_of(key):
    if key["choices"]:
        return " \\| ".join(f"`{choice}`" for choice in key["choices"])
    return key["type"] + (f" [{key['unit']}]" if key["unit"] else "")


def table(keys):
    lines = ["| key | type [unit] | default | range | meaning |", "|---|---|---|---|---|"]
    for key in keys:
        default = "required" if key["required"] else f"`{key['default']}`" if key["default"] else ""
        lines.append(f"| `{key['path']}` | {type_of(key)} | {default} | {cell(key['range'])} | {cell(key['doc'])} |")
    return lines


def keys_page(keys):
    lines = ["# Keys of a scene", "", "Written by `scripts/reference.py` from `titin keys --json`; do not edit.", ""]
    group, heads = [], {key["path"]: key["doc"] for key in keys if key["type"] == "table"}
    current = None
    for key in [*(k for k in keys if k["type"] != "table"), None]:
        parent = None if key is None else key["path"].rpartition(".")[0]
        if group and (key is None or parent != current):
            lines += [f"## `[{current}]`" if current else "## At the top", ""]
            if heads.get(current):
                lines += [heads[current][0].upper() + heads[current][1:] + ".", ""]
            lines += [*table(group), ""]
            group = []
        current = parent
        group.append(key)
    return "\n".join(lines).rstrip() + "\n"


def law_section(law):
    lines = [f"### `{law['name']}`", "", f"    {law['formula']}", "", f"{law['source']}.", ""]
    if law["parameters"]:
        lines += [*table(law["parameters"]), ""]
    for found in law["published"]:
        lines += [f"* {found['tissue']}: `{found['parameters']}` ({found['source']})"]
    if law["unpublished"]:
        lines += [f"No published set: {law['unpublished'][0].lower()}{law['unpublished'][1:]}"]
    return lines + [""]


def materials_page(laws):
    lines = ["# Laws of materials", "", "Written by `scripts/reference.py` from `titin materials --json`; do not edit.",
             "How they add up, and what can be wrapped around a term: [theory](../theory/materials.md).", ""]
    for kind, title in KINDS.items():
        of_kind = [law for law in laws if law["kind"] == kind]
        lines += [f"## {title}", ""]
        for law in sorted(of_kind, key=lambda law: law["name"]):
            lines += law_section(law)
    return "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--titin", default=str(ROOT / "build" / "bin" / "titin"))
    arguments = parser.parse_args()
    keys, laws = ask(arguments.titin, "keys"), ask(arguments.titin, "materials")
    files = {
        PAGES / "keys.md": keys_page(keys),
        PAGES / "materials.md": materials_page(laws),
        PAGES / "scene.schema.json": json.dumps(schema_of(keys, laws), indent=1, ensure_ascii=False) + "\n",
        ROOT / "scripts" / "completion.bash": completion_of(arguments.titin, keys, laws),
    }
    stale = [str(path.relative_to(ROOT)) for path, text in files.items() if not path.exists() or path.read_text() != text]
    if not arguments.check:
        PAGES.mkdir(parents=True, exist_ok=True)
        for path, text in files.items():
            path.write_text(text)
    if arguments.check and stale:
        sys.exit(f"{', '.join(stale)}: not what the program says; run scripts/reference.py")
    print(f"{len(files)} files {'in order' if arguments.check else 'written'}")


if __name__ == "__main__":
    main()
