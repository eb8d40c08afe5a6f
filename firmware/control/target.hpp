/// What a controller holds: a friction ratio, or a friction force.
#pragma once

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A friction ratio ρ = F/Fc. The force is as right as the friction force Fc that is believed.
///
/// All ratios on base 2; `ratio` is the one that the target means, 1/2 (ρ = 1) is no drive.
template <class Scalar>
class RatioTarget {
 public:
  static constexpr PartName part_name{"target", "RatioTarget"};
  static constexpr unsigned base = 2;        ///< of a target
  static constexpr bool tells_ratio = true;  ///< the target itself is one
  struct Parameters {};

  explicit RatioTarget(const Parameters&) {}

  /// Makes the ratio of a target; the controller limits it to [0, 1/2].
  template <class Believed>
  static constexpr void take(const Scalar& /*target*/, const Believed& /*believed*/,
                             const FrictionLevel<Scalar>& /*level*/) {}

  /// Another friction force is believed.
  template <class Believed>
  static constexpr void follow(const Believed& /*believed*/, const FrictionLevel<Scalar>& /*level*/,
                               const Scalar& /*ratio*/) {}

  /// The target as it was taken, of which the ratio was made; forgets it.
  static constexpr const Scalar& give_back(const Scalar& ratio) { return ratio; }

  /// Of a measured ratio, the part by which a broken sensor is told.
  static constexpr const Scalar& judged(const Scalar& measured) { return measured; }

  /// A measured ratio as feedback takes it, beside the one aimed at and the commanded one.
  static constexpr const Scalar& reading(const Scalar& measured, const Scalar& /*ratio*/,
                                         const Scalar& /*commanded*/) {
    return measured;
  }
};

/// A friction force F*. It means the ratio F*/L over the level L, and measured ratios are F/L. So
/// feedback brings F to F* whatever Fc is; Fc picks the drive before feedback has acted, no more.
///
///   L = max(Fc believed, F*), at least FrictionLevel::smallest()
///
/// F* can only be reached where the friction is at least F*. So a ratio above 1, which would say that
/// the friction is believed too small, becomes the last one below 1, which is driven, and feedback
/// lowers it from there. A force above what friction there is asks for the weakest drive of the map.
///
/// A true friction of f L makes the loop's gain f times what it was designed for; commanded over target
/// ratio is then about 1/f. So feedback takes the deviation of a reading from its target by this factor,
/// in [1/2, 2], and is as quick with any friction.
///
/// A friction above the one believed is no sign of a broken sensor here; one that pulls still is.
///
/// Fixed point: products are limited, and nothing overflows.
///
/// The functions are those of a RatioTarget.
template <class Scalar>
class ForceTarget {
 public:
  static constexpr PartName part_name{"target", "ForceTarget"};
  static constexpr unsigned base = 1;
  static constexpr bool tells_ratio = false;
  struct Parameters {
    bool force;  ///< false: the target is a ratio, and all as with a RatioTarget, bit for bit

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("force", self.force);
    }
  };

  explicit ForceTarget(const Parameters& parameters) : force_(parameters.force) {}

  /// @param target    F*, base: the sensor's full scale; 0 or less is no drive. Becomes the ratio
  /// @param believed  gives Fc on the same base
  /// @param level     becomes L
  template <class Believed>
  void take(Scalar& target, const Believed& believed, FrictionLevel<Scalar>& level) {
    if (force_) {
      given_ = numeric::max(target, Scalar{});
      follow(believed, level, target);
    }
  }

  template <class Believed>
  void follow(const Believed& believed, FrictionLevel<Scalar>& level, Scalar& ratio) {
    if (!force_) {
      return;
    }
    // After a calibration that failed, what is believed may be nothing.
    const Scalar least = numeric::max(given_, FrictionLevel<Scalar>::smallest());
    level = FrictionLevel<Scalar>(numeric::max(believed(), least));
    if (given_ == Scalar{}) {
      ratio = whole_ratio<Scalar>;
      return;
    }
    ratio = numeric::min(level.half_ratio(given_), largest_driven());
    inverse_ = numeric::from_real<Scalar>(0x1p-6) / numeric::max(ratio, least_ratio());
  }

  Scalar give_back(const Scalar& ratio) {
    const Scalar given = force_ ? given_ : ratio;
    given_ = {};
    return given;
  }

  Scalar judged(const Scalar& measured) const {
    return force_ ? numeric::min(measured, whole_ratio<Scalar>) : measured;
  }

  Scalar reading(const Scalar& measured, const Scalar& ratio, const Scalar& commanded) const {
    if (!force_) {
      return measured;
    }
    const Scalar half_factor =
        numeric::clamp(numeric::limited_lift(numeric::rough_product(commanded, inverse_), 5),
                       numeric::from_real<Scalar>(0.25), numeric::from_real<Scalar>(0.999));
    return ratio + numeric::limited_lift(numeric::rough_product(half_factor, measured - ratio), 1);
  }

 private:
  /// The last number below 1/2 of a Q15 and of a float.
  static constexpr Scalar largest_driven() {
    return numeric::from_real<Scalar>(sizeof(Scalar) < 4 ? 0.5 - 0x1p-15 : 0.5 - 0x1p-25);
  }
  /// Whose inverse is kept.
  static constexpr Scalar least_ratio() { return numeric::from_real<Scalar>(0x1p-5); }

  bool force_;
  Scalar given_{};
  Scalar inverse_{};  ///< 1/64 over the ratio
};

}  // namespace sonoglide::control
