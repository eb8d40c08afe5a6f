#include "host_sim/studies/identify/identification.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "host_sim/output/number.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::identify {

using nlohmann::ordered_json;

namespace {

ordered_json to_json(const Correlations& correlations) {
  ordered_json rows = ordered_json::array();
  for (const std::vector<double>& row : correlations.rows) {
    ordered_json cells = ordered_json::array();
    for (const double each : row) {
      cells.push_back(output::json_number(each));
    }
    rows.push_back(std::move(cells));
  }
  return {{"names", correlations.names}, {"rows", std::move(rows)}};
}

}  // namespace

ordered_json to_json(const std::vector<Estimate>& parameters) {
  ordered_json json = ordered_json::object();
  for (const Estimate& each : parameters) {
    json[each.name] = {{"value", output::json_number(each.value)},
                       {"low_95", output::json_number(each.low_95)},
                       {"high_95", output::json_number(each.high_95)}};
  }
  return json;
}

ordered_json to_json(const Identification& identification) {
  ordered_json json;
  json["program"] = output::program_json();
  json["subject"] = identification.subject;
  json["model"] = identification.model;
  json["parameters"] = to_json(identification.parameters);
  json["residual_rms"] = output::json_number(identification.residual_rms);
  json["misfit"] = output::json_number(identification.misfit);
  if (!identification.correlations.names.empty()) {
    json["correlations"] = to_json(identification.correlations);
  }
  json["warnings"] = identification.warnings;
  json["cannot_tell"] = identification.cannot_tell;
  return json;
}

std::string formatted(const std::string& name, double value, const char* otherwise) {
  if (!std::isfinite(value)) {
    return otherwise;
  }
  const std::string unit = scene::unit_of(name);
  if (unit.empty()) {
    return fmt::format("{:.5g}", value);
  }
  if (unit == "kg" || unit == "1/m" || unit == "s/m") {
    return fmt::format("{:.5g} {}", value, unit);
  }
  return output::quantity(value, unit, unit == "Hz" ? 7 : 5);
}

void append(std::vector<std::string>& sentences, std::vector<Remark> remarks) {
  for (Remark& each : remarks) {
    if (each.holds) {
      sentences.push_back(std::move(each.sentence));
    }
  }
}

output::Table figure_table(const std::vector<Estimate>& figures) {
  output::Table table{"", {"Parameter", "Value", "95 % from", "to", "±"}, {}};
  for (const Estimate& each : figures) {
    const double half = 0.5 * (each.high_95 - each.low_95) / std::abs(each.value);
    table.rows.push_back({each.name, formatted(each.name, each.value, "open"),
                          formatted(each.name, each.low_95), formatted(each.name, each.high_95),
                          output::formatted(100.0 * half, half < 0.095 ? "{:.2g} %" : "{:.0f} %")});
  }
  return table;
}

output::Table correlation_table(const Correlations& correlations) {
  output::Table table{"", {""}, {}};
  table.header.insert(table.header.end(), correlations.names.begin(), correlations.names.end());
  for (std::size_t i = 0; i < correlations.names.size(); ++i) {
    std::vector<std::string> row = {correlations.names[i]};
    for (const double each : correlations.rows[i]) {
      row.push_back(output::formatted(each, "{:.2f}"));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

output::Table sentence_table(const std::string& title, const std::vector<std::string>& sentences) {
  output::Table table{title, {}, {}};
  for (const std::string& each : sentences) {
    table.rows.push_back({each});
  }
  return table;
}

output::Curve dots(const std::string& label, std::vector<double> x, std::vector<double> y) {
  return {label, std::move(y), output::Line::dots, std::move(x)};
}

std::string remark_lines(const std::vector<std::string>& warnings,
                         const std::vector<std::string>& cannot_tell) {
  std::string lines;
  for (const std::string& each : warnings) {
    lines += fmt::format("WARNING: {}\n", each);
  }
  for (const std::string& each : cannot_tell) {
    lines += fmt::format("CANNOT TELL: {}\n", each);
  }
  return lines;
}

}  // namespace sonoglide::identify
