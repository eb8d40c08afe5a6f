/// The lag of a measured friction ratio, of the sensor and of the contact.
#pragma once

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A reading that does not lag.
template <class ScalarT>
class PromptReading {
 public:
  static constexpr PartName part_name{"vibration/reading_lag", "PromptReading"};
  using Scalar = ScalarT;
  struct Parameters {};

  explicit PromptReading(const Parameters&) {}
  static constexpr void restart() {}
  static constexpr Scalar lag_compensated(Scalar half_ratio) { return half_ratio; }
};

/// A reading ρ that follows what it reads by two lags of first order, each of which keeps a part k
/// of the past in a period: ρ + l (ρ − ρ₋₁), l = k/(1 − k), twice. The first reading since
/// restart() is taken for a settled one. Ratios on base 2; each lead adds at most ±1/4.
template <class ScalarT>
class LaggingReading {
 public:
  static constexpr PartName part_name{"vibration/reading_lag", "LaggingReading"};
  using Scalar = ScalarT;

  struct Parameters {
    numeric::Split<Scalar> sensor;   ///< l of the sensor's low-pass
    numeric::Split<Scalar> contact;  ///< l of the contact's memory

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("sensor", self.sensor);
      visit("contact", self.contact);
    }
  };

  explicit LaggingReading(const Parameters& parameters)
      : sensor_(numeric::floating(parameters.sensor)),
        contact_(numeric::floating(parameters.contact)) {}

  void restart() { begun_ = false; }

  Scalar lag_compensated(Scalar half_ratio) {
    if (!begun_) {
      begun_ = true;
      last_ = half_ratio;
      last_of_contact_ = half_ratio;
    }
    const Scalar of_contact = half_ratio + led(half_ratio - last_, sensor_);
    const Scalar compensated = of_contact + led(of_contact - last_of_contact_, contact_);
    last_ = half_ratio;
    last_of_contact_ = of_contact;
    return compensated;
  }

 private:
  static Scalar led(Scalar change, const numeric::Floating<Scalar>& lead) {
    constexpr Scalar most = numeric::from_real<Scalar>(0.25);
    return numeric::clamp(numeric::limited_product(change, lead), -most, most);
  }

  numeric::Floating<Scalar> sensor_;
  numeric::Floating<Scalar> contact_;
  Scalar last_{};
  Scalar last_of_contact_{};
  bool begun_ = false;
};

}  // namespace sonoglide::control
