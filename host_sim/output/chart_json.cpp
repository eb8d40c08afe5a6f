#include "host_sim/output/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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

std::string json_string(const std::string& text) {
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

void append_curve(std::string& json, const Curve& curve, const std::vector<double>& y) {
  json += fmt::format(R"({{"label":{},"stepped":{},"connectGaps":{},"marked":{},"y":)",
                      json_string(curve.label), curve.line == Line::stepped,
                      curve.line == Line::bridged, curve.line == Line::dots);
  append_numbers(json, y, kOrdinateDigits);
  json += '}';
}

/// Curves over abscissae that never decrease.
struct Columns {
  std::vector<double> x;
  std::vector<std::vector<double>> y;
};

/// Curves with abscissae of their own share them, with gaps at those of the others.
Columns columns(const Chart& chart) {
  struct Point {
    double x;
    std::size_t curve;
    double y;
  };
  Columns columns{chart.x, {}};
  std::vector<Point> points;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    columns.y.push_back(curve.x.empty() ? curve.y : std::vector<double>());
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      points.push_back({curve.x[k], i, curve.y[k]});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.x < b.x; });
  for (const Point& point : points) {
    columns.x.push_back(point.x);
    for (std::size_t i = 0; i < columns.y.size(); ++i) {
      columns.y[i].push_back(i == point.curve ? point.y : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return columns;
}

}  // namespace

std::string chart_json(const Chart& chart) {
  std::string json = fmt::format(
      R"({{"title":{},"xLabel":{},"yLabel":{},"logarithmicX":{},"logarithmicY":{},"group":{},"x":)",
      json_string(chart.title), json_string(chart.x_axis.label), json_string(chart.y_axis.label),
      chart.x_axis.logarithmic, chart.y_axis.logarithmic, json_string(chart.group));
  const auto [x, y] = columns(chart);
  append_numbers(json, x, abscissa_digits(x));
  json += R"(,"series":[)";
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    if (i > 0) {
      json += ',';
    }
    append_curve(json, chart.curves[i], y[i]);
  }
  json += "]}";
  return json;
}

bool has_something_to_draw(const Chart& chart) {
  return std::any_of(chart.curves.begin(), chart.curves.end(), [&](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [&](double y) {
      return std::isfinite(y) && (!chart.y_axis.logarithmic || y > 0.0);
    });
  });
}

}  // namespace sonoglide::output
