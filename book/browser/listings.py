"""The listings, copied by their buttons: each is a program that compiles as it is, and prints what
stands below it."""

import json
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from browser import Part

ROOT = Path(__file__).resolve().parents[2]
# The buttons of the listings that run, and what stands below each. Programs of reports on other
# people's libraries need these.
LISTINGS = """all('pre:not(.reports *):has(> code.language-rust:not(.ignore))').map(listing => {
    const below = listing.nextElementSibling;
    return below?.matches('.output') ? below.textContent.trim() : null;
})"""
PRESS = """all('pre:not(.reports *):has(> code.language-rust:not(.ignore))')[given]
    .querySelector('.clip-button').click()"""


def copied(tab, book) -> list[tuple[str, str, str | None]]:
    """Where each listing stands, what its button copies, and what it says that it prints."""
    tab.context.grant_permissions(["clipboard-read", "clipboard-write"])
    found = []
    for page in book.chapters:
        # The pages of the tests have sources, which are no programs.
        if page.startswith("tests/") or 'class="language-rust"' not in book.text(page):
            continue
        tab.open(page)
        text = Part(tab, "main")
        text.run("all('details').forEach(folded => folded.open = true)")
        for n, output in enumerate(text.run(LISTINGS)):
            text.run(PRESS, n)
            found.append((f"{page} {n}", tab.run("navigator.clipboard.readText()"), output))
        # The lines that are hidden are hidden again.
        assert text.run("all('code:has(.boring):not(.hide-boring)').length") == 0, page
    return found


def crates() -> list[str]:
    """The options that give `rustc` the crates of which the program is made."""
    build = "cargo build --quiet --bin pendula --message-format json".split()
    told = subprocess.run(build, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    options = []
    for message in map(json.loads, told.splitlines()):
        name = message.get("target", {}).get("name", "")
        libraries = [file for file in message.get("filenames", []) if file.endswith(".rlib")]
        if name.startswith("pendula") and libraries:
            folder = Path(libraries[0]).parent
            options += ["--extern", f"{name}={libraries[0]}", "-L", f"dependency={folder}"]
            options += ["-L", f"dependency={folder / 'deps'}"]
    return options


def test_copied(tab, book, tmp_path):
    """Catches a listing that needs a line that is not copied with it, and one whose `main` is not
    indented."""
    found = copied(tab, book)
    assert len(found) >= 30
    margin = [place for place, program, _ in found if re.search(r"^fn main.*\{\n\S", program, re.M)]
    assert margin == []
    # As the modules of one program: by itself each would be compiled with all of the library that
    # it uses.
    names = [re.sub(r"\W", "_", place) for place, _, _ in found]
    for name, (_, program, _) in zip(names, found, strict=True):
        module = re.sub(r"^fn main\(", "pub fn main(", program, flags=re.M)
        (tmp_path / f"{name}.rs").write_text(module)
    modules = "".join(f"mod {name};\n" for name in names)
    cases = "".join(f'        "{name}" => {name}::main().report(),\n' for name in names)
    source, binary = tmp_path / "main.rs", tmp_path / "listings"
    source.write_text(f"""{modules}
use std::process::{{ExitCode, Termination}};

fn main() -> ExitCode {{
    match std::env::args().nth(1).unwrap().as_str() {{
{cases}        name => panic!("{{name}}"),
    }}
}}
""")
    compile = ["rustc", "--edition", "2024", "-O", "-o", binary, source, *crates()]
    told = subprocess.run(compile, capture_output=True, text=True)
    assert told.returncode == 0, told.stderr

    def run(n: int) -> str | None:
        place, _, output = found[n]
        told = subprocess.run([binary, names[n]], capture_output=True, text=True, timeout=120)
        if told.returncode != 0:
            return f"{place}: {told.stderr}"
        if output is not None and told.stdout.strip() != output:
            return f"{place} prints\n{told.stdout}, and the page says\n{output}"
        return None

    with ThreadPoolExecutor(2) as pool:
        wrong = [said for said in pool.map(run, range(len(found))) if said]
    assert not wrong, "\n\n".join(said[:600] for said in wrong)
