/// Members of a scene by their path, for the list of keys.
#pragma once

#include <cstddef>
#include <optional>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/key.hpp"

namespace sonoglide::scene_file {
namespace detail {

template <class Object>
inline constexpr bool is_optional = false;
template <class Object>
inline constexpr bool is_optional<std::optional<Object>> = true;

/// A table on the way may be one that is not in every scene.
template <auto First, auto... Rest, class Object>
auto& at(Object& object) {
  if constexpr (is_optional<Object>) {
    return at<First, Rest...>(*object);
  } else if constexpr (sizeof...(Rest) == 0) {
    return object.*First;
  } else {
    return at<Rest...>(object.*First);
  }
}

template <class Value>
constexpr bool equal(const Value& a, const Value& b) {
  return a == b;
}
constexpr bool equal(const scene::FrictionLaw& a, const scene::FrictionLaw& b) {
  return a.index() == b.index();
}

}  // namespace detail

/// The value at the end of a path of members: of<&Scene::plant, &Plant::mass_kg>.
template <auto... Path>
auto& of(scene::Scene& scene) {
  return detail::at<Path...>(scene);
}

/// Of the tables of a scene.
template <auto Value>
inline constexpr auto* of_plant = &of<&scene::Scene::plant, Value>;
template <auto Value>
inline constexpr auto* of_friction = &of<&scene::Scene::friction, Value>;
template <auto Value>
inline constexpr auto* of_load = &of<&scene::Scene::load, Value>;
template <auto Value>
inline constexpr auto* of_transducer = &of<&scene::Scene::transducer, Value>;
template <auto Value>
inline constexpr auto* of_drive = &of<&scene::Scene::drive, Value>;
template <auto Value>
inline constexpr auto* of_solver = &of<&scene::Scene::solver, Value>;
template <auto Value>
inline constexpr auto* of_run = &of<&scene::Scene::run, Value>;
template <auto Value>
inline constexpr auto* of_controller = &of<&scene::Scene::controller, Value>;
template <auto Value>
inline constexpr auto* of_sensor = &of<&scene::Scene::sensor, Value>;
template <auto Value>
inline constexpr auto* of_model_error = &of<&scene::Scene::model_error, Value>;

/// The same for one of named values, or none of them.
template <const auto& Names, auto... Path>
constexpr Choice choice() {
  return {[](scene::Scene& scene) -> std::optional<std::size_t> {
            const std::optional chosen(of<Path...>(scene));
            for (std::size_t i = 0; chosen && i < Names.size(); ++i) {
              if (detail::equal(Names[i].value, *chosen)) {
                return i;
              }
            }
            return std::nullopt;
          },
          [](scene::Scene& scene, std::size_t index) { of<Path...>(scene) = Names[index].value; }};
}

}  // namespace sonoglide::scene_file
