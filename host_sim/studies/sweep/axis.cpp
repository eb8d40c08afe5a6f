#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>

#include "firmware/numeric/float_exponential.hpp"
#include "host_sim/scene_file/override.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/toml_text.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {
namespace {

constexpr std::string_view form =
    "allowed: KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,...";

/// What to blame an error on.
struct Place {
  std::size_t ordinal;
  std::string key;

  scene_file::Location location() const { return {"--vary", ordinal, 1}; }
  [[noreturn]] void fail(const std::string& message) const {
    throw scene_file::SceneError(location(), key, message);
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
  constexpr std::size_t most_digits = 13;
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t count =
      digits && text.size() <= most_digits ? std::strtoul(text.c_str(), nullptr, 10) : 0;
  if (count < 1 || count > most_points_in_shards) {
    place.fail(
        fmt::format("COUNT \"{}\"; allowed: a whole number, 1 to {}", text, most_points_in_shards));
  }
  return count;
}

bool have_one_sign(double a, double b) {
  return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0);
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

ListedValue listed(const std::string& text, const Place& place) {
  if (text.find(':') != std::string::npos && text.find('"') == std::string::npos) {
    place.fail(
        fmt::format("\"{}\" in a list is a range; numbers have a decimal point; {}", text, form));
  }
  if (text.empty()) {
    place.fail(fmt::format("an empty value; {}", form));
  }
  const toml::table holder = scene_file::parse_value(text, place.key, place.location());
  const toml::node& node = *holder.get("value");
  if (const auto number = node.value<double>(); number && node.is_number()) {
    return {number_text(*number), number, scene_file::VariedValue(*number)};
  }
  if (const auto* word = node.as_string()) {
    return {word->get(), std::nullopt, scene_file::VariedValue(word->get())};
  }
  if (const auto* truth = node.as_boolean()) {
    return {truth->get() ? "true" : "false", std::nullopt, scene_file::VariedValue(truth->get())};
  }
  place.fail(fmt::format("\"{}\" is {}; allowed: numbers, words, true, false", text,
                         scene_file::kind_of(node)));
}

Axis list_axis(const std::string& values, const Place& place) {
  Axis axis;
  axis.key = place.key;
  for (const std::string& part : split(values, ',')) {
    ListedValue next = listed(trimmed(part), place);
    const bool known = std::any_of(axis.list.begin(), axis.list.end(),
                                   [&](const auto& each) { return each.text == next.text; });
    if (known) {
      place.fail(fmt::format("{} is there twice; allowed: each value once", next.text));
    }
    axis.list.push_back(std::move(next));
  }
  axis.count = axis.list.size();
  return axis;
}

Axis range_axis(const std::string& range, const Place& place) {
  const std::vector<std::string> parts = split(range, ':');
  if (parts.size() < 3 || parts.size() > 4) {
    place.fail(fmt::format("\"{}\" is not a range; {}", range, form));
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

}  // namespace

double Axis::number(std::size_t index) const {
  if (!list.empty()) {
    return list[index].number.value_or(std::numeric_limits<double>::quiet_NaN());
  }
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
  const double first = logarithm_to_ten(std::abs(from));
  const double last = logarithm_to_ten(std::abs(to));
  const double value = std::copysign(power_of_ten(first + (last - first) * step / intervals), from);
  return std::clamp(value, std::min(from, to), std::max(from, to));
}

scene_file::VariedValue Axis::value(std::size_t index) const {
  return list.empty() ? scene_file::VariedValue(number(index)) : list[index].value;
}

std::string Axis::text(std::size_t index) const {
  return list.empty() ? number_text(number(index)) : list[index].text;
}

bool Axis::has_words() const {
  return std::any_of(list.begin(), list.end(), [](const auto& each) { return !each.number; });
}

bool Axis::categorical() const {
  if (list.empty() || has_words()) {
    return !list.empty();
  }
  const auto rises = [](const auto& a, const auto& b) { return *a.number < *b.number; };
  const auto falls = [](const auto& a, const auto& b) { return *a.number > *b.number; };
  return !std::is_sorted(list.begin(), list.end(), rises) &&
         !std::is_sorted(list.begin(), list.end(), falls);
}

double Axis::position(std::size_t index) const {
  return categorical() ? static_cast<double>(index + 1) : number(index);
}

Axis parse_axis(const std::string& text, std::size_t ordinal) {
  const std::size_t equals = text.find('=');
  Place place{ordinal, text.substr(0, equals)};
  if (place.key.empty()) {
    place.key = "--vary";
    place.fail(fmt::format("no key; {}", form));
  }
  if (equals == std::string::npos) {
    place.fail(fmt::format("no values; {}", form));
  }
  const std::string values = text.substr(equals + 1);
  const bool is_range =
      values.find(',') == std::string::npos && values.find(':') != std::string::npos;
  return is_range ? range_axis(values, place) : list_axis(values, place);
}

std::string number_text(double value) {
  return scene_file::is_written_whole(value) ? fmt::format("{:.0f}", value)
                                             : fmt::format("{}", value);
}

namespace {

[[noreturn]] void fail(std::size_t axis, const std::string& key, const std::string& message) {
  throw scene_file::SceneError({"--vary", axis + 1, 1}, key, message);
}

}  // namespace

Grid::Grid(std::vector<Axis> axes, std::size_t most)
    : axes_(std::move(axes)), strides_(axes_.size()) {
  if (axes_.empty()) {
    fail(0, "--vary", "nothing is varied; allowed: at least one --vary");
  }
  for (std::size_t axis = axes_.size(); axis-- > 0;) {
    strides_[axis] = size_;
    if (axes_[axis].count > most / size_) {
      fail(axis, axes_[axis].key,
           fmt::format("more than {0} points in all; allowed: at most {0}{1}", most,
                       most < most_points_in_shards
                           ? fmt::format(", in shards at most {}", most_points_in_shards)
                           : ""));
    }
    size_ *= axes_[axis].count;
  }
}

namespace {

constexpr double ln10 = 2.302585092994045684;
constexpr double log10_of_2 = 0.30102999566398119521;

/// 10^n, correctly rounded as texts are when they are read.
double whole_power(int n) {
  constexpr int lowest = -324;
  constexpr int highest = 309;
  static const auto table = [] {
    std::array<double, highest - lowest + 1> powers{};
    for (std::size_t i = 0; i < powers.size(); ++i) {
      powers[i] = std::strtod(fmt::format("1e{}", lowest + static_cast<int>(i)).c_str(), nullptr);
    }
    return powers;
  }();
  return table[static_cast<std::size_t>(std::clamp(n, lowest, highest) - lowest)];
}

}  // namespace

double power_of_ten(double x) {
  const double whole = std::floor(x + 0.5);
  return numeric::exp((x - whole) * ln10) * whole_power(static_cast<int>(whole));
}

double logarithm_to_ten(double x) {
  // Of few digits, so that 10^first is x but for a small rest, and x itself for a power of ten.
  const auto few_digits = static_cast<float>(numeric::log2(x) * log10_of_2);
  const auto first = static_cast<double>(few_digits);
  const double rest = x / power_of_ten(first) - 1.0;
  return first + (rest - 0.5 * rest * rest) / ln10;
}

}  // namespace sonoglide::sweep
