/// The report page in a real browser: it draws, answers the mouse and asks the network for nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "sample_page.hpp"
#include "tests/acceptance/page/browser.hpp"
#include "tests/acceptance/page/exercise.hpp"

namespace sonoglide::page_test {
namespace {

constexpr int kPanels = 9;

class PageInBrowser : public ::testing::Test {
 protected:
  browser::Visit visit(const std::string& html, const std::string& script = "",
                       const browser::Screen& screen = {}) {
    std::ofstream(file_, std::ios::binary) << html;
    return browser::load(file_, script, screen);
  }

  void TearDown() override { std::filesystem::remove(file_); }

 private:
  std::filesystem::path file_ = ::testing::TempDir() + "sonoglide_" +
                                ::testing::UnitTest::GetInstance()->current_test_info()->name() +
                                ".html";
};

int count(const browser::Visit& visit, const std::string& name) {
  const std::string value = browser::body_attribute(visit.dom, name);
  return value.empty() ? -1 : std::stoi(value);
}

TEST_F(PageInBrowser, DrawsEveryPanelAndStaysOffTheNetwork) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()));
  EXPECT_EQ(count(seen, "data-panels"), kPanels);
  EXPECT_EQ(count(seen, "data-drawn"), kPanels);
  EXPECT_TRUE(seen.requests.empty()) << seen.requests.front();
}

TEST_F(PageInBrowser, ZoomsReadsPansAndResetsByMouse) {
  const browser::Visit seen =
      visit(output::to_html(report::sample_page()), browser::exercise_script);
  EXPECT_EQ(count(seen, "data-zoomed"), kPanels);
  EXPECT_EQ(count(seen, "data-read"), kPanels);
  EXPECT_EQ(count(seen, "data-panned"), kPanels);
  EXPECT_EQ(count(seen, "data-reset"), kPanels);
  EXPECT_EQ(count(seen, "data-followed"), kPanels);
}

// Odd ones are filled; the even one below has the same outline.
TEST_F(PageInBrowser, DrawsTheMarkersOfGnuplot) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const outline = (symbol) => Look.marker(symbol, 10, 10, 4);
    const open = [4, 6, 8, 10, 12, 14];
    Object.assign(document.body.dataset, {
      outlines: new Set(open.map(outline)).size,
      pairs: open.filter((symbol) => outline(symbol) === outline(symbol + 1)).length,
    });
  )js");
  EXPECT_EQ(count(seen, "data-outlines"), 6);
  EXPECT_EQ(count(seen, "data-pairs"), 6);
}

TEST_F(PageInBrowser, KeepsAWordWithAHyphenInOneLine) {
  output::Page page = report::sample_page();
  page.tables = {{"", {"Law (--law)", "Part"}, {{"Cortex-M0", "no hyphen"}}}};
  const browser::Visit seen = visit(output::to_html(page), R"js(
    document.body.dataset.whole =
        [...document.querySelectorAll('table .whole')].map((word) => word.textContent).join();
  )js");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-whole").rfind("(--law),Cortex-M0", 0), 0U);
}

TEST_F(PageInBrowser, ShowsSiPrefixesThatFollowTheZoom) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const figure = [...document.querySelectorAll('figure.panel')].find(
        (f) => f.querySelector('h3').textContent === 'Displacement');
    const name = (axis) => figure.querySelector('.axis-name.' + axis).textContent;
    document.body.dataset.before = name('x') + ', ' + name('y');
    Panel.all.find((p) => p.figure === figure).show({x: figure.chart.shown.x, y: [-5e-10, 5e-10]});
    document.body.dataset.after = name('x') + ', ' + name('y');
  )js");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-before"), "Time [ms], Displacement [nm]");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-after"), "Time [ms], Displacement [pm]");
}

TEST_F(PageInBrowser, DrawsEverySeriesOfTheLoopAcrossItsGaps) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const figure = [...document.querySelectorAll('figure.panel')].find(
        (f) => f.querySelector('h3').textContent === 'Friction against displacement');
    const lines = [...figure.querySelectorAll('.data .line')];
    const share = (line) => line.getBBox().width / figure.chart.area.width;
    document.body.dataset.least = String(Math.round(100 * Math.min(...lines.map(share))));
    document.body.dataset.pieces = lines.map((l) => l.getAttribute('d').split('M').length - 1).join();
  )js");
  EXPECT_GE(count(seen, "data-least"), 95);  // percent of the width of the plot
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-pieces"), "1,1");
}

void expect_contrast(const browser::Visit& seen, bool dark) {
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-dark"), dark ? "true" : "false");
  EXPECT_GE(count(seen, "data-curves"), 30) << "tenths; WCAG 2.1 asks 3:1 of graphics";
  EXPECT_GE(count(seen, "data-texts"), 45) << "tenths; WCAG 2.1 asks 4.5:1 of texts";
}

// The second value is a gap: the levels last from 0 to 1, 2 to 3, and 3 to 4.
TEST_F(PageInBrowser, HoldsALevelUpToAGapAndAtTheEnd) {
  output::Page page = report::sample_page();
  const std::vector<double> levels = {5.0, std::numeric_limits<double>::quiet_NaN(), 7.0, 8.0};
  output::Curve band{"band", levels, output::Line::band};
  band.half_width.assign(levels.size(), 0.5);
  output::Chart chart;
  chart.x = {0.0, 1.0, 2.0, 3.0};
  chart.curves = {band, {"level", levels, output::Line::stepped}};
  page.sections = {{"Levels", "", {chart}}};
  const browser::Visit seen = visit(output::to_html(page), R"js(
    const {chart} = document.querySelector('figure.panel');
    const held = (path) => [1, 3, 4].filter((x) => path.includes(`H${chart.px(x).toFixed(1)}`)).length;
    Object.assign(document.body.dataset, {
      band: held(chart.bandPath(chart.series[0])),
      line: held(chart.linePath(chart.series[1])),
      end: chart.xAxisRange()[1],
    });
  )js");
  EXPECT_EQ(count(seen, "data-band"), 3);
  EXPECT_EQ(count(seen, "data-line"), 3);
  EXPECT_EQ(count(seen, "data-end"), 4);
}

