"""Writes a site that needs no network: an example page of every scene and study, all documents, the
reference of the core, and a search over them. Needs pandoc and doxygen.

Usage: build.py SOURCES PROGRAM SITE [PAGE...]     of the example pages those named; else all
"""

import html
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import documents  # noqa: E402
import reference  # noqa: E402

HERE = pathlib.Path(__file__).parent
SOURCES, PROGRAM, SITE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])

SCENES = pathlib.Path("host_sim/scenes")
EXAMPLES = pathlib.Path("host_sim/studies/identify")
STUDIES = (
    ("design", "What drive does a friction ratio take, and can it be reached?",
     f"design {SCENES}/unreachable_target.toml --velocity 0.01:0.1"),
    ("design_transducer", "The same of a transducer at its resonance: volts, amperes, detuning.",
     f"design {SCENES}/wire_bonder.toml"),
    ("sweep", "How does the friction ratio depend on velocity and contact stiffness?",
     f"sweep {SCENES}/table_1_open_loop.toml --set run.start=steady --vary velocity_ratio=0.05:1.2:40 "
     "--vary friction.contact_stiffness_N_per_m=1e4:1e6:25:log"),
    ("sweep_laws", "How do two friction laws differ?",
     f"sweep {SCENES}/table_1_open_loop.toml --set run.start=steady --vary friction.law=dahl,coulomb "
     "--vary velocity_ratio=0.1:1:20"),
    ("robust", "How far may the plant be off before the loop fails?",
     f"robust {SCENES}/robust_step.toml --samples 256 --search 64"),
    ("identify_impedance", "Which circuit is my transducer?",
     f"identify impedance {EXAMPLES}/impedance/examples/piece_112_kHz.csv --mass-kg 0.005"),
    ("identify_friction", "Which friction law is my contact?",
     f"identify friction {EXAMPLES}/friction/examples/luo_2024.csv --law coulomb --law dahl --law iwan"),
    ("paper", "Does it reproduce the paper?", "paper"),
    ("work_precision", "Which solver is fastest for an accuracy?",
     f"work-precision {SCENES}/table_1_open_loop.toml"),
    ("arithmetic", "Which arithmetic does a processor need?", f"arithmetic {SCENES}/target_step.toml"),
    ("stability", "Where can each solver be trusted?", "stability"),
)


def scene_entries():
    """Name, what the scene shows (the comment at its top, behind the first line), and the command."""
    for scene in sorted((SOURCES / SCENES).glob("*.toml")):
        lines = scene.read_text().splitlines()[1:]
        end = next(i for i, line in enumerate(lines) if not line.startswith("#"))
        yield scene.stem, " ".join(line[1:].strip() for line in lines[:end]), f"run {SCENES}/{scene.name}"


def run(command, out):
    subprocess.run([PROGRAM, *command.split(), "--out", out, "--quiet"], cwd=SOURCES, check=True)


def entry_html(name, note, command):
    """One example, its page made; nothing where the command leaves tables alone."""
    folder = SITE / "pages" / name
    run(command, folder)
    page = next((p for p in (folder / "report.html", folder / "index.html") if p.exists()), None)
    if page is None:
        pictures = "".join(f'<img src="pages/{name}/{p.name}" alt="{p.stem}">'
                           for p in sorted(folder.glob("*.svg")))
        title = name
    else:
        pictures, title = "", f'<a href="pages/{name}/{page.name}">{name}</a>'
    return (f"<article><h3>{title}</h3><p>{html.escape(note)}</p>{pictures}"
            f"<pre><code>sonoglide {html.escape(command)}</code></pre></article>\n")


def gallery(chosen):
    parts = ["<h1>Sonoglide: example pages</h1>\n",
             "<p>Each page was written by the command below it. "
             "The documents begin at <a href=\"README.html\">README</a>.</p>\n"]
    for heading, entries in (("Runs", scene_entries()), ("Studies", STUDIES)):
        made = [entry_html(*entry) for entry in entries if not chosen or entry[0] in chosen]
        if made:
            parts += [f"<h2>{heading}</h2>\n<div class=\"entries\">\n", *made, "</div>\n"]
    return "".join(parts)


def main():
    for tool in ("pandoc", "doxygen"):
        if shutil.which(tool) is None:
            raise SystemExit(f"gallery: {tool} is not installed; apt-get install {tool}")
    SITE.mkdir(parents=True, exist_ok=True)
    site = documents.Site(SOURCES, SITE, (HERE / "page.html").read_text())
    style = (SOURCES / "host_sim/output/page/page.css").read_text() + (HERE / "gallery.css").read_text()
    (SITE / "gallery.css").write_text(style)
    for script in (SOURCES / "host_sim/output/page/wide.js", HERE / "search.js"):
        (SITE / script.name).write_text(script.read_text())
    site.write_documents()
    index = site.index + reference.write(SOURCES, SITE)
    documents.write_index(SITE, index)
    site.write_page(pathlib.Path("index.html"), "Example pages", gallery(set(sys.argv[4:])))
    print(f"{SITE / 'index.html'}: {len(list(SITE.rglob('*.html')))} pages, {len(index)} entries to search")


if __name__ == "__main__":
    main()
