#include "host_sim/scene_file/law_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/uses.hpp"

namespace sonoglide::scene_file {
namespace {

/// What scene::laws::None calls with each key of a law.
struct Listing {
  OwnKeys keys;

  void required(std::string_view key, double& parameter, const Range& range,
                std::string_view meaning) {
    keys.all.push_back({key, &parameter, nullptr, range, true, meaning});
  }
  void optional(std::string_view key, double& parameter, const Range& range,
                std::string_view meaning) {
    keys.all.push_back({key, &parameter, nullptr, range, false, meaning});
  }
  void optional(std::string_view key, int& count, int least, int most, std::string_view meaning) {
    const Range range{static_cast<double>(least), static_cast<double>(most)};
    keys.all.push_back({key, nullptr, &count, range, false, meaning});
  }
  void refuse(std::string_view key, double parameter, std::string_view finding, double least,
              std::string_view rest) {
    keys.refusals.push_back({key, fmt::format("{} {}; allowed: at least {} {}", parameter, finding,
                                              scene::at_least(least), rest)});
  }
};

Absent absent(const OwnKey& own) {
  if (own.required) {
    return Required{};
  }
  return own.count != nullptr ? static_cast<double>(*own.count) : *own.number;
}

Key described(const OwnKey& own) {
  const std::string_view name = own.name;
  const Uses with_law =
      uses::law([name](scene::FrictionLaw law) { return own_keys(law).find(name) != nullptr; });
  const Allowed allowed =
      own.count != nullptr ? Allowed(whole(own.range)) : Allowed(Number{own.range});
  return {name, OwnOfLaw{}, allowed, absent(own), std::string(own.meaning), with_law};
}

}  // namespace

const OwnKey* OwnKeys::find(std::string_view name) const {
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const OwnKey& key) { return key.name == name; });
  return found == all.end() ? nullptr : &*found;
}

OwnKeys own_keys(scene::FrictionLaw& law, const scene::ContactValues& contact) {
  Listing listing;
  std::visit([&](auto& any) { any.visit_keys(listing, contact); }, law);
  return std::move(listing.keys);
}

void add_law_keys(std::vector<Key>& keys) {
  for (scene::FrictionLaw law : scene::every_law) {
    for (const OwnKey& own : own_keys(law).all) {
      if (std::none_of(keys.begin(), keys.end(),
                       [&own](const Key& each) { return each.name == own.name; })) {
        keys.push_back(described(own));
      }
    }
  }
}

std::vector<scene::ContactValues> extreme_contacts(const scene::Friction& friction) {
  const scene::ContactValues& held = friction;
  if (friction.coefficient_profile.empty()) {
    return {held};
  }
  scene::ContactValues largest = held;
  scene::ContactValues smallest = held;
  largest.coefficient = scene::largest_value(friction.coefficient_profile);
  smallest.coefficient = scene::smallest_value(friction.coefficient_profile);
  return {largest, smallest};
}

}  // namespace sonoglide::scene_file
