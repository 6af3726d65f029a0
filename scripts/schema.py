"""The JSON schema of a scene, for editors that check TOML as it is typed. Used by scripts/reference.py.

Made from what `titin keys --json` and `titin materials --json` say. It knows names, types, ranges of pure numbers, choices, and
which keys a law takes; it does not know units (only that there is one) nor what depends on the mesh: `titin check` has the last word.
"""
import re

# What the key table does not say: tables that every scene has, the runner's own table, and the two forms of a number that varies.
NEEDED = ["model", "time", "materials"]
NEEDED_BY_MODEL = {"muscle": "mesh", "lagrange": "mesh", "rod": "rod"}
RUNNERS = "test"
# Keys that are required under a condition: on the key beside them, on its absence, or on the model.
WHEN = {
    "time.step": "model = muscle | rod",
    "materials.<NAME>.density": "no fluid",
    "damage.scale": "law = exponential | simo_ju",
    "damage.failure": "law = balzani",
    "activation": "no excitation",
}
DIRECTIONS = ("fibre", "second_fibre")  # also as fields
KINDS_OF_LAWS = {"terms.<NAME>": ("matrix", "fibre", "active"), "volumetric": ("volumetric",), "fluid": ("fluid",)}

NUMBER, UNSIGNED = (sign + r"([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?" for sign in ("[+-]?", "[+]?"))
UNIT = r"(\s*([A-DF-Za-df-z%°µμ][^,]*|[eE]([^0-9+,-][^,]*)?)|\s+1\s*/[^,]*)"


def bounds(text):
    """The range of a key, such as "> 0", "0 to 1", ">= 0 and < 1", as keywords of the schema."""
    words = {">": "exclusiveMinimum", ">=": "minimum", "<": "exclusiveMaximum", "<=": "maximum"}
    both = re.fullmatch(r"(\S+) to (\S+)", text)
    if both:
        return {"minimum": float(both[1]), "maximum": float(both[2])}
    return {words[word]: float(number) for word, number in re.findall(r"([<>]=?) (\S+)", text)}


def text_of_numbers(unit, range_, least, most):
    """Numbers in quotation marks: one unit after the last, or one after each."""
    one = UNSIGNED if range_.get("minimum", range_.get("exclusiveMinimum", -1)) >= 0 else NUMBER
    last = f"{one}{UNIT}" if unit else f"{one}({UNIT})?"
    count = f"{{{least - 1},{'' if most is None else most - 1}}}"
    return {"type": "string", "pattern": rf"^(\s*{one}({UNIT})?\s*,){count}\s*{last}\s*$"}


def numbers(key, least, most):
    range_ = bounds(key["range"])
    text = text_of_numbers(key["unit"], range_, least, most)
    entry = [text_of_numbers(key["unit"], range_, 1, 1)] + ([] if key["unit"] else [{"type": "number", **range_}])
    if (least, most) == (1, 1):
        return [text] if key["unit"] else [entry[1], text]
    size = {"minItems": least, **({} if most is None else {"maxItems": most})}
    return [text, {"type": "array", "items": {"anyOf": entry}, **size}]


def when(key):
    """The condition under which a required key is that; "" for always."""
    return next((text for path, text in WHEN.items() if key["path"] == path or key["path"].endswith("." + path)), "")


