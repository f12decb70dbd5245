#!/usr/bin/env python3
"""Rules of size and order, read from universal-ctags and from #includes, for folders of sources.

Functions: at most 80 lines, less than 15 in a row without a blank line or a comment. Types: at most 20 data members,
one meaning for a name, every class in one .h and one .cpp. Files of a folder: no circle of #includes.
The rules of types do not hold for a folder that is called tests.

declarations.py FOLDER... prints every fault. Without a folder: finds what is planted."""
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

MOST_LINES, MOST_IN_A_ROW, MOST_MEMBERS = 80, 14, 20
SUFFIXES = (".h", ".cpp", ".inc")
TYPES = {"class", "struct", "union", "enum", "typedef"}
CTAGS = ["ctags", "--output-format=json", "--fields=+neKZt", "--kinds-C++=cfgstum", "--langmap=C++:+.inc", "--language-force=C++",
         "-f", "-", "-L", "-"]


def tags(root):
    """One dictionary for each declaration. Unnamed namespaces leave the scopes, as the program's own does."""
    names = "".join(f"{path}\n" for path in sorted(pathlib.Path(root).rglob("*")) if path.suffix in SUFFIXES)
    for line in subprocess.run(CTAGS, input=names, capture_output=True, text=True, check=True).stdout.splitlines():
        tag = json.loads(line)
        tag["scope"] = re.sub(r"(^|::)(carom|__anon\w+)(?=::|$)", "", tag.get("scope", "")).strip(":")
        tag["full"] = f"{tag['scope']}::{tag['name']}".strip(":")
        if not tag["name"].startswith("__anon"):
            yield tag


def longest_block(lines):
    """The most lines in a row that are neither blank nor a comment alone."""
    longest = length = 0
    for line in lines:
        length = 0 if re.match(r"\s*(//|$)", line) else length + 1
        longest = max(longest, length)
    return longest


def function_faults(functions):
    texts = {}
    for tag in functions:
        lines = texts.setdefault(tag["path"], pathlib.Path(tag["path"]).read_text().splitlines())
        body = lines[tag["line"] - 1 : tag["end"]]
        if len(body) > MOST_LINES:
            yield f"{tag['path']}: {tag['full']} has {len(body)} lines"
        if (row := longest_block(body)) > MOST_IN_A_ROW:
            yield f"{tag['path']}:{tag['line']}: {tag['full']} has {row} lines in a row"


def type_faults(declared):
    members, types = collections.defaultdict(set), collections.defaultdict(dict)
    for tag in declared:
        if tag["kind"] == "member" and "static constexpr" not in tag["pattern"]:
            members[tag["path"], tag["scope"]].add(tag["name"])
        # Kernels in .inc files are compiled several times; a specialization is no other type.
        elif tag["kind"] in TYPES and tag.get("scopeKind") not in TYPES:
            if not re.search(tag["name"] + r" ?(<|::)|\.inc$", tag["pattern"][:-2] + tag["path"]):
                types[tag["full"]][f"{tag['path']}:{tag['line']}"] = tag.get("typeref", f"{tag['path']}:{tag['line']}")

    for (path, scope), names in members.items():
        if len(names) > MOST_MEMBERS:
            yield f"{path}: {scope} has {len(names)} data members"
    for name, places in types.items():
        if len(set(places.values())) > 1:
            yield f"{name} is in {' '.join(places)}"


def scattered_classes(declared):
    """Functions in the class itself, or inline in its header, count for no file."""
    homes = {tag["full"]: tag["path"] for tag in declared if tag["kind"] in TYPES}
    parts = collections.defaultdict(set)
    for tag in declared:
        if tag["kind"] == "function" and "end" in tag and tag["scope"] in homes:
            home = homes[tag["scope"]]
            if home != tag["path"] or not home.endswith(".h"):
                parts[tag["scope"]].add(tag["path"])
    for name, paths in parts.items():
        if len(paths) > 1:
            yield f"{name} is in {' '.join(sorted(paths))}"


