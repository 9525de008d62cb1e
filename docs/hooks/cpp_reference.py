# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The C++ and C reference: one page per public header, in the order of the header, from its comments.

Each complaint of doxygen (a public name without a comment, a comment with an unknown name) is a warning of the site,
and so fails a strict build. The groups of pages are in the `nav` of mkdocs.yml, below `reference/cpp/`. A header that is
missing there is a warning too.
"""

from __future__ import annotations

import logging
import re
from collections import defaultdict
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

from doxygen_xml import description, plain, run_doxygen
from mkdocs.structure.files import File

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

log = logging.getLogger("mkdocs.hooks.cpp_reference")

CLASSES = ("class", "struct")
LINE = 88  # longer declarations are broken
TITLES = {"concept": "Concept", "enum": "Enumeration", "typedef": "Type", "variable": "Constant", "define": "Macro"}


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds the pages."""
    compounds, complaints = run_doxygen(Path(config.config_file_path).parent / "include")
    for complaint in complaints:
        log.warning("%s", complaint)
    reference = Reference(compounds)
    groups = groups_of_nav(config.nav or [])
    files.append(File.generated(config, "reference/cpp/index.md", content=reference.index(groups)))
    for header in reference.headers:
        files.append(File.generated(config, f"reference/cpp/{page_of(header)}", content=reference.page(header)))
    return files


@dataclass
class Item:
    """A declaration of a header, or a member of a class. `name` is without the library's namespace."""

    element: Element
    name: str
    kind: str
    members: list[Item] = field(default_factory=list)

    @property
    def id(self) -> str:
        return self.element.get("id", "")

    @property
    def place(self) -> tuple[str, int]:
        location = self.element.find("location")
        assert location is not None
        return location.get("file", ""), int(location.get("line", "0"))

    @property
    def is_c(self) -> bool:
        return self.place[0].endswith(".h")

    @property
    def short_name(self) -> str:
        return self.name.rpartition("::")[2]


