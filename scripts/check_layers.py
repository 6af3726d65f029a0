#!/usr/bin/env python3
"""Checks who includes whom: docs/architecture.md's table, held against every #include of src/ and miniapps/.

Prints one line for each include that a layer may not have; exit 1 if there is any. Also a ctest ("layers").
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# layer: the layers that it may include besides itself. Formulations do not know each other, nor files (io).
MAY_INCLUDE = {
    "base": [],
    "math": ["base"],
    "materials": ["math", "base"],
    "point": ["materials", "math", "base"],
    "mesh": ["math", "base"],
    "solve": ["math", "base"],
    "io": ["mesh", "solve", "math", "base"],
    "fe": ["solve", "mesh", "materials", "math", "base"],
    "fv": ["solve", "mesh", "materials", "math", "base"],
    "rod": ["solve", "mesh", "materials", "math", "base"],
    "scene": ["fe", "fv", "rod", "io", "solve", "mesh", "materials", "math", "base"],
    "miniapps": ["scene", "point", "fe", "fv", "rod", "io", "solve", "mesh", "materials", "math", "base"],
}

# Libraries that a layer must stay without, by how their headers begin.
NEVER = {
    "base": ["mfem", "petsc", "HYPRE", "hdf5", "CGAL/"],
    "math": ["mpi.h", "mfem", "petsc", "HYPRE", "hdf5", "toml++", "fmt/", "udunits2", "fstream", "iostream", "CGAL/"],
    "materials": ["mpi.h", "mfem", "petsc", "HYPRE", "hdf5", "toml++", "udunits2", "fstream", "iostream", "CGAL/"],
    "point": ["mpi.h", "mfem", "petsc", "HYPRE", "hdf5", "toml++", "udunits2", "CGAL/"],
    "mesh": ["petsc", "hdf5", "toml++", "CGAL/"],
    "solve": ["hdf5", "toml++", "CGAL/"],
    "io": ["petsc", "toml++", "CGAL/"],
    "fe": ["hdf5", "toml++", "CGAL/"],
    "fv": ["hdf5", "toml++", "CGAL/"],
    "rod": ["hdf5", "toml++", "CGAL/"],
    "scene": ["hdf5", "toml++", "CGAL/"],
}

# The single place of a library.
ONLY_HERE = {
    "mpi.h": ["src/base/exchange.hpp", "src/base/parallel.hpp"],
    "udunits2": ["src/base/units.cpp"],
}
# Calls of raw MPI anywhere but in base.
RAW_MPI = re.compile(r"\bMPI_(?!Comm\b|COMM_)[A-Z][A-Za-z_]*\s*\(")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    parts = path.relative_to(ROOT).parts
    return "miniapps" if parts[0] == "miniapps" else parts[1] if len(parts) > 2 else None


def faults_of(path):
    layer = layer_of(path)
    name = path.relative_to(ROOT).as_posix()
    if layer not in MAY_INCLUDE:
        yield 1, f"'{name}' is in no layer; the layers are {', '.join(MAY_INCLUDE)}"
        return
    for number, line in enumerate(path.read_text().splitlines(), 1):
        include = INCLUDE.match(line)
        if include:
            quote, header = include.groups()
            target = header.split("/")[0]
            ours = (ROOT / "src" / header).exists() or (quote == '"' and target in MAY_INCLUDE)
            if ours:
                if target != layer and target not in MAY_INCLUDE[layer]:
                    yield number, f"{layer} may not include {header} (it may include {', '.join(MAY_INCLUDE[layer]) or 'nothing of ours'})"
            elif quote == '"' and not (path.parent / header).exists():
                yield number, f'"{header}" is not under src/: libraries are included with <>'
            elif quote == '"':
                yield number, f'write our own headers from src/: "{path.parent.name}/{header}"'
            else:
                if any(header.startswith(prefix) for prefix in NEVER.get(layer, [])):
                    yield number, f"{layer} may not use <{header}>"
                for prefix, files in ONLY_HERE.items():
                    if header.startswith(prefix) and not any(name.startswith(f.rsplit(".", 1)[0] + ".") for f in files):
                        yield number, f"<{header}> belongs to {' or '.join(files)} alone"
        elif layer != "base" and RAW_MPI.search(line.split("//")[0]):
            yield number, "raw MPI belongs in src/base/parallel.cpp: add what is missing there"


def main():
    files = sorted(p for folder in ("src", "miniapps") for p in (ROOT / folder).rglob("*") if p.suffix in (".hpp", ".cpp", ".h"))
    faults = 0
    for path in files:
        for number, fault in faults_of(path):
            faults += 1
            print(f"{path.relative_to(ROOT)}:{number}: {fault}")
    if faults:
        print(f"{faults} includes break the layers; the table is in docs/architecture.md")
        return 1
    print(f"layers hold in {len(files)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
