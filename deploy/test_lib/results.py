"""Counts test cases, from JUnit files and from the steps of the suite itself."""

import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Case:
    name: str
    outcome: str  # passed, failed, skipped
    detail: str = ""


@dataclass
class Tally:
    cases: list[Case] = field(default_factory=list)

    def count(self, outcome: str) -> int:
        return sum(case.outcome == outcome for case in self.cases)

    @property
    def failed(self) -> list[Case]:
        return [case for case in self.cases if case.outcome == "failed"]

    def add(self, other: "Tally") -> None:
        self.cases += other.cases


def _case(element: xml.Element) -> Case:
    name = element.get("name", "?")
    said = (element.findtext("system-out") or "").strip()
    if element.find("failure") is not None or element.find("error") is not None or element.get("status") == "fail":
        return Case(name, "failed", said)
    if element.find("skipped") is not None or element.get("status") in ("notrun", "disabled"):
        return Case(name, "skipped", said)
    return Case(name, "passed")


def read_junit(path: Path) -> Tally:
    """The cases of a JUnit file. A file that is missing or broken is a failed case: a run that died tells nothing."""
    try:
        return Tally([_case(element) for element in xml.parse(path).getroot().iter("testcase")])
    except (OSError, xml.ParseError) as error:
        return Tally([Case(path.name, "failed", f"no results: {error}")])


def write_junit(path: Path, suite: str, tally: Tally) -> None:
    root = xml.Element("testsuite", name=suite, tests=str(len(tally.cases)), failures=str(tally.count("failed")),
                       skipped=str(tally.count("skipped")))
    for case in tally.cases:
        element = xml.SubElement(root, "testcase", name=case.name, classname=suite)
        if case.outcome == "failed":
            xml.SubElement(element, "failure", message=case.detail.splitlines()[-1] if case.detail else "failed")
        if case.outcome == "skipped":
            xml.SubElement(element, "skipped")
        # XML 1.0 has no way to write most control characters.
        xml.SubElement(element, "system-out").text = "".join(c for c in case.detail if c >= " " or c in "\n\t")
    path.write_text(xml.tostring(root, encoding="unicode"))
