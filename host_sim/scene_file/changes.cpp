#include "host_sim/scene_file/changes.hpp"

#include <cstddef>
#include <sstream>

#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/override.hpp"

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

/// Null where the document does not give the key.
ordered_json value_of(const Document& document, const OverriddenKey& target) {
  const SceneTable* table = document.find(target.table);
  if (table == nullptr || table->entries.count(target.key) == 0) {
    return nullptr;
  }
  std::ostringstream text;
  text << toml::json_formatter(*table->entries.at(target.key).value);
  return ordered_json::parse(text.str());
}

}  // namespace

ordered_json changes(const Source& source, const std::vector<std::string>& overrides) {
  ordered_json changed = ordered_json::object();
  const Document in_file(source);
  const Document in_run(source, overrides);
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const OverriddenKey target = parse_override(overrides[i], i + 1).target;
    const ordered_json before = value_of(in_file, target);
    const ordered_json now = value_of(in_run, target);
    if (before != now) {
      changed[target.table + '.' + target.key] = {{"file", before}, {"value", now}};
    }
  }
  return changed;
}

}  // namespace sonoglide::scene_file
