#include "host_sim/scene/bound.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace sonoglide::scene {
namespace {

/// @param direction  1: up, -1: down
std::string rounded(double bound, int digits, double direction) {
  std::string text = fmt::format("{:.{}g}", bound, digits);
  if (!std::isfinite(bound) || bound == 0.0) {
    return text;
  }
  const auto beyond = [&] {
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    return direction * (read - bound) < 0.0;
  };
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(bound))) + 1.0 - digits);
  for (double steps = 1.0; beyond(); ++steps) {
    text = fmt::format("{:.{}g}", bound + direction * steps * unit, digits);
  }
  return text;
}

}  // namespace

std::string at_least(double bound, int digits) {
  return rounded(bound, digits, 1.0);
}

std::string at_most(double bound, int digits) {
  return rounded(bound, digits, -1.0);
}

}  // namespace sonoglide::scene
