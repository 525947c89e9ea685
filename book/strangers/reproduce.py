"""Runs the programs of the reports, and puts what they print below them.

    book/strangers/run --reproduce [REPORT …]

Needs g++, gcc and libboost-dev too: CXXFLAGS may name the headers of another Boost. What cannot be
built or run is said to be missing, and its report is left as it was.
"""

import os
import re
import subprocess
import sys

PART = "<!-- ANCHOR: {0} -->\n```(\\w+)\n(.*?)```\n<!-- ANCHOR_END: {0} -->"
PROGRAM, OUTPUT = (re.compile(PART.format(part), re.S) for part in ("program", "output"))
SUFFIXES = {"c": ".c", "cpp": ".cpp", "java": ".java", "js": ".mjs", "octave": ".m",
            "python": ".py", "r": ".R", "rust": ".rs"}


def programs(reports, work):
    """Writes the program of each report to a file of its name, and returns the files by report."""
    folder = work / "reproductions"
    folder.mkdir(exist_ok=True)
    files = {}
    for report in sorted(reports.glob("*.md")):
        language, text = PROGRAM.search(report.read_text()).groups()
        # Node looks for modules from where the program is.
        where = work / "javascript" if language == "js" else folder
        files[report] = where / (report.stem + SUFFIXES[language])
        files[report].write_text(text)
    return files


def built(command):
    print("+", " ".join(map(str, command)), file=sys.stderr)
    subprocess.run(command, check=True, stdout=sys.stderr)


def cargo(work, crate, *more):
    built(["cargo", "build", "--manifest-path", work / "rust" / "Cargo.toml", "-p", crate, *more])
    return work / "rust" / "target" / "debug"


def python(report, work):
    """The Python in which the library of a report is: that of the integrators, or else that of the
    solvers, which is set up when it is first asked for."""
    library = re.search(r"\*Library:\* (\S+?)\.? ", report.read_text())[1]
    pinned = (work / "python" / "requirements.txt").read_text().lower()
    if f"\n{library.lower()}==" in pinned:
        return work / "venv" / "bin" / "python"
    interpreter = work / "solvers" / "bin" / "python"
    if not interpreter.exists():
        built(["python3", "-m", "venv", work / "solvers"])
        listed = work / "python" / "solvers-requirements.txt"
        built([interpreter, "-m", "pip", "install", "-q", "-r", listed])
    return interpreter


def command(report, source, work):
    """What runs the program of a report, which it builds first."""
    name, out = source.stem, source.with_suffix("")
    if source.suffix == ".py":
        return [python(report, work), source]
    if source.suffix == ".mjs":
        return ["node", source]
    if source.suffix == ".R":
        return ["Rscript", source]
    if source.suffix == ".m":
        return ["octave-cli", "--no-gui", source]
    if source.suffix == ".java":
        return ["java", "-cp", f"{work / 'java'}/*", source]
    if source.suffix == ".cpp":
        flags = os.environ.get("CXXFLAGS", "").split()
        built(["g++", "-std=c++17", "-w", *flags, source, "-o", out])
        return [out]
    if source.suffix == ".rs":
        crate = "strangers-" + ("proof-engine" if name.startswith("proof") else "reproductions")
        return [cargo(work, crate, "--bin", name) / name]
    # SUNDIALS as the crate sundials-sys has built it.
    made = cargo(work, "strangers-sundials") / "build"
    found = sorted(made.glob("sundials-sys-*/out/include"))[0]
    libraries = [f"-lsundials_{part}" for part in ("arkode", "nvecserial", "core")]
    folders = [f"-I{found}", f"-L{found.parent / 'lib'}"]
    built(["gcc", "-w", source, "-o", out, *folders, *libraries, "-lm"])
    return [out]


def run(names, reports, work):
    """Runs those that are named, or all; returns what is missing."""
    missing = []
    for report, source in programs(reports, work).items():
        if names and report.stem not in names:
            continue
        try:
            call = command(report, source, work)
            told = subprocess.run(call, check=True, capture_output=True, text=True)
            text = report.read_text()
            start, end = OUTPUT.search(text).span(2)
            report.write_text(text[:start] + told.stdout + text[end:])
            print(f"{report.stem}\n{told.stdout}")
        except (OSError, IndexError, subprocess.CalledProcessError) as why:
            missing.append(f"{report.stem}: {why}")
    return missing
