/// What a contact remembers, as plain numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "firmware/friction/vibration.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::loop {

/// The force is all that a contact of this law remembers.
template <class Law>
inline constexpr bool remembers_force = !Law::remembers && Law::varies && Law::rate_independent;

/// The force is, and its limit follows the vibration.
template <class Law>
inline constexpr bool remembers_force_on_spring = Law::vibration == friction::Vibration::normal;

namespace detail {

inline std::vector<double> parts(double memory, double largest) {
  return {memory / largest};
}
template <std::size_t Count>
std::vector<double> parts(const std::array<double, Count>& memory,
                          const std::array<double, Count>& largest) {
  std::vector<double> all;
  for (std::size_t i = 0; i < Count && largest[i] > 0.0; ++i) {
    all.push_back(memory[i] / largest[i]);
  }
  return all;
}

inline std::vector<double> limits(double largest) {
  return {largest};
}
template <std::size_t Count>
std::vector<double> limits(const std::array<double, Count>& largest) {
  return {largest.begin(), std::find(largest.begin(), largest.end(), 0.0)};
}

inline void set_parts(double& memory, double largest, const std::vector<double>& parts) {
  memory = largest * parts.front();
}
template <std::size_t Count>
void set_parts(std::array<double, Count>& memory, const std::array<double, Count>& largest,
               const std::vector<double>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    memory[i] = largest[i] * parts[i];
  }
}

}  // namespace detail

/// Parts of the most that each number can be: see PlantPort::memory.
/// @tparam State  of a plant with this law, with a load or without
template <class Law, class State>
std::vector<double> remembered(const Law& law, const State& state) {
  if constexpr (Law::remembers) {
    return detail::parts(state.memory, law.largest_memory());
  } else if constexpr (remembers_force<Law>) {
    return {state.friction};
  } else if constexpr (remembers_force_on_spring<Law>) {
    const double limit = law.limit(state.displacement);
    return {limit > 0.0 ? state.friction / limit : 0.0};
  }
  return {};
}

/// The most that each of them stands for, in units of the friction limit.
template <class Law, class State>
std::vector<double> memory_limits(const Law& law, const State& state) {
  if constexpr (Law::remembers) {
    return detail::limits(law.largest_memory());
  } else if constexpr (remembers_force<Law>) {
    return {1.0};
  } else if constexpr (remembers_force_on_spring<Law>) {
    return {law.limit(state.displacement)};
  }
  return {};
}

template <class Law, class State>
void remember(const Law& law, const std::vector<double>& parts, State& state) {
  if constexpr (Law::remembers) {
    detail::set_parts(state.memory, law.largest_memory(), parts);
  } else if constexpr (remembers_force<Law>) {
    state.friction = parts.front();
  } else if constexpr (remembers_force_on_spring<Law>) {
    state.friction = parts.front() * law.limit(state.displacement);
  }
}

}  // namespace sonoglide::loop
