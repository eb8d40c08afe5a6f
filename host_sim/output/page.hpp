/// A report page as data: what is said and drawn, not how.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/output/chart.hpp"

namespace sonoglide::output {

/// A long one is folded. A column of numbers is set flush right: at least half of its cells are such, and no
/// other one is long.
struct Table {
  std::string title;                ///< empty: none
  std::vector<std::string> header;  ///< empty: no heading row
  std::vector<std::vector<std::string>> rows;
  bool folded = false;  ///< though it is short
};

/// Charts and tables under one heading.
struct Section {
  std::string title;
  std::string text;
  std::vector<Chart> charts;  ///< first, whatever else there is
  std::vector<Table> tables = {};
};

// Moved JSON throws nothing, but its assertions are not marked so.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Page {
  std::string title;
  std::string lead;                   ///< what was run, in a sentence or two
  std::vector<std::string> warnings;  ///< shown first, set apart
  std::vector<Table> tables;
  std::vector<Section> sections;
  /// What was run: scene_file::to_json() of the scene, of many the one that they vary. Keys that
  /// `--set` changed are marked in it. Command and version come from program(); nothing else is to be
  /// done for them.
  nlohmann::ordered_json scene = nullptr;
  /// Of all random numbers, where there are some.
  std::optional<std::uint64_t> seed = std::nullopt;
  std::vector<std::string> notes = {};  ///< below the warnings: good to know, nothing is wrong
};

/// The page as one self-contained HTML file: no network request, zoom and hover on every chart.
///
/// Words and symbols that the page uses are explained at its end, by the glossary.
/// Ordinates are written with 7 significant digits, abscissae with as many as resolve 1e-7 of their
/// span. Once drawn, <body> carries data-panels (charts that have something to draw) and data-drawn
/// (charts that show it), and each chart's <figure> its Chart (page/chart.js) as the property `chart`.
/// @throws std::invalid_argument if a chart's x decreases, an x is not finite, a curve has not one
/// value for each, or a table row not one cell for each heading.
std::string to_html(const Page& page);

}  // namespace sonoglide::output
