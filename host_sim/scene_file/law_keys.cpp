#include "host_sim/scene_file/law_keys.hpp"

#include <algorithm>
#include <utility>

#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::scene_file {
namespace {

/// Adds the keys of one law; a range that follows another key is described at the value 0 of that.
class LawKeys {
 public:
  LawKeys(std::vector<Key>& keys, std::string_view law) : keys_(keys), law_(law) {}

  void required(std::string_view key, double /*parameter*/, const Range& range,
                std::string_view meaning) {
    add({key, Number{range}, Required{}, std::string(meaning)});
  }
  void optional(std::string_view key, double parameter, const Range& range,
                std::string_view meaning) {
    add({key, Number{range}, parameter, std::string(meaning)});
  }
  void optional(std::string_view key, int count, int least, int most, std::string_view meaning) {
    add({key, Integer{least, most}, static_cast<double>(count), std::string(meaning)});
  }
  void refuse(std::string_view /*key*/, double /*parameter*/, std::string_view /*finding*/,
              double /*least*/, std::string_view /*rest*/) {}

 private:
  void add(Key described) {
    const auto known = std::find_if(keys_.begin(), keys_.end(),
                                    [&](const Key& each) { return each.name == described.name; });
    if (known != keys_.end()) {
      known->used += ", " + law_;
      return;
    }
    described.used = "law " + law_;
    keys_.push_back(std::move(described));
  }

  std::vector<Key>& keys_;
  std::string law_;
};

}  // namespace

void add_law_keys(std::vector<Key>& keys) {
  for (scene::FrictionLaw law : scene::every_law) {
    LawKeys own(keys, scene::name_of(law));
    std::visit([&](auto& any) { any.visit_keys(own, scene::Contact{}); }, law);
  }
}

}  // namespace sonoglide::scene_file
