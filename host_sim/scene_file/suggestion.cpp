#include "host_sim/scene_file/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sonoglide::scene_file {
namespace {

/// Longer names are not typing errors, and the distance costs the product of both lengths.
constexpr std::size_t longest_name = 64;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool lacks_only_unit(std::string_view name, std::string_view known) {
  return !name.empty() && known.size() > name.size() && known.substr(0, name.size()) == name &&
         known[name.size()] == '_';
}

template <class Named>
std::vector<std::string_view> names_of(const std::vector<Named>& all) {
  std::vector<std::string_view> names;
  names.reserve(all.size());
  for (const Named& each : all) {
    names.push_back(each.name);
  }
  return names;
}

/// The table that owns this key; null if none does.
const KeyTable* find_owner(std::string_view key) {
  for (const KeyTable& table : key_tables()) {
    if (find_key(table, key) != nullptr) {
      return &table;
    }
  }
  return nullptr;
}

/// Whether this is `table.key` of a scene, as the tables name their keys whose keys are those of
/// others.
bool is_dotted_key(std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) {
    return false;
  }
  const KeyTable* table = find_table(name.substr(0, dot));
  return table != nullptr && find_key(*table, name.substr(dot + 1)) != nullptr;
}

/// Dotted keys whose part behind the dot is this one, but for its unit.
std::vector<std::string> dotted_keys_of(std::string_view key,
                                        const std::vector<std::string_view>& names) {
  std::vector<std::string> found;
  for (const std::string_view name : names) {
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) {
      continue;
    }
    const std::string_view end = name.substr(dot + 1);
    if (end == key || lacks_only_unit(key, end)) {
      found.push_back(fmt::format("\"{}\"", name));
    }
  }
  return found;
}

/// The first of the dotted keys of a table.
std::optional<std::string_view> first_of_table(std::string_view table,
                                               const std::vector<std::string_view>& names) {
  const auto found = std::find_if(names.begin(), names.end(), [table](std::string_view name) {
    const std::size_t dot = name.find('.');
    return dot != std::string_view::npos && name.substr(0, dot) == table;
  });
  return found == names.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    last[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        current[j] = std::min(current[j], before_last[j - 2] + 1);
      }
    }
    before_last.swap(last);
    last.swap(current);
  }
  return last[b.size()];
}

std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known) {
  if (name.size() > longest_name) {
    return std::nullopt;
  }
  std::optional<std::string_view> nearest;
  std::size_t least = 0;
  for (const std::string_view candidate : known) {
    const std::size_t distance =
        lacks_only_unit(name, candidate) ? 1 : edit_distance(name, candidate);
    const std::size_t limit = std::max<std::size_t>(2, std::max(name.size(), candidate.size()) / 4);
    // A name shorter than the limit is near to everything.
    if (distance <= limit && distance < name.size() && (!nearest || distance < least)) {
      nearest = candidate;
      least = distance;
    }
  }
  return nearest;
}

std::string unknown_table(std::string_view name) {
  if (const KeyTable* owner = find_owner(name)) {
    return fmt::format("unknown table; did you mean {}.{}?", owner->name, name);
  }
  const std::vector<std::string_view> names = names_of(key_tables());
  if (const auto nearest = nearest_name(name, names)) {
    return fmt::format("unknown table; did you mean {}?", *nearest);
  }
  return fmt::format("unknown table; allowed: {}", fmt::join(names, ", "));
}

std::string unknown_key(const KeyTable& table, std::string_view key) {
  const std::vector<std::string_view> names = names_of(table.keys);
  if (is_dotted_key(key)) {
    return fmt::format("is no number that the true plant may have otherwise; allowed: {}",
                       fmt::join(names, ", "));
  }
  if (const auto dotted = dotted_keys_of(key, names); !dotted.empty()) {
    return fmt::format("unknown key; did you mean {}?", fmt::join(dotted, " or "));
  }
  if (const auto of_table = first_of_table(key, names)) {
    return fmt::format("unknown key; one of another table stands in quotes here, as \"{}\"",
                       *of_table);
  }
  if (const auto nearest = nearest_name(key, names)) {
    return fmt::format("unknown key; did you mean {}?", *nearest);
  }
  if (const KeyTable* owner = find_owner(key)) {
    return fmt::format("unknown key; did you mean {}.{}?", owner->name, key);
  }
  return fmt::format("unknown key; allowed: {}", fmt::join(names, ", "));
}

}  // namespace sonoglide::scene_file
