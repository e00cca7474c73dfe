"""Reads a DXF file back with ezdxf and prints as JSON what it holds and what is wrong with it:
errors, fixes: of ezdxf's audit; logged: what its reader complained of; structure: of handles, which the reader mends in silence."""
import json
import logging
import sys

import ezdxf
from ezdxf.lldxf.encoding import decode_dxf_unicode

POINTERS = {"330", "340", "350", "360", "390"}


class Keeper(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.messages = []

    def emit(self, record):
        self.messages.append(record.getMessage())


def check_handles(path):
    """Handles are unique and below the seed, pointers lead to one, and each record has an owner."""
    with open(path, encoding="cp1252") as file:
        lines = file.read().split("\n")
    pairs = [(lines[i].strip(), lines[i + 1]) for i in range(0, len(lines) - 1, 2)]
    problems, handles, pointers, seed, section, kind, owner = [], set(), [], None, "", "", None
    for i, (code, value) in enumerate(pairs):
        if code == "0":
            if section in ("TABLES", "BLOCKS", "ENTITIES", "OBJECTS") and kind not in ("SECTION", "ENDTAB", "") and owner is None:
                problems.append(f"{kind} in {section} has no owner")
            kind, owner = value, None
            if kind == "ENDSEC":
                section, kind = "", ""
        elif pairs[i - 1] == ("0", "SECTION"):
            section = value
        elif section == "HEADER":
            if pairs[i - 1] == ("9", "$HANDSEED"):
                seed = int(value, 16)
        elif code == ("105" if kind == "DIMSTYLE" else "5"):
            if value in handles:
                problems.append(f"handle {value} of {kind} is there twice")
            handles.add(value)
        elif code in POINTERS:
            pointers.append((kind, value))
            if code == "330":
                owner = value
    problems += [f"{kind} points to {value}, which is not there" for kind, value in pointers if value not in handles | {"0"}]
    if seed is None or any(int(handle, 16) >= seed for handle in handles):
        problems.append(f"handles are not below the seed {seed}")
    return problems


def entry_of(entity):
    dxf, kind = entity.dxf, entity.dxftype()
    entry = {"type": kind, "layer": dxf.layer}
    if kind == "LWPOLYLINE":
        entry.update(closed=bool(entity.closed), points=[[p[0], p[1]] for p in entity.get_points()])
    elif kind == "LINE":
        entry["points"] = [list(dxf.start), list(dxf.end)]
    elif kind == "ARC":
        entry.update(points=[list(dxf.center), list(entity.start_point), list(entity.end_point)], radius=dxf.radius)
    elif kind == "TEXT":
        entry.update(text=decode_dxf_unicode(dxf.text), height=dxf.height, rotation=dxf.rotation, points=[list(dxf.align_point)])
    elif kind == "DIMENSION":
        shown = [entry_of(e) for e in entity.get_geometry_block()]
        text = next(e for e in shown if e["type"] == "TEXT")
        style = entity.get_dim_style()
        entry.update(text=text["text"], height=text["height"], rotation=text["rotation"], angle=dxf.angle, style=dxf.dimstyle,
                     measured=entity.get_measurement(), stated=dxf.actual_measurement, moved=bool(dxf.dimtype & 128),
                     unit=style.dxf.dimlunit, decimals=style.dxf.dimdec, shown=shown,
                     points=[list(dxf.defpoint), list(dxf.defpoint2), list(dxf.defpoint3), list(dxf.text_midpoint)])
    return entry


keeper = Keeper()
logging.getLogger("ezdxf").addHandler(keeper)
doc = ezdxf.readfile(sys.argv[1])
audit = doc.audit()
print(json.dumps({
    "errors": [e.message for e in audit.errors],
    "fixes": [e.message for e in audit.fixes],
    "logged": keeper.messages,
    "structure": check_handles(sys.argv[1]),
    "version": doc.dxfversion,
    "units": doc.header["$INSUNITS"],
    "metric": doc.header["$MEASUREMENT"],
    "comment": next((line.strip() for line in open(sys.argv[1], encoding="cp1252").read().split("\n")[1:2]), ""),
    "code_page": doc.header["$DWGCODEPAGE"],
    "extents": [list(doc.header["$EXTMIN"]), list(doc.header["$EXTMAX"])],
    "view": list(doc.viewports.get("*Active")[0].dxf.center),
    "layers": [layer.dxf.name for layer in doc.layers],
    "entities": [entry_of(e) for e in doc.modelspace()],
}))
