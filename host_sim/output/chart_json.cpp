#include "host_sim/output/chart_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace sonoglide::output {
namespace {

constexpr int kOrdinateDigits = 7;
constexpr int kExactDigits = 17;

/// Digits that resolve 1e-7 of the span of x even far from zero.
int abscissa_digits(const std::vector<double>& x) {
  if (x.empty() || !(x.back() > x.front())) {
    return kExactDigits;
  }
  const double largest = std::max(std::abs(x.front()), std::abs(x.back()));
  const double offset_digits = std::ceil(std::log10(largest / (x.back() - x.front())));
  return std::clamp(kOrdinateDigits + static_cast<int>(std::max(offset_digits, 0.0)),
                    kOrdinateDigits, kExactDigits);
}

void append_numbers(std::string& json, const std::vector<double>& values, int digits) {
  json += '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) {
      json += ',';
    }
    if (std::isfinite(values[i])) {
      fmt::format_to(std::back_inserter(json), "{:.{}g}", values[i], digits);
    } else {
      json += "null";
    }
  }
  json += ']';
}

std::string quoted(const std::string& text) {
  const std::string json =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

const char* boolean(bool value) {
  return value ? "true" : "false";
}

void append_series(std::string& json, const Series& series) {
  json += fmt::format(R"({{"label":{},"stepped":{},"connectGaps":{},"marked":{},"y":)",
                      quoted(series.label), boolean(series.stepped), boolean(series.connect_gaps),
                      boolean(series.marked));
  append_numbers(json, series.y, kOrdinateDigits);
  json += '}';
}

}  // namespace

std::string chart_json(const Panel& panel) {
  std::string json = fmt::format(
      R"({{"title":{},"xLabel":{},"yLabel":{},"logarithmicX":{},"logarithmicY":{},"group":{},"x":)",
      quoted(panel.title), quoted(panel.x_label), quoted(panel.y_label),
      boolean(panel.logarithmic_x), boolean(panel.logarithmic_y), quoted(panel.group));
  append_numbers(json, panel.x, abscissa_digits(panel.x));
  json += R"(,"series":[)";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (i > 0) {
      json += ',';
    }
    append_series(json, panel.series[i]);
  }
  json += "]}";
  return json;
}

bool has_something_to_draw(const Panel& panel) {
  return std::any_of(panel.series.begin(), panel.series.end(), [&](const Series& series) {
    return std::any_of(series.y.begin(), series.y.end(), [&](double y) {
      return std::isfinite(y) && (!panel.logarithmic_y || y > 0.0);
    });
  });
}

}  // namespace sonoglide::output