class Reference:
    """Every header with its declarations, and the anchor of each declaration."""

    def __init__(self, compounds: list[Element]) -> None:
        self.headers: dict[str, list[Item]] = defaultdict(list)
        self.links: dict[str, str] = {}  # doxygen's ids -> page#anchor
        self.intros: dict[str, Element] = {}  # comments on whole headers
        structs = {plain(compound.find("compoundname")) for compound in compounds if compound.get("kind") == "struct"}
        for compound in compounds:
            kind, name = compound.get("kind", ""), plain(compound.find("compoundname")).removeprefix("flagstone::")
            if kind in (*CLASSES, "concept") and compound.get("prot", "public") == "public":
                self.add(Item(compound, name, kind, members_of(compound, f"{name}::")))
            elif kind in ("file", "namespace"):
                if kind == "file":
                    location = compound.find("location")
                    assert location is not None
                    self.intros[location.get("file", "")] = compound
                for item in members_of(compound, ""):
                    if plain(item.element.find("type")) != f"struct {item.name}" or item.name not in structs:
                        self.add(item)
        for header, items in self.headers.items():
            items.sort(key=lambda item: item.place)
            taken: set[str] = set()
            for item in [each for owner in items for each in (owner, *owner.members)]:
                anchor = f"cpp-{re.sub('[^a-z0-9]+', '-', item.name.lower())}".strip("-")
                taken.add(anchor := anchor if anchor not in taken else f"{anchor}-{item.place[1]}")
                self.links[item.id] = f"{page_of(header)}#{anchor}"
                self.links |= {value.get("id", ""): self.links[item.id] for value in item.element.iterfind("enumvalue")}

    def add(self, item: Item) -> None:
        self.headers[item.place[0]].append(item)

    def doc(self, item: Item | Element) -> str:
        element = item.element if isinstance(item, Item) else item
        return description(element, lambda refid: None if refid == element.get("id") else self.links.get(refid))

    def anchor(self, item: Item) -> str:
        return self.links[item.id].partition("#")[2]

    def index(self, groups: dict[str, list[str]]) -> str:
        lines = [
            "# C++ reference\n",
            "One page per header of `include/flagstone`. `#include <flagstone/flagstone.hpp>` includes all headers",
            "except `make_segmenter.hpp` and the baselines. Link the target `flagstone::flagstone`; for the baselines, link",
            "`flagstone::baselines`.",
        ]
        headers = {page_of(header): header for header in self.headers}
        for group, pages in groups.items():
            lines += [f"\n## {group}\n", "| name | meaning | header |", "|---|---|---|"]
            for page in pages:
                items = [item for item in self.headers[headers[page]] if item.name != "to_string"]
                for name, same in groupby(items, key=lambda item: item.name):
                    first = next(same)
                    link = f"[`{name}`]({self.links[first.id]})"
                    lines.append(f"| {link} | {first_sentence(self.doc(first))} | [`{page[:-3]}.hpp`]({page}) |")
        return "\n".join(lines) + "\n"

    def page(self, header: str) -> str:
        parts = [f"# {Path(header).name}", f"```cpp\n#include <{header}>\n```", self.doc(self.intros[header])]
        for _, group in groupby(self.headers[header], key=lambda item: (item.name, item.kind)):
            items = list(group)
            if items[0].name.startswith("@"):  # an enumeration without a name: the values of the type above it
                parts.append(self.enum_table(items[0]))
                continue
            parts.append(f"## {self.title(items[0])} {{ #{self.anchor(items[0])} data-toc-label='{items[0].name}' }}")
            parts += [self.class_body(items[0])] if items[0].kind in CLASSES else self.overloads(items)
        return "\n\n".join(parts) + "\n"

    def title(self, item: Item) -> str:
        return f"{TITLES.get(item.kind, item.kind.capitalize())} `{item.name}`"

    def class_body(self, item: Item) -> str:
        parts = [self.bases(item), self.doc(item)]
        fields = [member for member in item.members if member.kind == "variable"]
        if fields:
            parts.append(self.field_table(fields))
        functions = [member for member in item.members if member.kind == "function"]
        for _, group in groupby(functions, key=lambda member: member.name):
            overloads = list(group)
            name = overloads[0].short_name
            parts.append(f"### `{name}` {{ #{self.anchor(overloads[0])} }}")
            parts += self.overloads(overloads)
        return "\n\n".join(part for part in parts if part)

    def bases(self, item: Item) -> str:
        bases = [(base.get("refid", ""), plain(base)) for base in item.element.iterfind("basecompoundref")]
        links = [f"[`{name}`]({self.links[ref]})" if ref in self.links else f"`{name}`" for ref, name in bases]
        return f"A {' and '.join(links)}." if links else ""

    def overloads(self, items: list[Item]) -> list[str]:
        parts = []
        for item in items:
            if item is not items[0]:
                parts.append(f'<a id="{self.anchor(item)}"></a>')
            parts += [f"```cpp\n{signature(item)}\n```"] if item.kind != "concept" else []
            parts.append(self.doc(item))
            if item.kind == "enum":
                parts.append(self.enum_table(item))
        return parts

    def field_table(self, fields: list[Item]) -> str:
        lines = ["| field | type | default | |", "|---|---|---|---|"]
        for member in fields:
            name = f'<a id="{self.anchor(member)}"></a>`{member.short_name}`'
            kind = tidy(plain(member.element.find("type")) + plain(member.element.find("argsstring")))
            default = plain(member.element.find("initializer")).removeprefix("= ")
            lines.append(f"| {name} | `{kind}` | {f'`{default}`' if default else ''} | {in_cell(self.doc(member))} |")
        return "\n".join(lines)

    def enum_table(self, item: Item) -> str:
        lines, code = ["| name | value | |", "|---|---|---|"], -1
        for value in item.element.iterfind("enumvalue"):
            given = plain(value.find("initializer")).removeprefix("= ")
            code = int(given, 0) if given else code + 1
            lines.append(f"| `{plain(value.find('name'))}` | {code} | {in_cell(self.doc(value))} |")
        return "\n".join(lines)


