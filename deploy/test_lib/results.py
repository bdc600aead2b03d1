"""Counts test cases, from JUnit files and from the steps of the suite itself."""

import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path


LEFT_OUT = "left to other builds"  # tests/support/sanitizers.hpp says so, and write_junit()
TOO_LATE = "the time was up"
_NOT_RUN = {"skipped": "", "left out": LEFT_OUT, "too late": TOO_LATE}


@dataclass
class Case:
    name: str
    # passed, failed, skipped (the machine lacks something), left out (another build runs it), too late (see deploy/test --within)
    outcome: str
    detail: str = ""
    seconds: float = 0.0


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
    suite, name = element.get("classname", ""), element.get("name", "?")
    if not name.startswith(suite):  # GoogleTest writes the suite apart; CTest repeats the whole name
        name = f"{suite}.{name}"
    failures = [*element.findall("failure"), *element.findall("error")]
    said = "\n".join([(element.findtext("system-out") or "").strip(), *((failure.text or failure.get("message", "")).strip() for failure in failures)]).strip()
    seconds = float(element.get("time") or 0)
    if failures or element.get("status") == "fail":
        return Case(name, "failed", said, seconds)
    skipped = element.find("skipped")
    why = skipped.get("message", "") if skipped is not None else ""
    for outcome, message in _NOT_RUN.items():
        if message and message in why:
            return Case(name, outcome, said, seconds)
    if skipped is not None or element.get("status") in ("notrun", "disabled"):
        return Case(name, "skipped", said, seconds)
    return Case(name, "passed", seconds=seconds)


def read_junit(path: Path) -> Tally:
    """The cases of a JUnit file. A file that is missing or broken is a failed case: a run that died tells nothing."""
    try:
        return Tally([_case(element) for element in xml.parse(path).getroot().iter("testcase")])
    except (OSError, xml.ParseError, ValueError) as error:
        return Tally([Case(path.name, "failed", f"no results: {error}")])


def write_junit(path: Path, suite: str, tally: Tally) -> None:
    root = xml.Element("testsuite", name=suite, tests=str(len(tally.cases)), failures=str(tally.count("failed")),
                       skipped=str(sum(tally.count(outcome) for outcome in _NOT_RUN)))
    for case in tally.cases:
        element = xml.SubElement(root, "testcase", name=case.name, classname=suite, time=f"{case.seconds:.3f}")
        if case.outcome == "failed":
            xml.SubElement(element, "failure", message=case.detail.splitlines()[-1] if case.detail else "failed")
        if case.outcome in _NOT_RUN:
            xml.SubElement(element, "skipped", message=_NOT_RUN[case.outcome])
        # XML 1.0 has no way to write most control characters.
        xml.SubElement(element, "system-out").text = "".join(c for c in case.detail if c >= " " or c in "\n\t")
    path.write_text(xml.tostring(root, encoding="unicode"))


def tail(log: Path, lines: int = 30) -> str:
    return "\n".join(log.read_text(errors="replace").splitlines()[-lines:])