def value_of(key):
    """What may stand right of the key: alternatives."""
    kind, range_ = key["type"], bounds(key["range"])
    if key["choices"]:
        return [{"enum": key["choices"]}]
    if kind == "text":
        return [{"type": "string"}]
    if kind == "list of text":
        return [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]
    if kind == "true or false":
        return [{"type": "boolean"}]
    if kind == "text or number":
        return [{"type": ["string", "number", "boolean"]}]
    if kind == "whole number":
        return [{"type": "integer", **range_}]
    if kind.endswith("whole numbers"):
        return [{"type": "array", "items": {"type": "integer", **range_}, "minItems": 1}]
    if kind in ("number", "number or curve in time"):
        return numbers(key, 1, 1) + ([{"$ref": "#/definitions/curve"}] if kind != "number" else [])
    size = re.match(r"(\d+) numbers", kind)  # two where the body is plane; markers of a rod have one
    if size or kind.startswith("numbers"):
        least = int(size[1]) - 1 if size and not key["path"].startswith("markers.") else 1
        found = numbers(key, least, int(size[1]) if size else None)
        return found + ([{"$ref": "#/definitions/directions"}] if key["path"].split(".")[-1] in DIRECTIONS else [])
    raise ValueError(f"{key['path']}: no schema for the type '{kind}'")


def described(key, alternatives):
    facts = [f"[{key['unit']}]" if key["unit"] else "", key["range"] and f"range: {key['range']}",
             key["default"] and f"default: {key['default']}"]  # fmt: skip
    text = "; ".join([key["doc"], *(fact for fact in facts if fact)])
    return {**({"description": text} if text else {}), **(alternatives[0] if len(alternatives) == 1 else {"anyOf": alternatives})}


class Table:
    """A table of a scene with the keys and tables in it; `named` is what a table of any other name holds."""

    def __init__(self):
        self.doc, self.keys, self.tables, self.named = "", {}, {}, None

    @classmethod
    def of(cls, records):
        root = cls()
        for record in records:
            root.add(record["path"].split("."), record)
        return root

    def add(self, path, record):
        if len(path) == 1 and record["type"] != "table" and path[0] != "<NAME>":
            self.keys[path[0]] = record
            return
        if path[0] == "<NAME>":
            if len(path) == 1 and record["type"] != "table":
                self.named = record
                return
            self.named = self.named or Table()
            below = self.named
        else:
            below = self.tables.setdefault(path[0], Table())
        if len(path) > 1:
            below.add(path[1:], record)
        else:
            below.doc = record["doc"]


def conditions(keys):
    """Keys that are required under a condition: "law = a | b" on the key beside them, or "no key"."""
    for name, key in keys.items():
        condition = when(key) if key["required"] else ""
        if condition.startswith("no "):
            yield {"if": {"not": {"required": [condition[3:]]}}, "then": {"required": [name]}}
        elif condition and not condition.startswith("model = "):  # that one is for the top
            other, _, words = condition.partition(" = ")
            yield {"if": {"properties": {other: {"enum": words.split(" | ")}}, "required": [other]}, "then": {"required": [name]}}


def parts_of(table, path, laws):
    properties = {name: described(key, value_of(key)) for name, key in table.keys.items()}
    for name, below in table.tables.items():
        schema = object_of(below, f"{path}.{name}", laws)
        properties[name] = {"anyOf": [properties[name], schema]} if name in properties else schema
    return properties


def object_of(table, path, laws):
    kinds = next((kinds for end, kinds in KINDS_OF_LAWS.items() if path.endswith(end)), None)
    if kinds and path.endswith(".mix.terms.<NAME>"):
        return {"$ref": "#/definitions/term"}
    schema = {"type": "object", "properties": parts_of(table, path, laws), "additionalProperties": False}
    if table.doc:
        schema["description"] = table.doc
    if isinstance(table.named, Table):
        schema["additionalProperties"] = object_of(table.named, f"{path}.<NAME>", laws)
    elif table.named:
        schema["additionalProperties"] = described(table.named, value_of(table.named))
    required = [name for name, key in table.keys.items() if key["required"] and not when(key)]
    rules = list(conditions(table.keys))
    if kinds:
        add_laws(schema, [law for law in laws if law["kind"] in kinds], rules, table.keys["law"]["default"])
    schema.update({"required": required} if required else {}, **({"allOf": rules} if rules else {}))
    return schema


