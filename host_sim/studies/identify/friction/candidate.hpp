/// The friction laws as their mean friction under a given vibration.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/studies/identify/friction/readings.hpp"

namespace sonoglide::identify::friction {

/// Over the friction limit Fc of the law.
struct MeanFriction {
  double driven;
  double undriven;  ///< without vibration, at the same sliding velocity
};

/// A number of a law that mean friction depends on. Fitted as its logarithm.
struct ShapeParameter {
  std::string name;  ///< with its unit
  double least;      ///< where the law hardly depends on it any more, or may have it no smaller
  double most;
  std::string at_least;  ///< what it means that a fit ends there, a sentence
  std::string at_most;
  double offset = 0.0;  ///< of the value that is shown
  /// Shown as well, the value times a factor; empty: none.
  std::string also = "";
  double factor = 1.0;
};

/// Amplitude of a row: X where the frequency is known, in its place v̂.
double length_of(const Reading& row);

/// What ranges of the parameters follow from.
struct Extent {
  double largest_length;   ///< of length_of()
  double fastest_m_per_s;  ///< of Vt + v̂
  bool have_frequency;
};
Extent extent_of(const Readings& readings);

/// A law as a function of its shape parameters; the friction limit is no part of them.
struct Candidate {
  std::string law;        ///< as a scene names it
  std::string title;      ///< as a person does
  std::string direction;  ///< of the vibration, seen from the sliding: along, across, normal
  int elements = 0;       ///< Iwan: springs; else 0
  std::vector<ShapeParameter> shape;
  MeanFriction (*mean)(const Candidate& self, const Reading& row,
                       const std::vector<double>& values) = nullptr;
  /// Residuals up to this, as a friction ratio, are no fault of the law: rounding, the error of its
  /// map, and how far the ends of its ranges are from the simpler laws that it becomes there.
  double accuracy = 1e-9;
};

/// Every law that has a mean friction, in the order of the report.
std::vector<Candidate> candidates(const Extent& extent);

/// The laws of candidates(), as a scene names them.
inline constexpr std::array<std::string_view, 7> fitted_laws = {
    "coulomb", "dahl", "iwan", "stribeck", "lugre", "transverse_coulomb", "normal_coulomb"};

/// What is wrong with a word as one of fitted_laws; empty for one.
std::string check_law(const std::string& law);

}  // namespace sonoglide::identify::friction
