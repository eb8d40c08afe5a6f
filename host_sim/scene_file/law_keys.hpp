/// The keys that friction laws have of their own, as the laws describe them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene_file/key.hpp"

namespace sonoglide::scene_file {

/// One key of a law's own.
struct OwnKey {
  std::string_view name;
  double* number;  ///< where the law holds its value; null for a count
  int* count;
  Range range;
  bool required;
  std::string_view meaning;
};
/// A parameter that the others make too small.
struct OwnKeyRefusal {
  std::string_view name;
  std::string finding;
};
struct OwnKeys {
  std::vector<OwnKey> all;
  std::vector<OwnKeyRefusal> refusals;

  /// Null where there is none of this name.
  const OwnKey* find(std::string_view name) const;
};
/// Those of a law, at a contact.
OwnKeys own_keys(scene::FrictionLaw& law, const scene::ContactValues& contact = {});

/// Adds each once; laws may share a key. A range that follows another key is described at the value 0
/// of that.
void add_law_keys(std::vector<Key>& keys);

/// With the largest coefficient to come and with the smallest: a law's own keys suit both.
std::vector<scene::ContactValues> extreme_contacts(const scene::Friction& friction);

}  // namespace sonoglide::scene_file
