#include "host_sim/output/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace sonoglide::output {
namespace {

constexpr int kOrdinateDigits = 7;
constexpr int kExactDigits = 17;

/// Digits that resolve 1e-7 of the span of x even far from zero.
int abscissa_digits(const std::vector<double>& x) {
  if (x.empty()) {
    return kExactDigits;
  }
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  if (!(*high > *low)) {
    return kExactDigits;
  }
  const double largest = std::max(std::abs(*low), std::abs(*high));
  const double offset_digits = std::ceil(std::log10(largest / (*high - *low)));
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

std::string numbers(const std::vector<double>& values, int digits = kOrdinateDigits) {
  std::string json;
  append_numbers(json, values, digits);
  return json;
}

std::string axis_json(const Axis& axis) {
  std::string json = fmt::format(
      R"({{"label":{},"logarithmic":{},"ends":{},"verbatim":{},"hasZero":{},"whole":{},"ticks":[)",
      json_string(axis.label), axis.logarithmic, numbers({axis.span.low, axis.span.high}),
      axis.verbatim, axis.has_zero, axis.whole_numbers);
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    json += fmt::format(R"({}{{"at":{:.17g},"text":{}}})", i == 0 ? "" : ",", axis.ticks[i].at,
                        json_string(axis.ticks[i].name));
  }
  return json + "]}";
}

const char* name_of(Line line) {
  constexpr std::array<const char*, 8> names = {"joined", "bridged", "stepped",     "dots",
                                                "area",   "band",    "full_height", "bar"};
  return names.at(static_cast<std::size_t>(line));
}

std::string pen_json(const Pen& pen) {
  if (pen.colour.empty()) {
    return "null";
  }
  return fmt::format(R"({{"colour":{},"width":{:g},"dash":{},"symbol":{},"size":{:g},"every":{}}})",
                     json_string(pen.colour), pen.width, pen.dash, pen.symbol, pen.size, pen.every);
}

std::string curve_json(const Curve& curve) {
  std::string json = fmt::format(R"({{"label":{},"verbatim":{},"line":"{}","pen":{},"y":)",
                                 json_string(curve.label), curve.verbatim, name_of(curve.line),
                                 pen_json(curve.pen));
  append_numbers(json, curve.y, kOrdinateDigits);
  if (!curve.x.empty()) {
    json += R"(,"x":)";
    append_numbers(json, curve.x, abscissa_digits(curve.x));
  }
  if (!curve.half_width.empty()) {
    json += R"(,"halfWidth":)";
    append_numbers(json, curve.half_width, kOrdinateDigits);
  }
  return json + '}';
}

std::string tiles_json(const Tiles& tiles) {
  std::string json = fmt::format(R"({{"label":{},"colour":{},"behind":{},"all":[)",
                                 json_string(tiles.label), json_string(tiles.colour), tiles.behind);
  for (std::size_t i = 0; i < tiles.all.size(); ++i) {
    const Tile& tile = tiles.all[i];
    json += (i == 0 ? "" : ",") +
            numbers({tile.x.low, tile.x.high, tile.y.low, tile.y.high, tile.value});
  }
  return json + "]}";
}

std::string mark_json(const Mark& mark) {
  return fmt::format(R"({{"text":{},"x":{:.17g},"y":{:.17g}}})", json_string(mark.text), mark.x,
                     mark.y);
}

template <class Part>
std::string array_json(const std::vector<Part>& parts, std::string (*json_of)(const Part&)) {
  std::string json = "[";
  for (const Part& each : parts) {
    json += (json.size() == 1 ? "" : ",") + json_of(each);
  }
  return json + ']';
}

}  // namespace

std::string chart_json(const Chart& chart) {
  return fmt::format(R"({{"title":{},"group":{},"equalScales":{},"x":{},"y":{},"abscissae":{},)"
                     R"("series":{},"tiles":{},"marks":{}}})",
                     json_string(chart.title), json_string(chart.group), chart.equal_scales,
                     axis_json(chart.x_axis), axis_json(chart.y_axis),
                     numbers(chart.x, abscissa_digits(chart.x)),
                     array_json(chart.curves, curve_json), array_json(chart.tiles, tiles_json),
                     array_json(chart.marks, mark_json));
}

bool has_something_to_draw(const Chart& chart) {
  const bool has_tiles =
      std::any_of(chart.tiles.begin(), chart.tiles.end(),
                  [](const Tiles& tiles) { return !tiles.behind && !tiles.all.empty(); });
  return has_tiles ||
         std::any_of(chart.curves.begin(), chart.curves.end(), [&](const Curve& curve) {
           return std::any_of(curve.y.begin(), curve.y.end(), [&](double y) {
             return std::isfinite(y) && (!chart.y_axis.logarithmic || y > 0.0);
           });
         });
}

}  // namespace sonoglide::output
