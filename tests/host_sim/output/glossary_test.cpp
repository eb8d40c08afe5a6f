#include "host_sim/output/html.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sonoglide::output::glossary_test {
namespace {

using Words = std::vector<std::string>;

Words words_of_page(const Page& page) {
  Words words;
  for (const std::vector<std::string>& row : words_of(page).rows) {
    words.push_back(row.at(0));
  }
  return words;
}

Words words_in(const std::string& text) {
  Page page;
  page.lead = text;
  return words_of_page(page);
}

TEST(Glossary, ExplainsTheSymbolsOfAPageAndThenItsTerms) {
  EXPECT_EQ(
      words_in("Carriers: Fc/(Kt |V|max), 1 % of Ks/(m ω²)"),
      (Words{"Vt", "x'", "V", "Fc", "N, Fn", "μ, mu", "Kt", "Ks", "m", "f", "ω, w", "Carrier"}));
  EXPECT_EQ(words_in("Vt + x'"), (Words{"Vt", "x'"}));
  EXPECT_EQ(words_in("the friction ratio"), Words{"Friction ratio"});
}

TEST(Glossary, AUnitIsNoSymbol) {
  EXPECT_EQ(words_in("384 N at 2.5 m/s, 10V, [V], [N/m]"), Words{});
  EXPECT_EQ(words_in("2 kz"), Words{"kz"});
}

TEST(Glossary, APartOfAWordIsNone) {
  EXPECT_EQ(words_in("Ks_N Vtx mω codec"), Words{});
  EXPECT_EQ(words_in("per unit"), Words{"Per unit"}) << "and not Unit";
}

TEST(Glossary, MeaningsAreSentencesWithoutMarkdown) {
  Page page;
  page.lead = "FMU, Ks";
  const std::vector<std::vector<std::string>> rows = words_of(page).rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0][1], "Stiffness of the spring that holds the mass.");
  EXPECT_EQ(
      rows[1][1],
      "Functional mock-up unit, a model as a ZIP file that many simulation tools import, after "
      "the standard FMI (fmi).");
}

TEST(Glossary, LooksAtEveryPartOfAPage) {
  Chart chart{"Fs", "Fe", {"Vt [m/s]"}, {"Kt"}, {0.0}, {{"Nf", {1.0}}}};
  chart.x_axis.ticks = {{0.0, "C0"}};
  chart.tiles = {{{}, "", "R1"}};
  chart.marks = {{"fn", 0.0, 0.0}};
  Page page;
  page.title = "L1";
  page.warnings = {"C1"};
  page.tables = {{"Ef", {"Efu"}, {{"Vc"}}}};
  page.sections = {{"σ0", "σ2", {chart}, {{"kx", {}, {{"kz"}}}}}};
  const Words words = words_of_page(page);
  for (const char* name : {"L1", "C1", "Ef", "Efu", "Vc", "σ0", "σ2", "Fs", "Fe", "Vt", "Kt", "Nf",
                           "C0", "R1", "fn", "kx", "kz"}) {
    EXPECT_EQ(std::count(words.begin(), words.end(), name), 1) << name;
  }
}

TEST(Glossary, ExplainsTheLimitsAndFaultsOfTheController) {
  Page page;
  page.lead = "Limit velocity_at_rail, mismatch (0.5); Fault velocity_stuck";
  const Words words = words_of_page(page);
  for (const char* name : {"Limit", "Fault", "velocity_at_rail", "mismatch", "velocity_stuck",
                           "measurement_implausible"}) {
    EXPECT_EQ(std::count(words.begin(), words.end(), name), 1) << name;
  }
  EXPECT_EQ(words_in("The current, a voltage, mismatch_warning"), Words{});
}

TEST(Glossary, ExplainsTheSymbolsOfItsMeanings) {
  EXPECT_EQ(words_in("drive input ratio"),
            (Words{"Vt", "Fc", "N, Fn", "μ, mu", "Drive input ratio"}));
}

}  // namespace
}  // namespace sonoglide::output::glossary_test
