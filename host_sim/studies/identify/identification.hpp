/// What every identification tells, and its file identify.json.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"

namespace sonoglide::identify {

/// A value with the ends of its 95 % interval.
struct Estimate {
  std::string name;  ///< with its unit, as `motional_resistance_ohm`
  double value;
  double low_95;
  double high_95;
  bool may_be_0 = false;  ///< or less: its interval is not one of the logarithm
};

/// Correlations of the fitted parameters: row and column in the order of the names.
struct Correlations {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
};

struct Identification {
  std::string subject;  ///< "impedance" or "friction"
  std::string model;    ///< in words
  std::vector<Estimate> parameters;
  double residual_rms = 0.0;  ///< relative to the measured value
  /// Root mean square of what the residuals have that is no scatter from reading to reading,
  /// relative to the measured value; 0 where none is seen.
  double misfit = 0.0;
  Correlations correlations;          ///< without names: none are told
  std::vector<std::string> warnings;  ///< each a sentence
  std::vector<std::string>
      cannot_tell;  ///< each a sentence: what the data leave open, and what would tell
};

/// As they stand in identify.json; what is not finite becomes null.
nlohmann::ordered_json to_json(const std::vector<Estimate>& parameters);
nlohmann::ordered_json to_json(const Identification& identification);

/// A value as a table shows it, `52.675 mH`: five digits, of a frequency seven, with the prefix that
/// suits. The unit is that of the name's ending; of a mass, without prefix.
/// @param otherwise  what stands for a value that is not finite
std::string formatted(const std::string& name, double value, const char* otherwise = "-");

// What the reports of all identifications have in common: remarks, tables, curves.

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

/// A curve of dots.
output::Curve dots(const std::string& label, std::vector<double> x = {},
                   std::vector<double> y = {});

/// As they are printed.
std::string remark_lines(const std::vector<std::string>& warnings,
                         const std::vector<std::string>& cannot_tell);

}  // namespace sonoglide::identify
