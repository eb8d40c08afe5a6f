"""The site of example pages and documents: every link inside it leads somewhere, nothing comes from the
network, the search knows what the documents say. Where playwright-core is installed, a real browser opens
pages at three widths, in both modes, and searches.

Usage: gallery_test.py SOURCES PROGRAM SITE CHROMIUM
"""

import html.parser
import json
import pathlib
import subprocess
import sys
import unittest
import urllib.parse

SOURCES, PROGRAM, SITE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
CHROMIUM = sys.argv[4]
PAGES = ("target_step", "table_1_open_loop", "design")
NODE_MODULES = SOURCES / "build/npm/node_modules"


class Page(html.parser.HTMLParser):
    """Where a page leads to, what it loads, and which names it has."""

    def __init__(self, file):
        super().__init__(convert_charrefs=True)
        self.links, self.loaded, self.names = [], [], set()
        self.feed(file.read_text(errors="replace"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.names.update(attributes[key] for key in ("id", "name") if attributes.get(key))
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        elif tag in ("img", "script", "iframe") and attributes.get("src"):
            self.loaded.append(attributes["src"])
        elif tag == "link" and attributes.get("href"):
            self.loaded.append(attributes["href"])

    handle_startendtag = handle_starttag


class Gallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([sys.executable, "-B", SOURCES / "tools/gallery/build.py", SOURCES, PROGRAM, SITE, *PAGES],
                       check=True)
        cls.pages = {file: Page(file) for file in SITE.rglob("*.html")}
        text = (SITE / "search_index.js").read_text()
        cls.index = json.loads(text[text.index("["):text.rindex("]") + 1])

    def trouble_with(self, file, url):
        """What is wrong with a link or an address inside the site; None if it leads somewhere."""
        path, _, fragment = url.partition("#")
        target = (file.parent / urllib.parse.unquote(path)).resolve() if path else file
        if not target.is_file():
            return f"{file.relative_to(SITE)}: {url} leads nowhere"
        if fragment and target in self.pages:
            if urllib.parse.unquote(fragment) not in self.pages[target].names:
                return f"{file.relative_to(SITE)}: {url} has no such place"
        return None

    def test_every_link_inside_leads_somewhere(self):
        troubles, count = [], 0
        for file, page in self.pages.items():
            for url in page.links + page.loaded:
                scheme = urllib.parse.urlsplit(url).scheme
                if not scheme:
                    count += 1
                    troubles.append(self.trouble_with(file, url))
        self.assertEqual([each for each in troubles if each], [])
        self.assertGreater(count, 1000)

    def test_nothing_comes_from_the_network(self):
        for file, page in self.pages.items():
            for url in page.loaded:
                self.assertIn(urllib.parse.urlsplit(url).scheme, ("", "data", "javascript"), file)

    def test_has_every_document_and_the_chosen_pages(self):
        for room in ("*.md", "firmware/**/*.md", "hal/**/*.md", "host_sim/**/*.md", "tests/**/*.md"):
            for document in SOURCES.glob(room):
                page = (SITE / document.relative_to(SOURCES)).with_suffix(".html")
                self.assertIn(page, self.pages)
        examples = [url for url in self.pages[SITE / "index.html"].links if url.startswith("pages/")]
        self.assertEqual(len(examples), len(PAGES))

    def test_the_search_knows_what_the_documents_say(self):
        self.assertGreater(len(self.index), 500)
        troubles = [self.trouble_with(SITE / "search.js", address) for _, address, _ in self.index]
        self.assertEqual([each for each in troubles if each], [])
        for words, page in (("anti-windup", "firmware/"), ("--merge", "host_sim/studies/sweep/README.html"),
                            ("controlloop", "api/")):
            hits = [address for title, address, text in self.index if words in f"{title} {text}".lower()]
            self.assertTrue(any(address.startswith(page) for address in hits), (words, hits))

    @unittest.skipUnless((NODE_MODULES / "playwright-core").exists(),
                         "playwright-core is not there; tools/setup check installs it where npm is")
    def test_a_browser_shows_it(self):
        visit = pathlib.Path(__file__).with_name("visit.cjs")
        ended = subprocess.run(["node", visit, SITE, CHROMIUM], text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, env={"NODE_PATH": str(NODE_MODULES),
                                                              "PATH": "/usr/local/bin:/usr/bin:/bin"})
        self.assertEqual(ended.returncode, 0, ended.stdout)
        print(ended.stdout.strip())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
