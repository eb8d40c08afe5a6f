/// The report page in a real browser: it draws, answers the mouse and asks the network for nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host_sim/output/page.hpp"
#include "sample_page.hpp"
#include "tests/acceptance/page/browser.hpp"
#include "tests/acceptance/page/exercise.hpp"

namespace sonoglide::page_test {
namespace {

constexpr int kPanels = 7;

class PageInBrowser : public ::testing::Test {
 protected:
  browser::Visit visit(const std::string& html, const std::string& script = "") {
    std::ofstream(file_, std::ios::binary) << html;
    return browser::load(file_, script);
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

TEST_F(PageInBrowser, ShowsSiPrefixesThatFollowTheZoom) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const figure = [...document.querySelectorAll('figure.panel')].find(
        (f) => f.querySelector('h3').textContent === 'Displacement');
    const name = (axis) => figure.querySelector('.axis-name.' + axis).textContent;
    document.body.dataset.before = name('x') + ', ' + name('y');
    figure.chart.updateOptions({valueRange: [-5e-10, 5e-10]});
    document.body.dataset.after = name('x') + ', ' + name('y');
  )js");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-before"), "Time [ms], Displacement [nm]");
  EXPECT_EQ(browser::body_attribute(seen.dom, "data-after"), "Time [ms], Displacement [pm]");
}

TEST_F(PageInBrowser, DrawsEverySeriesOfTheLoopAcrossItsGaps) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const figure = [...document.querySelectorAll('figure.panel')].find(
        (f) => f.querySelector('h3').textContent === 'Friction against displacement');
    const canvas = figure.querySelector('canvas');
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const columnsOf = (swatch) => {
      const [r, g, b] = getComputedStyle(swatch).borderTopColor.match(/[0-9]+/g).map(Number);
      const columns = new Set();
      for (let i = 0; i < pixels.length; i += 4) {
        if (pixels[i + 3] > 64 && Math.abs(pixels[i] - r) < 24 &&
            Math.abs(pixels[i + 1] - g) < 24 && Math.abs(pixels[i + 2] - b) < 24) {
          columns.add((i / 4) % canvas.width);
        }
      }
      return columns.size / (figure.chart.getArea().w * canvas.width / figure.chart.width_);
    };
    const shares = [...figure.querySelectorAll('.swatch')].map(columnsOf);
    document.body.dataset.least = String(Math.round(100 * Math.min(...shares)));
  )js");
  EXPECT_GE(count(seen, "data-least"), 95);  // percent of the columns of the plot
}

TEST_F(PageInBrowser, LaysChartsOutForTheSheetWhilePrinting) {
  const browser::Visit seen = visit(output::to_html(report::sample_page()), R"js(
    const widest = () => String(Math.max(
        ...[...document.querySelectorAll('.chart canvas')].map((c) => c.clientWidth)));
    document.body.dataset.screen = widest();
    window.dispatchEvent(new Event('beforeprint'));
    document.body.dataset.sheet = widest();
    window.dispatchEvent(new Event('afterprint'));
    document.body.dataset.again = widest();
  )js");
  EXPECT_EQ(count(seen, "data-screen"), 1024);
  EXPECT_EQ(count(seen, "data-sheet"), 680);
  EXPECT_EQ(count(seen, "data-again"), 1024);
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
  html.insert(html.find("<main>"),
              "<script>CanvasRenderingContext2D.prototype.stroke = () => {};</script>");
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