def members_of(compound: Element, scope: str) -> list[Item]:
    """The public members of a compound that have a comment, in the order of the header."""
    members = [
        Item(member, scope + plain(member.find("name")), member.get("kind", ""))
        for member in compound.iterfind("sectiondef/memberdef")
        if member.get("prot") == "public" and description(member, lambda _: None)
    ]
    return sorted(members, key=lambda member: member.place)


def signature(item: Item) -> str:
    """The declaration, with one parameter per line if it is too long for one line."""
    element, name = item.element, item.short_name
    if item.kind == "define":
        return f"#define {name} {plain(element.find('initializer'))}"
    if item.kind == "enum":
        base = plain(element.find("type"))
        return f"enum class {name}" + (f" : {base}" if base else "")
    if item.kind == "typedef" and item.is_c:
        return f"typedef {plain(element.find('type'))} {name};"
    if item.kind == "typedef":
        line = tidy(f"using {name} = {plain(element.find('type'))};")
        return line if len(line) <= LINE else line.replace("<", "<\n    ", 1).replace(", ", ",\n    ")
    words = [word for word in ("static", "explicit") if element.get(word) == "yes"]
    words += ["virtual"] if element.get("virt") == "pure-virtual" else []
    words += [plain(element.find("type")), name]
    head = " ".join(word for word in words if word)
    if item.kind == "variable":
        return f"{head} {plain(element.find('initializer'))};"
    template = [declared(param) for param in element.iterfind("templateparamlist/param")]
    params = [declared(param) for param in element.iterfind("param")]
    tail = plain(element.find("argsstring")).rpartition(")")[2].replace("=", " = ").replace("  ", " ")
    line = f"{head}({', '.join(params)}){tail};"
    if len(line) > LINE and params:
        line = f"{head}(\n    " + ",\n    ".join(params) + f"){tail};"
    return (f"template <{', '.join(template)}>\n" if template else "") + tidy(line)


def declared(param: Element) -> str:
    """A parameter as it is declared."""
    default = plain(param.find("defval"))
    text = f"{plain(param.find('type'))} {plain(param.find('declname'))}".strip()
    return tidy(f"{text} = {default}" if default else text)


def tidy(code: str) -> str:
    """Types as we write them: `const Sensor& sensor`, `std::span<const T>`."""
    code = re.sub(r" ([&*]+)(?=[ ,)]|$)", r"\1", code)
    return re.sub(r"< (.*?) >", r"<\1>", code)


def in_cell(markdown: str) -> str:
    """Markdown on one line, for the cell of a table."""
    return markdown.replace("\n\n", "<br>").replace("\n", " ")


def first_sentence(markdown: str) -> str:
    """The first sentence, for an overview."""
    return re.split(r"(?<=\.)\s", markdown.partition("\n\n")[0], maxsplit=1)[0]


def page_of(header: str) -> str:
    """The name of a header's page, within `reference/cpp/`: surface.md, and flagstone_h.md for the C header."""
    path = Path(header)
    return f"{path.stem}_h.md" if path.suffix == ".h" else f"{path.stem}.md"


def groups_of_nav(nav: list[Any]) -> dict[str, list[str]]:
    """The sections of the navigation that contain pages of `reference/cpp/`, with the names of these pages."""
    groups: dict[str, list[str]] = {}
    for entry in nav:
        for title, below in entry.items() if isinstance(entry, dict) else ():
            if isinstance(below, list):
                pages = [page for page in below if isinstance(page, str) and page.startswith("reference/cpp/")]
                pages = [Path(page).name for page in pages if page != "reference/cpp/index.md"]
                groups |= ({title: pages} if pages else {}) | groups_of_nav(below)
    return groups
