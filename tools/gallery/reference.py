"""The reference of the core's headers, by doxygen."""

import pathlib
import re
import subprocess
import xml.etree.ElementTree


def drop_dead_links(folder):
    """Doxygen 1.9 links to a list of nested classes that it leaves out where all of them are private."""
    for page in folder.glob("class*.html"):
        text = page.read_text()
        if 'name="nested-classes"' not in text:
            page.write_text(re.sub(r'<a href="#nested-classes">Classes</a> &#124;\s*', "", text))


def write(sources, site):
    """@return title, address and text of each class and function"""
    tags = site / "api.tag"
    settings = (sources / "Doxyfile").read_text() + (
        f'\nOUTPUT_DIRECTORY = "{site}"\nHTML_OUTPUT = api\nGENERATE_TAGFILE = "{tags}"\n'
        f'HTML_EXTRA_STYLESHEET = "{pathlib.Path(__file__).with_name("reference.css")}"\n')
    subprocess.run(["doxygen", "-"], cwd=sources, input=settings, text=True, check=True)
    drop_dead_links(site / "api")
    index = []
    for compound in xml.etree.ElementTree.parse(tags).getroot():
        name = compound.findtext("name")
        if compound.get("kind") in ("class", "struct"):
            index.append([name, f"api/{compound.findtext('filename')}", "class of the core"])
        for member in compound.findall("member[@kind='function']"):
            address = f"api/{member.findtext('anchorfile')}#{member.findtext('anchor')}"
            index.append([f"{name}::{member.findtext('name')}", address, member.findtext("arglist")])
    tags.unlink()
    return index
