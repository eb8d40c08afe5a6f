/// Mean of measured and commanded ratio where the request stands still.
#pragma once

#include <cstdint>

#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Once the request has stood for `wait` periods, which is to say that it has changed by less than 1/128
/// from each period to the next and not by as much as a limit allows, the next `average` periods are a
/// reading.
template <class ScalarT>
class SteadyMean {
 public:
  using Scalar = ScalarT;
  struct Parameters {
    std::uint16_t wait_periods;
    std::uint8_t average_periods;         ///< >= 1
    numeric::Accumulator<Scalar> weight;  ///< 1/average_periods

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("wait_periods", self.wait_periods);
      visit("average_periods", self.average_periods);
      visit("weight", self.weight);
    }
  };

  explicit SteadyMean(const Parameters& parameters) : parameters_(parameters) {}

  /// @param request  that stands
  void begin(Scalar request) {
    request_ = request;
    left_ = periods();
    measured_ = {};
    highest_ = {};
    commanded_ = {};
    limited_ = false;
  }

  /// The next reading follows the last one: without a wait.
  void go_on(Scalar request) {
    begin(request);
    left_ = parameters_.average_periods;
  }

  /// begin() or go_on() comes before the first call, and after each complete reading.
  /// @return true: the reading is complete
  bool take(const FrictionReading<Scalar>& now) {
    constexpr Scalar standing = numeric::from_real<Scalar>(1.0 / 128.0);
    const bool held_back = !now.followed && now.requested != request_;
    if (held_back || differs(now.requested, request_, standing)) {
      begin(now.requested);
      moving_periods_ += moving_periods_ < 32 ? 1 : 0;
    }
    request_ = now.requested;
    --left_;
    if (left_ >= parameters_.average_periods) {
      return false;
    }
    measured_ += numeric::accumulate(now.measured) * parameters_.weight;
    highest_ = numeric::max(highest_, now.measured);
    commanded_ += numeric::accumulate(now.commanded) * parameters_.weight;
    if (!now.followed) {
      limited_ = true;
    }
    if (left_ > 0) {
      return false;
    }
    before_ = moving_periods_;
    moving_periods_ = 0;
    return true;
  }

  std::uint32_t periods() const {
    return std::uint32_t{parameters_.wait_periods} + parameters_.average_periods;
  }
  Scalar request() const { return request_; }
  Scalar measured() const { return numeric::rounded<Scalar>(measured_); }
  /// Of the periods that measured() is the mean of, and 0.
  Scalar highest() const { return highest_; }
  Scalar commanded() const { return numeric::rounded<Scalar>(commanded_); }
  /// The drive could not follow the command.
  bool limited() const { return limited_; }

  /// Half of the least by which the request has moved since the last reading, over itself; at most 1/8.
  Scalar moved() const { return numeric::from_code<Scalar>(moving_periods_ << 23); }
  /// Periods in which it moved before the reading that is complete, over 256.
  Scalar moved_before() const { return numeric::from_code<Scalar>(before_ << 23); }

  /// By more than a part of it.
  static bool differs(Scalar request, Scalar from, Scalar part) {
    return numeric::rough_product(part, from) < numeric::abs(request - from);
  }

 private:
  Parameters parameters_;
  Scalar request_{};
  numeric::Accumulator<Scalar> measured_{};
  Scalar highest_{};
  numeric::Accumulator<Scalar> commanded_{};
  std::uint32_t left_ = 0;           ///< periods to the end of the reading, > 0 in each take()
  std::int32_t moving_periods_ = 0;  ///< since the last reading
  std::int32_t before_ = 0;          ///< of the last reading
  bool limited_ = false;
};

}  // namespace sonoglide::control
