#include <fmt/format.h>

#include <string>
#include <string_view>

#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/toml_text.hpp"

// A target along the sliding distance, as controller.target_texture gives it.

namespace sonoglide::scene_file {
namespace {

constexpr const char* allowed_form =
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
    fail(key, fmt::format("is {}; allowed: {}", kind_of(value), allowed_form));
  }
  for (const auto& [name, member] : *table) {
    if (name != "period_m" && name != "ratio" && name != "force_N") {
      fail(key, fmt::format("has an unknown {}; allowed: {}", std::string_view(name.str()),
                            allowed_form));
    }
  }
  const toml::node* period = table->get("period_m");
  const toml::node* ratio = table->get("ratio");
  const toml::node* force = table->get("force_N");
  if (period == nullptr) {
    fail(key, fmt::format("has no period_m; allowed: {}", allowed_form));
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

}  // namespace sonoglide::scene_file
