#include "host_sim/studies/identify/identification.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "host_sim/output/number.hpp"

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

std::string unit_of(const std::string& name) {
  static constexpr std::pair<const char*, const char*> units[] = {{"_ohm", "ohm"},
                                                                  {"_F", "F"},
                                                                  {"_H", "H"},
                                                                  {"_Hz", "Hz"},
                                                                  {"_N_per_V", "N/V"},
                                                                  {"_N_per_m", "N/m"},
                                                                  {"_N_s_per_m", "N s/m"},
                                                                  {"_kg", "kg"},
                                                                  {"_m_per_s", "m/s"},
                                                                  {"_s_per_m", "s/m"},
                                                                  {"_per_m", "1/m"},
                                                                  {"_N", "N"},
                                                                  {"_m", "m"},
                                                                  {"_s", "s"}};
  for (const auto& [ending, unit] : units) {
    const std::string end = ending;
    if (name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) {
      return unit;
    }
  }
  return {};
}

ordered_json to_json(const Identification& identification) {
  ordered_json json;
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
  const std::string unit = unit_of(name);
  if (unit.empty()) {
    return fmt::format("{:.5g}", value);
  }
  if (unit == "kg" || unit == "1/m" || unit == "s/m") {
    return fmt::format("{:.5g} {}", value, unit);
  }
  return output::quantity(value, unit, unit == "Hz" ? 7 : 5);
}

}  // namespace sonoglide::identify
