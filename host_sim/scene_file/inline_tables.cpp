#include <fmt/format.h>

#include <string>
#include <string_view>

#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/toml_text.hpp"

// Values that are tables of their own.

namespace sonoglide::scene_file {

// A target along the sliding distance, as controller.target_texture gives it.

namespace {

constexpr const char* allowed_texture =
    "{ period_m = a length, ratio = [number, number, …] }, or force_N in place of ratio";

}  // namespace

std::vector<double> TableCursor::points_in(const toml::node& node, const Part& part,
                                           const Range& range) const {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() < fewest_points || list->size() > most_points) {
    fail_part(node, part,
              fmt::format("is {}; allowed: a list of {} to {} numbers, {}",
                          list == nullptr ? std::string(kind_of(node))
                                          : fmt::format("an array of {}", list->size()),
                          fewest_points, most_points, range.text()));
  }
  std::vector<double> points;
  for (std::size_t i = 0; i < list->size(); ++i) {
    points.push_back(number_in((*list)[i], {part.key, part.name, i}, range));
  }
  return points;
}

scene::Texture TableCursor::texture(std::string_view key, const TextureTable& allowed) const {
  const toml::node& value = node(key);
  const toml::table* table = value.as_table();
  if (table == nullptr) {
    fail(key, fmt::format("is {}; allowed: {}", kind_of(value), allowed_texture));
  }
  for (const auto& [name, member] : *table) {
    if (name != "period_m" && name != "ratio" && name != "force_N") {
      fail(key, fmt::format("has an unknown {}; allowed: {}", std::string_view(name.str()),
                            allowed_texture));
    }
  }
  const toml::node* period = table->get("period_m");
  const toml::node* ratio = table->get("ratio");
  const toml::node* force = table->get("force_N");
  if (period == nullptr) {
    fail(key, fmt::format("has no period_m; allowed: {}", allowed_texture));
  }
  if ((ratio == nullptr) == (force == nullptr)) {
    fail(key, fmt::format("has {} ratio {} force_N; allowed: one of the two",
                          ratio == nullptr ? "neither" : "both", ratio == nullptr ? "nor" : "and"));
  }
  scene::Texture texture;
  texture.period_m = number_in(*period, {key, "period_m"}, allowed.period);
  texture.of_force = force != nullptr;
  texture.values = texture.of_force ? points_in(*force, {key, "force_N"}, allowed.force)
                                    : points_in(*ratio, {key, "ratio"}, allowed.ratio);
  return texture;
}

// How far a true value may be from the scene's, as [tolerance] gives it.

void TableCursor::fail_spread(std::string_view key, const std::string& found, bool whole) const {
  constexpr const char* range = "{ range = [lowest, highest] }";
  fail(key, fmt::format("is {}; allowed: {}", found,
                        whole ? fmt::format("{} of integers", range)
                              : fmt::format("a half width relative to the value, {}, {{ normal = "
                                            "deviation }} or {}",
                                            spread_range.text(), range)));
}

TableCursor::Pair TableCursor::ends_in(std::string_view key, const toml::node& node,
                                       const Spread& allowed) const {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    fail_spread(key,
                pair == nullptr ? fmt::format("a range that is {}", kind_of(node))
                                : fmt::format("a range of {} values", pair->size()),
                allowed.whole);
  }
  Pair ends{};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const toml::node& end = (*pair)[i];
    if (allowed.whole && !end.is_integer()) {
      fail_spread(key, fmt::format("a range with {}", kind_of(end)), true);
    }
    ends[i] = number_in(end, {key, {}, i}, allowed.range);
  }
  check_order(key, ends);
  return ends;
}

scene::Tolerance TableCursor::spread_in(std::string_view key, const toml::table& table,
                                        const Spread& spread) const {
  const toml::node* normal = table.get("normal");
  const toml::node* range = table.get("range");
  if (table.size() != 1 || (normal == nullptr && range == nullptr)) {
    fail_spread(key, "another table", spread.whole);
  }
  scene::Tolerance tolerance{std::string(key), scene::Spread::range, 0.0, 0.0, 0.0, 0.0,
                             spread.whole};
  if (range != nullptr) {
    const Pair ends = ends_in(key, *range, spread);
    tolerance.lowest = ends[0];
    tolerance.highest = ends[1];
    return tolerance;
  }
  if (spread.whole) {
    fail_spread(key, "a standard deviation of integers", true);
  }
  tolerance.spread = scene::Spread::normal;
  tolerance.amount = number_in(*normal, {key}, spread_range);
  tolerance.lowest = spread.range.low;
  tolerance.highest = spread.range.high;
  return tolerance;
}

scene::Tolerance TableCursor::spread(std::string_view key, const Spread& allowed) const {
  const toml::node& value = node(key);
  if (const toml::table* table = value.as_table()) {
    return spread_in(key, *table, allowed);
  }
  if (allowed.whole || !value.is_number()) {
    fail_spread(key, std::string(kind_of(value)), allowed.whole);
  }
  return {std::string(key), scene::Spread::half_width, number_in(value, {key}, spread_range)};
}

}  // namespace sonoglide::scene_file
