"""Finds the functions of a C++ file and how many lines each takes, by its braces.

Leans on clang-format: a brace that opens a block stands after a space, one that initialises a value stands against its name
(`x{1}`) or after `=`, `(` or a comma. Lambdas and local types count as lines of the function that holds them.
"""

import re
from dataclasses import dataclass

from source_tree import line_of, without_comments

_DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", re.MULTILINE)
_NAMESPACE = re.compile(r"\s*((inline\s+)?namespace\b|extern\s+\"?\w*\s*\"?\s*$)")
_TYPE = re.compile(r"\s*((public|private|protected)\s*:\s*)*(template\s*<.*>\s*)?(\[\[.*?\]\]\s*)*(typedef\s+)?(class|struct|union|enum)\b",
                   re.DOTALL)
_ACCESS = re.compile(r"(\s*(public|private|protected)\s*:)*\s*")
_NAME = re.compile(r"([~\w:]+|operator\s*\(\)|operator\s*[^\s\w(]+)\s*\(")


@dataclass(frozen=True)
class Function:
    name: str
    first_line: int
    lines: int


def _initialises(text: str, brace: int) -> bool:
    return text[brace - 1].isalnum() or text[brace - 1] in "_>])" or text[:brace].rstrip().endswith(("=", "(", ","))


def _kind(text: str, head: str, brace: int, outer: str) -> str:
    if outer in ("function", "value"):
        return outer
    if _NAMESPACE.match(head):
        return "namespace"
    if brace and _initialises(text, brace):
        return "value"
    if _TYPE.match(head):
        return "type"
    return "function" if "(" in head or "[" in head else "type"


def functions(source: str) -> list[Function]:
    """Each function with a body, outermost only, in the order of the file. Lines run from its signature to its closing brace."""
    text = _DIRECTIVE.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), without_comments(source, strings=True))
    found: list[Function] = []
    open_braces: list[tuple[str, int]] = []  # kind, and where the text in front of it starts
    head_start = 0
    for match in re.finditer(r"[{};]", text):
        offset = match.start()
        outer = open_braces[-1][0] if open_braces else "namespace"
        if match.group(0) == "{":
            kind = _kind(text, text[head_start:offset], offset, outer)
            open_braces.append((kind, head_start))
            if kind in ("namespace", "type"):
                head_start = offset + 1
        elif match.group(0) == "}" and open_braces:
            kind, start = open_braces.pop()
            outermost = not open_braces or open_braces[-1][0] in ("namespace", "type")
            if kind == "function" and outermost:
                found.append(_measure(text, start, offset))
            if kind != "value" and outermost:
                head_start = offset + 1
        elif outer in ("namespace", "type"):
            head_start = offset + 1
    return found


def _measure(text: str, start: int, end: int) -> Function:
    start += _ACCESS.match(text[start:end]).end()
    first = line_of(text, start)
    name = _NAME.search(text[start:end])
    return Function(name.group(1).strip() if name else "?", first, line_of(text, end) - first + 1)