def may_vary(law, schema):
    """Numbers of a term's law also take a curve in time or a field in space."""
    if law["kind"] in ("volumetric", "fluid") or "description" not in schema:
        return schema
    alternatives = schema.get("anyOf") or [{k: v for k, v in schema.items() if k != "description"}]
    if not all(a.get("type") in ("number", "string") and (a["type"] == "number" or "pattern" in a) for a in alternatives):
        return schema
    forms = [{"$ref": "#/definitions/curve"}, {"$ref": "#/definitions/field"}]
    return {"description": schema["description"], "anyOf": alternatives + forms}


def add_laws(schema, laws, rules, default):
    """All keys of all laws, for completion, and for each law a rule which of them it takes."""
    shared, everything = list(schema["properties"]), {}
    for law in laws:
        table = Table.of(law["parameters"])
        own = {name: may_vary(law, part) for name, part in parts_of(table, "", laws).items()}
        for name, part in own.items():
            everything.setdefault(name, []).append(part)
        takes = {"properties": own, "propertyNames": {"enum": shared + [name for name in own if name not in shared]}}
        required = [name for name, key in table.keys.items() if key["required"] and not when(key)]
        takes.update({"required": required} if required else {}, **({"allOf": r} if (r := list(conditions(table.keys))) else {}))
        is_law = {"properties": {"law": {"const": law["name"]}}, **({} if law["name"] == default else {"required": ["law"]})}
        rules.append({"if": is_law, "then": takes})
    for name, parts in everything.items():
        different = [part for k, part in enumerate(parts) if part not in parts[:k]]
        schema["properties"][name] = different[0] if len(different) == 1 else {"anyOf": different}


def forms():
    """How a number varies: a curve in time, a field in space."""
    plain = {"required": True, "range": "", "default": "", "choices": [], "doc": "", "path": ""}
    def text(unit): return {"anyOf": numbers({**plain, "unit": unit}, 1, None)}  # noqa: E704
    word, size = {"type": "string"}, {"anyOf": numbers({**plain, "unit": "m"}, 1, 1)}
    options = {"field": word, "between": {"enum": ["linear", "nearest"]}, "at": {"enum": ["points", "cells"]}, "reach": size}
    columns = {"type": "array", "items": word, "minItems": 3, "maxItems": 3}
    curve = {"time": text("s"), "value": text(""), "file": word, "column": word, "scale": {"anyOf": numbers({**plain, "unit": ""}, 1, 1)}}

    def table(properties, needs):
        return {"type": "object", "properties": properties, "additionalProperties": False, "oneOf": [{"required": n} for n in needs]}

    return {"curve": table(curve, [["time", "value"], ["file"]]), "field": table({**options, "column": word}, [["field"]]),
            "directions": table({**options, "columns": columns}, [["field"]])}  # fmt: skip


def schema_of(keys, laws):
    root = Table.of(keys)
    schema = object_of(root, "", laws)
    terms = schema["properties"]["materials"]["additionalProperties"]["properties"]["terms"]
    term, terms["additionalProperties"] = terms["additionalProperties"], {"$ref": "#/definitions/term"}
    schema["properties"][RUNNERS] = {"type": "object", "description": "how the tests run this scene; the program ignores it"}
    schema["required"] = NEEDED
    schema["allOf"] = [{"if": {"properties": {"model": {"const": model}}}, "then": {"required": [table]}}
                       for model, table in NEEDED_BY_MODEL.items()]  # fmt: skip
    for key in keys:
        if key["required"] and when(key).startswith("model = "):
            table, _, name = key["path"].rpartition(".")
            schema["allOf"].append(
                {"if": {"properties": {"model": {"enum": when(key).removeprefix("model = ").split(" | ")}}},
                 "then": {"properties": {table: {"required": [name]}}}})  # fmt: skip
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "A scene of Titin",
            "$comment": "Written by scripts/reference.py; do not edit."}  # fmt: skip
    return {**head, **schema, "definitions": {"term": term, **forms()}}
