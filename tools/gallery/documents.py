"""The documents of the repository as pages of a site, by pandoc. What a document links to becomes a page
too: a source file as its text, a folder as its README or a list of its files."""

import html
import json
import os
import pathlib
import shutil
import subprocess

AS_IT_IS = {".svg", ".png"}
READERS = {".md": "gfm", ".ipynb": "ipynb"}


def pandoc(text, *options, cwd=None):
    return subprocess.run(["pandoc", *options], input=text, stdout=subprocess.PIPE, text=True, check=True,
                          cwd=cwd).stdout


def elements(node):
    """Every element of a part of pandoc's syntax tree."""
    if isinstance(node, dict):
        if "t" in node:
            yield node
        node = list(node.values())
    if isinstance(node, list):
        for each in node:
            yield from elements(each)


def plain(node):
    words = []
    for element in elements(node):
        kind = element["t"]
        if kind in ("Str", "Code", "CodeBlock"):
            words.append(element["c"] if kind == "Str" else element["c"][1])
        elif kind in ("Space", "SoftBreak", "LineBreak", "Plain", "Para"):
            words.append(" ")
    return " ".join("".join(words).split())


def documents(sources):
    """Every document of the sources, from their root."""
    rooms = ("firmware", "hal", "host_sim", "tests")
    found = [*sources.glob("*.md"), *(file for room in rooms for file in (sources / room).rglob("*.md"))]
    return {file.relative_to(sources) for file in found}


class Site:
    def __init__(self, sources, folder, template):
        self.sources, self.folder, self.template = sources, folder, template
        self.index = []  # title, address, text of each section
        self.wanted = set()  # files and folders that documents link to, from the root of the sources
        self.written = set()

    def write_page(self, path, title, body):
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        page = self.template
        for name, value in (("title", html.escape(title)), ("root", "../" * (len(path.parts) - 1)),
                            ("body", body)):
            page = page.replace(f"${name}$", value)
        target.write_text(page)

    def write_documents(self):
        self.wanted |= documents(self.sources)
        while self.wanted - self.written:
            path = min(self.wanted - self.written)
            self.written.add(path)
            if path.suffix in READERS:
                self.write_document(path)
            elif (self.sources / path).is_dir():
                self.write_list(path)
            elif path.suffix in AS_IT_IS:
                self.copy(path)
            else:
                text = html.escape((self.sources / path).read_text())
                self.write_page(self.page_of(path), path.name, f"<h1>{path}</h1><pre>{text}</pre>")

    def copy(self, path):
        (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(self.sources / path, self.folder / path)

    def page_of(self, path):
        """The page that a file or folder of the sources becomes."""
        if (self.sources / path).is_dir():
            return path / "files.html"
        if path.suffix in AS_IT_IS:
            return path
        return path.with_suffix(".html") if path.suffix in READERS else path.with_name(path.name + ".html")

    def write_list(self, folder):
        names = sorted(file.name for file in (self.sources / folder).iterdir()
                       if not file.name.startswith((".", "__")))
        self.wanted.update(folder / name for name in names)
        items = "".join(f'<li><a href="{os.path.relpath(self.page_of(folder / n), folder)}">{n}</a></li>'
                        for n in names)
        self.write_page(folder / "files.html", str(folder), f"<h1>{folder}</h1><ul>{items}</ul>")

    def address(self, document, url):
        """A link of a document as one of its page."""
        path, hash_mark, fragment = url.partition("#")
        if "://" in url or url.startswith("mailto:") or not path:
            return url
        if (self.folder / document.parent / path).is_file():
            return url  # a picture that pandoc took out of a notebook
        target = pathlib.Path(os.path.normpath(document.parent / path))
        if not (self.sources / target).exists():
            raise SystemExit(f"{document}: the link {url} leads nowhere")
        if (self.sources / target / "README.md").is_file():
            target = target / "README.md"
        self.wanted.add(target)
        return os.path.relpath(self.page_of(target), document.parent) + hash_mark + fragment

    def write_document(self, path):
        page = self.page_of(path)
        place = (self.folder / page).parent
        place.mkdir(parents=True, exist_ok=True)
        pictures = [f"--extract-media={path.stem}_pictures"] if path.suffix == ".ipynb" else []
        tree = json.loads(pandoc((self.sources / path).read_text(), f"--from={READERS[path.suffix]}",
                                 "--to=json", *pictures, cwd=place))
        for element in elements(tree["blocks"]):
            if element["t"] in ("Link", "Image"):
                element["c"][2][0] = self.address(path, element["c"][2][0])
        sections = self.sections(page, tree["blocks"])
        self.index += sections
        title = sections[0][0] if sections else path.name
        self.write_page(page, title, pandoc(json.dumps(tree), "--from=json", "--to=html5",
                                            "--no-highlight", "--wrap=preserve"))

    @staticmethod
    def sections(page, blocks):
        found = []
        for block in blocks:
            if block["t"] == "Header":
                _, (anchor, _, _), title = block["c"]
                found.append([plain(title), f"{page}#{anchor}", ""])
            elif found:
                found[-1][2] += plain(block) + " "
        return found


def write_index(folder, index):
    (folder / "search_index.js").write_text("const sections = " + json.dumps(index, ensure_ascii=False)
                                            + ";\n")