def circles(root):
    """Files of one folder that include each other, a .h and its .cpp as one."""
    root = pathlib.Path(root)
    includes = collections.defaultdict(set)
    for path in sorted(root.rglob("*")):
        if path.suffix in SUFFIXES:
            name = path.relative_to(root).with_suffix("")
            for other in re.findall(r'#include "([^"]+)"', path.read_text()):
                other = pathlib.PurePath(other).with_suffix("")
                if other.parent == name.parent and other != name:
                    includes[str(name)].add(str(other))

    # All that a file reaches; files that reach each other are a circle.
    reached = {}
    for name in list(includes):
        found, ahead = set(), [name]
        while ahead:
            news = includes[ahead.pop()] - found
            found |= news
            ahead += news
        reached[name] = found
    rings = {tuple(sorted(other for other in found if name in reached.get(other, ()))) for name, found in reached.items()}
    return [f"{' '.join(ring)} include each other" for ring in sorted(rings) if ring]


def faults(root):
    declared = list(tags(root))
    yield from function_faults([tag for tag in declared if tag["kind"] == "function" and "end" in tag])
    yield from circles(root)
    if pathlib.Path(root).name != "tests":
        yield from type_faults(declared)
        yield from scattered_classes(declared)


def planted(folder):
    """One fault of each sort, and what comes close to one."""

    def calls(count):
        return "  f();\n" * count

    def data(count):
        return "".join(f"  int m{i};\n" for i in range(count))

    blocks = "\n".join([calls(12)] * 5)
    files = {
        "a.cpp": f"void g() {{\n{blocks}\n{calls(12)}\n}}\nvoid h() {{\n{blocks}\n{calls(12)}\n\n}}\n"
        f"const int t[] = {{{chr(10) * 100}1}};\n",
        "b.h": f"struct B {{\n{data(20)}  static constexpr int a = 1;\n  void f();\n}};\nstruct C {{\n{data(21)}}};\n",
        "d.h": "class D { void f(); void g(); void h(); };\ninline void D::h() {}\nclass E; using A = int;\n",
        "d.cpp": '#include "d.h"\nvoid D::f() {}\nnamespace { class E {}; }\nusing A = int;\n',
        "e.cpp": "void D::g() {}\nnamespace n { struct N { class E {}; }; }\nstruct E { enum K { k }; };\nusing A = bool;\n",
        "p.cpp": f"void p() {{\n{calls(13)}\n{calls(12)}  // Why.\n{calls(13)}}}\n",
        "q.cpp": f"void q() {{\n  const auto r = [] {{\n{calls(11)}  }};\n}}\n",
        "in/x.h": '#include "in/y.h"\n#include "b.h"\n',
        "in/y.cpp": '#include "in/y.h"\n#include "in/z.h"\n',
        "in/z.h": '#include "in/x.h"\n',
        "in/notes.md": f"void notes() {{\n{calls(20)}}}\n",
    }
    for name, text in files.items():
        for part in ("src", "tests"):
            path = pathlib.Path(folder, part, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)


EXPECTED = {
    "src": [
        "A is in d.cpp:4 d.h:3 e.cpp:4",
        "D is in d.cpp e.cpp",
        "E is in d.cpp:3 e.cpp:3",
        "a.cpp: h has 81 lines",
        "b.h: C has 21 data members",
        "in/x in/y in/z include each other",
        "q.cpp:1: q has 15 lines in a row",
    ],
    "tests": [
        "a.cpp: h has 81 lines",
        "in/x in/y in/z include each other",
        "q.cpp:1: q has 15 lines in a row",
    ],
}

if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit("\n".join(sorted(fault for root in sys.argv[1:] for fault in faults(root))) or 0)
    with tempfile.TemporaryDirectory() as place:
        planted(place)
        for part, expected in EXPECTED.items():
            found = sorted(fault.replace(f"{place}/{part}/", "") for fault in faults(f"{place}/{part}"))
            assert found == expected, (part, found)
