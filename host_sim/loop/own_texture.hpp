/// A texture with the targets that it points to.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/app/texture.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"

namespace sonoglide::loop {

/// Whether a vibration leads the frequency of its drive.
template <class Vibration, class = void>
inline constexpr bool leads_frequency = false;
template <class Vibration>
inline constexpr bool leads_frequency<
    Vibration, std::void_t<decltype(std::declval<const Vibration&>().next_frequency())>> = true;

/// How long the steps of a controller are.
template <class Vibration>
auto steps_of(const configure::ControlDesign& design) {
  if constexpr (leads_frequency<Vibration>) {
    return app::WordedSteps{design.texture->weight, design.resonance()->start_word};
  } else {
    return app::EqualSteps{design.texture->weight};
  }
}

/// The length of its period is in the numbers of the path.
struct AnyPeriod {};

template <class Scalar, class Vibration>
class OwnTexture {
  using Targets =
      app::TextureTargets<Scalar, decltype(steps_of<Vibration>(configure::ControlDesign{})),
                          AnyPeriod>;
  using Schedule = decltype(app::schedule_of(std::declval<const Targets&>()));

 public:
  explicit OwnTexture(const configure::ControlDesign& design)
      : points_(points(design)),
        targets_{steps_of<Vibration>(design),
                 {design.texture->period, design.texture->inverse, design.texture->lead},
                 points_.data(),
                 static_cast<std::uint16_t>(points_.size())},
        schedule_(targets_) {}
  OwnTexture(const OwnTexture&) = delete;
  OwnTexture& operator=(const OwnTexture&) = delete;

  Schedule& schedule() { return schedule_; }
  const Schedule& schedule() const { return schedule_; }

 private:
  static std::vector<Scalar> points(const configure::ControlDesign& design) {
    std::vector<Scalar> points;
    for (const double value : design.texture->values) {
      points.push_back(configure::target_of<Scalar>(design, value));
    }
    return points;
  }

  std::vector<Scalar> points_;
  Targets targets_;
  Schedule schedule_;
};

}  // namespace sonoglide::loop
