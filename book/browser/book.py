"""The built book on disk: its pages, its chapters, and the program that built it."""

import csv
import gzip
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Book:
    """The pages of a built book."""

    def __init__(self, folder: Path):
        self.folder = folder.resolve()
        # What every address of the book begins with.
        self.root = self.folder.as_uri()
        if not (self.folder / "toc.html").is_file():
            sys.exit(f"{folder}: no built book here; cargo run builds it")
        # Cargo puts the program beside the book, in target/debug and target/book.
        self.program = self.folder.parent / "debug/pendula"
        if not self.program.is_file():
            sys.exit(f"{self.program}: not built; cargo build builds it")
        self.pages = sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*.html"))
        links = re.findall(r'<a href="([^"#]+\.html)"', self.text("toc.html"))
        # In reading order, each once. The first chapter is index.html too.
        self.chapters = list(dict.fromkeys(links))

    def text(self, page: str) -> str:
        return (self.folder / page).read_text()

    def compressed(self, file: str) -> int:
        """The size of a file as a server sends it (bytes); fonts and pictures are compressed
        already."""
        content = (self.folder / file).read_bytes()
        packed = file.endswith((".woff2", ".png"))
        return len(content if packed else gzip.compress(content, 9))

    def url(self, page: str) -> str:
        return (self.folder / page).as_uri()

    def page(self, url: str) -> str:
        """The page at an address, as a path in the book."""
        path = Path(unquote(urlsplit(url).path))
        inside = path.is_relative_to(self.folder)
        return str(path.relative_to(self.folder)) if inside else str(path)

    def rows(self, command: str) -> list[dict[str, float]]:
        """The rows that the program prints, of a command without its name."""
        call = [self.program, *command.split()]
        answer = subprocess.run(call, capture_output=True, text=True, check=True)
        rows = csv.DictReader(answer.stdout.splitlines())
        return [{name: float(x) for name, x in row.items()} for row in rows]


class Served(Book):
    """The book as a server on this machine gives it out."""

    def __init__(self, book: Book):
        vars(self).update(vars(book))

    def __enter__(self):
        command = [sys.executable, "-u", "-m", "http.server", "--bind", "127.0.0.1"]
        self.server = subprocess.Popen(
            [*command, "--directory", self.folder, "0"], text=True,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )
        port = re.search(r"port (\d+)", self.server.stdout.readline())[1]
        self.root = f"http://127.0.0.1:{port}"
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.communicate()

    def url(self, page: str) -> str:
        return f"{self.root}/{page}"

    def page(self, url: str) -> str:
        return unquote(urlsplit(url).path).lstrip("/")
