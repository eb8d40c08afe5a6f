/// What the reports of all identifications have in common: remarks, tables, curves.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify {

/// A sentence or more, and whether it is to be said.
struct Remark {
  bool holds;
  std::string sentence;
};

/// Appends the sentences of those that hold.
void append(std::vector<std::string>& sentences, std::vector<Remark> remarks);

/// Each with its interval.
output::Table figure_table(const std::vector<Estimate>& figures);

output::Table correlation_table(const Correlations& correlations);

/// A sentence a row.
output::Table sentence_table(const std::string& title, const std::vector<std::string>& sentences);

/// An abscissa of a chart of readings and fits.
struct Place {
  double x;
  double measured;             ///< not a number where there is no reading
  std::vector<double> fitted;  ///< of each curve
};

/// Draws dots at the readings and curves through all places.
/// @param places  in any order
/// @param curves  their names
void draw_fit(output::Chart& chart, std::vector<Place> places,
              const std::vector<std::string>& curves);

/// A curve of dots.
output::Curve dots(const std::string& label, std::vector<double> y);

/// As they are printed.
std::string remark_lines(const std::vector<std::string>& warnings,
                         const std::vector<std::string>& cannot_tell);

}  // namespace sonoglide::identify
