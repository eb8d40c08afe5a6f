#include "host_sim/output/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

template <class Part, class JsonOf>
std::string array_json(const std::vector<Part>& parts, const JsonOf& json_of) {
  std::string json = "[";
  for (const Part& each : parts) {
    json += (json.size() == 1 ? "" : ",") + json_of(each);
  }
  return json + ']';
}

std::string numbers(const std::vector<double>& values, int digits = kOrdinateDigits) {
  return array_json(values, [digits](double value) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("null");
  });
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

std::string tick_json(const Tick& tick) {
  return fmt::format(R"({{"at":{:.17g},"text":{}}})", tick.at, json_string(tick.name));
}

std::string axis_json(const Axis& axis) {
  return fmt::format(
      R"({{"label":{},"logarithmic":{},"ends":{},"verbatim":{},"hasZero":{},"whole":{},"ticks":{}}})",
      json_string(axis.label), axis.logarithmic, numbers({axis.span.low, axis.span.high}),
      axis.verbatim, axis.has_zero, axis.whole_numbers, array_json(axis.ticks, tick_json));
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
  std::string json = fmt::format(R"({{"label":{},"verbatim":{},"line":"{}","pen":{},"y":{})",
                                 json_string(curve.label), curve.verbatim, name_of(curve.line),
                                 pen_json(curve.pen), numbers(curve.y));
  if (!curve.x.empty()) {
    json += R"(,"x":)" + numbers(curve.x, abscissa_digits(curve.x));
  }
  if (!curve.half_width.empty()) {
    json += R"(,"halfWidth":)" + numbers(curve.half_width);
  }
  return json + '}';
}

std::string tile_json(const Tile& tile) {
  return numbers({tile.x.low, tile.x.high, tile.y.low, tile.y.high, tile.value});
}

std::string tiles_json(const Tiles& tiles) {
  return fmt::format(R"({{"label":{},"colour":{},"behind":{},"all":{}}})", json_string(tiles.label),
                     json_string(tiles.colour), tiles.behind, array_json(tiles.all, tile_json));
}

std::string mark_json(const Mark& mark) {
  return fmt::format(R"({{"text":{},"x":{:.17g},"y":{:.17g}}})", json_string(mark.text), mark.x,
                     mark.y);
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
