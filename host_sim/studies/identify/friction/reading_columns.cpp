#include "host_sim/studies/identify/friction/reading_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/suggestion.hpp"
#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify::friction {
namespace {

constexpr std::array known = {
    KnownColumn{"sliding_velocity_m_per_s", 1e-12, 100.0,
                "m/s; at rest friction has no mean over a period"},
    KnownColumn{"vibration_velocity_m_per_s", 0.0, 100.0, "m/s, peak; 0 without vibration"},
    KnownColumn{"velocity_ratio", 1e-9, 1e9, "sliding velocity over peak vibration velocity"},
    KnownColumn{"vibration_amplitude_m", 0.0, 0.01, "m; 0 without vibration"},
    KnownColumn{"frequency_Hz", 1.0, 1e9, "Hz"},
    KnownColumn{"friction_ratio", -0.5, 1.5,
                "friction with vibration over friction without, neither percent nor reduction"},
    KnownColumn{"friction_force_N", -1e9, 1e9, "N"},
    KnownColumn{"friction_ratio_standard_error", 1e-12, 1.0, "that of the friction ratio"},
    KnownColumn{"friction_force_standard_error_N", 1e-24, 1e9, "N"}};

constexpr std::size_t longest_name = 100;

std::vector<std::string_view> known_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(known));
  for (const KnownColumn& each : known) {
    names.push_back(each.name);
  }
  return names;
}

const KnownColumn* find_known(std::string_view name) {
  const auto* const each = std::find_if(known.begin(), known.end(),
                                        [&](const KnownColumn& any) { return any.name == name; });
  return each == known.end() ? nullptr : each;
}

/// Without the unit in brackets that ends it.
std::string name_of(const std::string& title) {
  const std::size_t open = title.find_last_of("([");
  const bool ends = !title.empty() && (title.back() == ')' || title.back() == ']');
  return open == std::string::npos || !ends
             ? title
             : title.substr(0, title.find_last_not_of(" ([", open) + 1);
}

}  // namespace

bool are_names_of_readings(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& each) { return find_known(name_of(each)) != nullptr; });
}

ReadingColumns::ReadingColumns(const MeasuredTable& table) : table_(table) {
  for (std::size_t i = 0; i < table.names().size(); ++i) {
    take(table.names()[i], i);
  }
}

std::vector<double> ReadingColumns::numbers(std::string_view name) const {
  const Column& column = *find(name);
  std::vector<double> values = table_.numbers(column.index);
  for (std::size_t row = 0; row < values.size(); ++row) {
    const KnownColumn& range = *column.known;
    if (values[row] < range.least || values[row] > range.most) {
      throw table_.error(row, column.index,
                         fmt::format("is out of range; allowed: from {:g} up to {:g} ({})",
                                     range.least, range.most, range.hint));
    }
  }
  return values;
}

std::string_view ReadingColumns::one_of(std::initializer_list<std::string_view> names) const {
  std::string_view found;
  std::string list;
  for (const std::string_view name : names) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
    if (has(name)) {
      if (!found.empty()) {
        throw table_.heading_error(
            fmt::format("has both {} and {}; allowed: one of them", found, name));
      }
      found = name;
    }
  }
  if (found.empty()) {
    throw table_.heading_error(
        fmt::format("a column is missing; allowed: {}{}", names.size() > 1 ? "one of " : "", list));
  }
  return found;
}

const ReadingColumns::Column* ReadingColumns::find(std::string_view name) const {
  for (const Column& each : columns_) {
    if (each.known->name == name) {
      return &each;
    }
  }
  return nullptr;
}

void ReadingColumns::take(const std::string& title, std::size_t index) {
  const std::string name = name_of(title.size() > longest_name ? shortened(title) : title);
  const KnownColumn* each = find_known(name);
  if (each == nullptr) {
    throw unknown(name, index);
  }
  if (has(name)) {
    throw table_.heading_error(index, fmt::format("names {} twice; allowed: once", name));
  }
  const std::string unit = unit_in_brackets(title);
  const std::string own = scene::unit_of(name).empty() ? "-" : scene::unit_of(name);
  if (!unit.empty() && unit != own) {
    throw table_.heading_error(
        index, fmt::format("\"{}\" is no unit of {}; allowed: {}", unit, name, own));
  }
  columns_.push_back({each, index});
}

scene_file::SceneError ReadingColumns::unknown(const std::string& name, std::size_t index) const {
  if (const auto near = scene_file::nearest_name(name, known_names())) {
    const std::string unit = scene::unit_of(*near);
    return table_.heading_error(
        index, fmt::format("unknown column \"{}\"; did you mean {}?{}", name, *near,
                           unit.empty() ? "" : " It is in " + unit + "."));
  }
  return table_.heading_error(index, fmt::format("unknown column \"{}\"; allowed: {}", name,
                                                 fmt::join(known_names(), ", ")));
}

}  // namespace sonoglide::identify::friction
