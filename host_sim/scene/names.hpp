/// The words by which a scene chooses, and what each stands for; read and echoed from these lists.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

namespace detail {

template <std::size_t... Index>
constexpr std::array<Named<FrictionLaw>, law_count> named_laws(
    std::index_sequence<Index...> /*all*/) {
  return {{{LawAt<Index>::name, LawAt<Index>{}}...}};
}

}  // namespace detail

inline constexpr std::array<Named<FrictionLaw>, law_count> friction_laws =
    detail::named_laws(std::make_index_sequence<law_count>{});

inline constexpr std::array<Named<SignConvention>, 2> sign_conventions = {{
    {"dissipative", SignConvention::dissipative},
    {"as_printed", SignConvention::as_printed},
}};

inline constexpr std::array<Named<Start>, 2> starts = {{
    {"given", Start::given},
    {"steady", Start::steady},
}};

inline constexpr std::array<Named<Channel>, 6> channels = {{
    {"displacement_m", Channel::displacement},
    {"velocity_m_per_s", Channel::velocity},
    {"friction_force_N", Channel::friction_force},
    {"drive_force_N", Channel::drive_force},
    {"sliding_velocity_m_per_s", Channel::sliding_velocity},
    {"load_displacement_m", Channel::load_displacement},
}};

inline constexpr std::array<Named<Arithmetic>, 4> arithmetics = {{
    {"float32", Arithmetic::float32},
    {"q31", Arithmetic::q31},
    {"q15", Arithmetic::q15},
    {"float64", Arithmetic::float64},
}};

inline constexpr std::array<Named<Shaping>, 3> shapings = {{
    {"notch", Shaping::notch},
    {"robust", Shaping::robust},
    {"none", Shaping::none},
}};

inline constexpr std::array<Named<FrictionSource>, 3> friction_sources = {{
    {"trusted", FrictionSource::trusted},
    {"calibrated", FrictionSource::calibrated},
    {"tracked", FrictionSource::tracked},
}};

inline constexpr std::array<Named<VibrationControl>, 2> vibration_controls = {{
    {"resonant", VibrationControl::resonant},
    {"damped", VibrationControl::damped},
}};

inline constexpr std::array<Named<VibrationSensor>, 2> vibration_sensors = {{
    {"velocity", VibrationSensor::velocity},
    {"motional_current", VibrationSensor::motional_current},
}};

inline constexpr std::array<Named<Waveform>, 4> waveforms = {{
    {"cosine", Waveform::cosine},
    {"square", Waveform::square},
    {"triangle", Waveform::triangle},
    {"sawtooth", Waveform::sawtooth},
}};

inline constexpr std::array<Named<Interpolation>, 2> interpolations = {{
    {"step", Interpolation::step},
    {"linear", Interpolation::linear},
}};

/// The word for a value; every value of these enumerations has one.
template <class Value, std::size_t Count>
constexpr std::string_view name_of(const std::array<Named<Value>, Count>& names, Value value) {
  for (const Named<Value>& each : names) {
    if (each.value == value) {
      return each.name;
    }
  }
  return {};
}

/// The value that a word stands for; absent where it is none of these.
template <class Value, std::size_t Count>
constexpr std::optional<Value> value_of(const std::array<Named<Value>, Count>& names,
                                        std::string_view word) {
  for (const Named<Value>& each : names) {
    if (each.name == word) {
      return each.value;
    }
  }
  return std::nullopt;
}

template <class Value, std::size_t Count>
std::vector<std::string_view> words_of(const std::array<Named<Value>, Count>& names) {
  std::vector<std::string_view> words;
  words.reserve(Count);
  for (const Named<Value>& each : names) {
    words.push_back(each.name);
  }
  return words;
}

/// The unit that a name ends with, as `m/s` of `sliding_velocity_m_per_s` and of `_m_per_s`; empty of a pure
/// number.
std::string unit_of(std::string_view name);

}  // namespace sonoglide::scene
