/// How a contact that vibrates normally is loaded.
#pragma once

#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"

namespace sonoglide::loop {

/// Observes the steps of one interval (see plant::NoObserver), each of which ends where the contact
/// opens or closes, and integrates N/N0 = (1 + nu y)_+ by Gauss-Legendre quadrature in each.
///
/// Error: a few roundings for steps up to 3 rad, in which the displacement is smooth.
class ContactLoad {
 public:
  /// @param normal_stiffness  nu, see friction::NormalCoulomb
  explicit ContactLoad(double normal_stiffness) : normal_stiffness_(normal_stiffness) {}

  template <class Step>
  void operator()(const Step& step) {
    static constexpr auto rule = numeric::gauss_legendre<16>();
    const double length = step.length();
    const auto pressure = [&](double offset) {
      return 1.0 + normal_stiffness_ * step.at(offset).displacement;
    };
    if (!(pressure(0.5 * length) > 0.0)) {
      open_ += length;
      return;
    }
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      load_ += length * rule.weight[i] * pressure(length * rule.node[i]);
    }
  }

  double load() const { return load_; }  ///< integral of N/N0 over tau
  double open() const { return open_; }  ///< tau in which the contact is open

 private:
  double normal_stiffness_;
  double load_ = 0.0;
  double open_ = 0.0;
};

}  // namespace sonoglide::loop