TEST_F(PageInBrowser, IsUsedByTouchAndKeyboardInTheDark) {
  const browser::Visit seen = visit(
      output::to_html(report::sample_page()),
      std::string(browser::touch_script) + browser::keyboard_script + browser::contrast_script,
      {true});
  for (const char* use :
       {"data-scrolled", "data-pinched", "data-unzoomed", "data-focused", "data-named", "data-said",
        "data-read", "data-crossed", "data-zoomed", "data-panned", "data-reset"}) {
    EXPECT_EQ(count(seen, use), kPanels) << use;
  }
  expect_contrast(seen, true);
}

TEST_F(PageInBrowser, IsReadAt400Pixels) {
  output::Page page = report::sample_page();
  page.tables.push_back({"Wide", {}, {std::vector<std::string>(12, "123456.789")}});
  const browser::Visit seen =
      visit(output::to_html(page), std::string(browser::contrast_script) + R"js(
    document.body.style.width = '400px';  // the browser's window is 485 wide at least
    Panel.all.forEach((panel) => panel.draw());  // no frame of the browser comes before the end
    const {scrollWidth, clientWidth} = document.body;
    document.body.dataset.hidden = scrollWidth - clientWidth;
    document.body.dataset.width = clientWidth;
    const texts = [...document.querySelectorAll('.plot text')];
    const size = (text) => parseFloat(getComputedStyle(text).fontSize) *
        text.ownerSVGElement.clientWidth / text.ownerSVGElement.viewBox.baseVal.width;
    document.body.dataset.letters = String(Math.floor(Math.min(...texts.map(size))));
    document.body.dataset.longest = Math.max(...texts.map((text) => text.textContent.length));
    const wide = [...document.querySelectorAll('.scroll')].filter(
        (box) => box.scrollWidth > box.clientWidth);
    document.body.dataset.scrolled =
        String(wide.length > 0 && wide.every((box) => box.matches('.more-right[tabindex]')));
    const saysSo = (box) => box.previousElementSibling.matches('.sideways:not([hidden])');
    document.body.dataset.said = String([...document.querySelectorAll('.scroll')].every(
        (box) => saysSo(box) === wide.includes(box)));
    const folded = () => document.querySelectorAll('details:not([open])').length;
    dispatchEvent(new Event('beforeprint'));
    document.body.dataset.printed = folded();
    dispatchEvent(new Event('afterprint'));
    document.body.dataset.folded = folded();
  )js",
            {false, 400});
  EXPECT_EQ(count(seen, "data-width"), 400);
  EXPECT_EQ(count(seen, "data-hidden"), 0);
  EXPECT_GE(count(seen, "data-letters"), 12);
  EXPECT_LE(count(seen, "data-longest"), 6) << "of the numbers on axes";
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-scrolled"), "true");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-said"), "true")
      << "what is wider than the page says so, and nothing else";
  EXPECT_EQ(count(seen, "data-printed"), 0) << "every table is open on paper";
  EXPECT_EQ(count(seen, "data-folded"), 1) << "the words and symbols are folded again";
  expect_contrast(seen, false);
}

TEST_F(PageInBrowser, SaysWhereNothingCanBeDrawn) {
  output::Page page;
  page.title = "empty";
  const output::Chart logarithm{"no positive value", "",         {"x [-]"},
                                {"y [-]", true},     {0.0, 1.0}, {{"negative", {-1.0, 0.0}}}};
  const output::Chart point{"one point", "", {"x [-]"}, {"y [-]"}, {2.0}, {{"constant", {3.0}}}};
  page.sections = {{"Section", "", {logarithm, point}}};
  const browser::Visit seen = visit(output::to_html(page));
  EXPECT_EQ(count(seen, "data-panels"), 1);
  EXPECT_EQ(count(seen, "data-drawn"), 1);
  EXPECT_NE(seen.dom.find("No values to draw."), std::string::npos);
}

TEST_F(PageInBrowser, NoticesChartsThatWereNotPainted) {
  std::string html = output::to_html(report::sample_page());
  html.insert(html.find("<main>"), "<style>.plot .data { display: none; }</style>");
  const browser::Visit seen = visit(html);
  EXPECT_EQ(count(seen, "data-panels"), kPanels);
  EXPECT_EQ(count(seen, "data-drawn"), 0);
}

constexpr const char* kCallHome = R"js(
  fetch('http://sonoglide.invalid/fetched').catch(() => {});
  document.body.append(Object.assign(new Image(), {src: 'http://sonoglide.invalid/image.png'}));
)js";

TEST_F(PageInBrowser, NetworkLogShowsARequestWhereOneIsMade) {
  const browser::Visit seen = visit("<!DOCTYPE html><body></body>", kCallHome);
  EXPECT_EQ(seen.requests.size(), 2U);
}

TEST_F(PageInBrowser, PolicyStopsEvenAScriptThatCallsHome) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), kCallHome);
  EXPECT_EQ(count(seen, "data-drawn"), kPanels);
  EXPECT_TRUE(seen.requests.empty()) << seen.requests.front();
}

}  // namespace
}  // namespace sonoglide::page_test
