#include "host_sim/sweep/axis.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "host_sim/scene/number.hpp"
#include "host_sim/scene/scene_error.hpp"

namespace sonoglide::sweep {
namespace {

constexpr std::string_view form = "allowed: KEY=FROM:TO:COUNT or KEY=FROM:TO:COUNT:log";

/// What to blame an error on.
struct Place {
  std::size_t ordinal;
  std::string key;

  [[noreturn]] void fail(const std::string& message) const {
    throw scene::SceneError({"--vary", ordinal, 1}, key, message);
  }
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

double bound(const std::string& text, const char* name, const Place& place) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') {
    place.fail(fmt::format("{} \"{}\" is not a number; {}", name, text, form));
  }
  if (!std::isfinite(value)) {
    place.fail(fmt::format("{} {} is not finite; allowed: a finite number", name, text));
  }
  return value;
}

std::size_t count_of(const std::string& text, const Place& place) {
  constexpr std::size_t most_digits = 8;
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t count =
      digits && text.size() <= most_digits ? std::strtoul(text.c_str(), nullptr, 10) : 0;
  if (count < 1 || count > most_points) {
    place.fail(fmt::format("COUNT \"{}\"; allowed: a whole number, 1 to {}", text, most_points));
  }
  return count;
}

bool have_one_sign(double a, double b) {
  return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0);
}

}  // namespace

double Axis::value(std::size_t index) const {
  if (index == 0) {
    return from;
  }
  if (index + 1 == count) {
    return to;
  }
  const auto intervals = static_cast<double>(count - 1);
  const auto step = static_cast<double>(index);
  if (!logarithmic) {
    // The product comes first: whole values of a whole range stay whole.
    const double span = to - from;
    return std::isfinite(span * step) ? from + span * step / intervals
                                      : from * (1.0 - step / intervals) + to * (step / intervals);
  }
  // By decades: powers of ten come out exactly.
  const double first = std::log10(std::abs(from));
  const double last = std::log10(std::abs(to));
  return std::copysign(std::pow(10.0, first + (last - first) * step / intervals), from);
}

Axis parse_axis(const std::string& text, std::size_t ordinal) {
  const std::size_t equals = text.find('=');
  Place place{ordinal, text.substr(0, equals)};
  if (place.key.empty()) {
    place.key = "--vary";
    place.fail(fmt::format("no key; {}", form));
  }
  if (equals == std::string::npos) {
    place.fail(fmt::format("no range; {}", form));
  }
  const std::vector<std::string> parts = split(text.substr(equals + 1), ':');
  if (parts.size() < 3 || parts.size() > 4) {
    place.fail(fmt::format("\"{}\" is not a range; {}", text.substr(equals + 1), form));
  }
  Axis axis{place.key, bound(parts[0], "FROM", place), bound(parts[1], "TO", place),
            count_of(parts[2], place), parts.size() == 4};
  if (axis.logarithmic && parts[3] != "log") {
    place.fail(fmt::format("unknown spacing \"{}\"; {}", parts[3], form));
  }
  if (axis.logarithmic && !have_one_sign(axis.from, axis.to)) {
    place.fail(fmt::format("{} to {} has no logarithm; allowed: FROM and TO of one sign, not zero",
                           parts[0], parts[1]));
  }
  if (axis.count == 1 && axis.from != axis.to) {
    place.fail(fmt::format("one value from {} to {}; allowed: FROM equal to TO, or a COUNT above 1",
                           parts[0], parts[1]));
  }
  return axis;
}

std::string value_text(double value) {
  return scene::is_written_whole(value) ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
}

}  // namespace sonoglide::sweep
