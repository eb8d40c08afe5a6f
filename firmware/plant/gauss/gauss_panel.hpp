/// A weakly coupled contact and its oscillator over one panel of time.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/lane_polynomial.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/gauss/gauss_piece.hpp"
#include "firmware/plant/gauss/panel_motions.hpp"
#include "firmware/plant/gauss/panel_reversals.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Bounds that a panel has to keep, all in x.
template <class Scalar>
struct PanelLimits {
  Scalar velocity_share = Scalar(0);  ///< the most that friction can add to |V|
  Scalar slope_share = Scalar(0);     ///< and to |V'|
  Scalar path_error = Scalar(0);      ///< of the displacement of the linear motion
  Scalar largest_offset = Scalar(0);  ///< of displacement and sliding, over the rate of the motion
  Scalar turn_error = Scalar(0);      ///< of the displacement at a reversal
  Scalar short_exponent = Scalar(0);  ///< kappa |travel| of a piece that fewer nodes resolve
  Scalar unresolved = Scalar(0);      ///< square of the highest Legendre coefficient, times length
  std::array<Scalar, 3> sweep_length{};  ///< square of what 0, 1 and 2 sweeps are enough for
};

/// The motion over a panel: the linear one, on which friction acts by variation of constants.
template <class Model, std::size_t Nodes, std::size_t Degree, std::size_t SlowDegree>
class GaussPanel {
 public:
  using Scalar = typename Model::Scalar;
  using Lanes = numeric::Lanes<Scalar>;
  using Sliding = typename Model::Sliding;
  using Motions = PanelMotions<Model, Degree, SlowDegree>;
  using Piece = GaussPiece<Scalar, Nodes>;
  using Each = typename Motions::Each;
  static constexpr std::size_t width = numeric::lane_count<Scalar>;

  /// Returns false if this method cannot solve the panel; the state is then unchanged.
  [[gnu::always_inline]] bool solve(const Model& model, const Motions& motions,
                                    const PanelLimits<Scalar>& limits,
                                    const IntervalOf<Model>& interval, const State<Scalar>& state) {
    side_ = model.side();
    start(motions, interval, state);
    if (!cut(motions, limits)) {
      return false;
    }
    contact_ = {model.law.contact_stiffness,
                -side_ * model.contact_force(motions.half_length * motions.half_length)};
    return moves_enough(motions, limits) && prepare(motions, limits, state) &&
           follow(motions, limits, state.friction);
  }

  const State<Scalar>& end() const { return end_; }
  std::size_t reversals() const { return reversals_; }
  std::size_t pieces() const { return pieces_; }
  const Piece& piece(std::size_t i) const { return piece_[i]; }
  const PanelContact<Scalar>& contact() const { return contact_; }
  /// The shares of the motions in sigma y.
  const Each& share() const { return share_; }

  /// sigma times the displacement of sliding, its rate and the linear motion with it, at x.
  Scalar slid(Scalar x) const { return slid_over(x + Scalar(1)); }
  Lanes slid(Lanes x) const { return slid_over(x + Scalar(1)); }
  Scalar sliding_rate(Scalar x) const { return sliding_rate_after(x + Scalar(1)); }
  Scalar travel(Scalar x) const { return numeric::value_at(path_, numeric::broadcast(x))[0]; }
  Scalar travel_rate(Scalar x) const {
    return numeric::rate_at<Scalar>(path_, numeric::broadcast(x))[0];
  }

 private:
  /// Reversals, and one more: no two pieces are longer than longest_length. Whole lanes.
  static constexpr std::size_t cut_vectors = PanelReversals<Scalar>::most / width + 1;
  static constexpr std::size_t padded = cut_vectors * width;
  static constexpr Scalar longest_length = numeric::from_real<Scalar>(1.25);
  static constexpr Scalar short_length = numeric::from_real<Scalar>(0.25);
  static constexpr Scalar longest_exponent = Scalar(6);
  static constexpr Scalar slowest = numeric::from_real<Scalar>(1.0 / 512.0);  ///< of h |y'|

  // ---- The sliding ----

  template <class Number>
  Number slid_over(Number time) const {
    return time * (sliding_[0] + Sliding::change(numeric::half(sliding_[1]), time));
  }
  Scalar sliding_slope() const { return Sliding::change(sliding_[1], Scalar(1)); }
  template <class Number>
  Number sliding_rate_after(Number time) const {
    return sliding_[0] + Sliding::change(sliding_[1], time);
  }

  /// The linear motion at cuts.
  struct Turns {
    Lanes travel{};
    Lanes rate{};   ///< V; almost 0 at a reversal
    Lanes slope{};  ///< V'
    Lanes bend{};   ///< V"
    Lanes c{};
    Lanes s{};
  };

  // ---- A piece with all nodes, or with fewer ----

  [[gnu::always_inline]] void prepare(Piece& piece, const Motions& motions, bool is_short) const {
    if constexpr (Piece::fewer_nodes < Nodes) {
      if (is_short) {
        piece.template prepare<Piece::fewer_nodes>(motions, path_, contact_.contact_stiffness);
        return;
      }
    }
    piece.template prepare<Nodes>(motions, path_, contact_.contact_stiffness);
  }

  [[gnu::always_inline]] Reaction<Scalar> follow(Piece& piece, const Motions& motions,
                                                 int sweeps) const {
    if constexpr (Piece::fewer_nodes < Nodes) {
      if (piece.is_short) {
        return piece.template follow<Piece::fewer_nodes>(motions, contact_, sweeps);
      }
    }
    return piece.template follow<Nodes>(motions, contact_, sweeps);
  }

  struct Cuts {
    std::array<Scalar, padded> at{};
    std::array<bool, padded> reverses{};
    std::size_t count = 0;

    void add(Scalar x, bool is_reversal) {
      at[count] = x;
      reverses[count] = is_reversal;
      ++count;
    }
  };

  // ---- The linear motion, and where it reverses ----

  /// The shares of the motions, and the sliding.
  [[gnu::always_inline]] void start(const Motions& motions, const IntervalOf<Model>& interval,
                                    const State<Scalar>& state) {
    const Scalar h = motions.half_length;
    sliding_ = {h * interval.sliding_velocity, h * h * interval.sliding_acceleration};
    Scalar displacement = side_ * state.displacement;
    Scalar velocity = side_ * h * state.velocity;
    if constexpr (Motions::is_driven) {
      drive(interval, h);
      displacement -= share_[2] * motions.begin[2].value + share_[3] * motions.begin[3].value;
      velocity -= share_[2] * motions.begin[2].rate + share_[3] * motions.begin[3].rate;
    }
    if constexpr (Motions::is_ramped) {
      for (std::size_t m = 4; m < Motions::count; ++m) {
        displacement -= share_[m] * motions.begin[m].value;
        velocity -= share_[m] * motions.begin[m].rate;
      }
    }
    const auto& [c, s] = std::array{motions.begin[0], motions.begin[1]};
    share_[0] = motions.unwound(displacement * s.rate - velocity * s.value, c.value, s.value);
    share_[1] = motions.unwound(velocity * c.value - displacement * c.rate, c.value, s.value);
  }

  /// The shares of the motions that the drive adds.
  [[gnu::always_inline]] void drive(const IntervalOf<Model>& interval, Scalar h) {
    if constexpr (Motions::is_ramped) {
      const RampedCosineDrive::Phasor<Scalar> middle(interval.drive_amplitude,
                                                     interval.phase_begin + h);
      share_[2] = side_ * middle.level.in_phase;
      share_[3] = -side_ * middle.level.quadrature;
      share_[4] = side_ * h * middle.slope.in_phase;
      share_[5] = -side_ * h * middle.slope.quadrature;
      share_[6] = side_ * middle.bias;
    } else {
      const typename Model::Drive::template Phasor<Scalar> middle(side_ * interval.drive_amplitude,
                                                                  interval.phase_begin + h);
      share_[2] = middle.in_phase;
      share_[3] = -middle.quadrature;
    }
  }

  /// Cuts the panel at the reversals of the linear motion, and the longest piece once more.
  [[gnu::always_inline]] bool cut(const Motions& motions, const PanelLimits<Scalar>& limits) {
    GridVelocity<Scalar> grid;
    for (std::size_t v = 0; v < grid.vectors; ++v) {
      const Lanes velocity = Motions::sum_of(
          share_, [&](std::size_t m) { return numeric::load(&motions.rate[m][v * width]); });
      grid.velocity[v] =
          velocity + sliding_rate_after(numeric::load(&motions.since_begin[v * width]));
    }
    const auto slope = [&](std::size_t g) {
      return Motions::sum_of(share_, [&](std::size_t m) { return motions.bend[m][g]; }) +
             sliding_slope();
    };
    Scalar third = Scalar(0);
    Scalar fourth = Scalar(0);
    Scalar error = Scalar(0);
    for (std::size_t m = 0; m < Motions::count; ++m) {
      const Scalar size = numeric::abs(share_[m]);
      third += size * motions.third[m];
      fourth += size * motions.fourth[m];
      error += size * motions.error[m];
    }
    fourth_ = fourth;
    PanelReversals<Scalar> reversals;
    if (!(error <= limits.path_error) ||
        !grid.find(PanelGrid::hidden<Scalar> * third + limits.velocity_share,
                   PanelGrid::hidden<Scalar> * fourth + limits.slope_share, slope, reversals)) {
      return false;
    }
    direction_ = reversals.direction;
    reversals_ = reversals.count;
    cuts_ = Cuts();
    Scalar begin = Scalar(-1);
    for (std::size_t i = 0; i <= reversals.count; ++i) {
      const Scalar end = i < reversals.count ? reversals.at[i] : Scalar(1);
      if (end - begin > longest_length) {
        cuts_.add(numeric::half(begin + end), false);
      }
      if (i < reversals.count) {
        cuts_.add(end, true);
      }
      begin = end;
    }
    return true;
  }

  /// Whether the oscillator moves enough. If it hardly moves compared with its displacement or the
  /// sliding, their rounding is an error of its motion. If it stores little compared with the work
  /// of the sliding, the rounding of phi is an error of its energy. If it is slow compared with its
  /// scale, what the limits leave is an error of both.
  [[gnu::always_inline]] bool moves_enough(const Motions& motions,
                                           const PanelLimits<Scalar>& limits) const {
    Scalar offset = numeric::abs(sliding_[0]) + numeric::twice(numeric::abs(sliding_slope()));
    Scalar rate = Scalar(0);
    for (std::size_t m = 0; m < 2; ++m) {
      const Scalar size = numeric::abs(share_[m]);
      offset += size * motions.largest[m];
      rate += size * motions.largest_rate[m];
    }
    if constexpr (Motions::is_driven) {
      rate += numeric::abs(share_[2]) + numeric::abs(share_[3]);
    }
    if constexpr (Motions::is_ramped) {
      offset += numeric::abs(share_[6]) * motions.largest[2];
    }
    return rate >= slowest && offset * numeric::max(rate, numeric::abs(contact_.force)) <=
                                  limits.largest_offset * (rate * rate);
  }

  // ---- The pieces before friction acts ----

  /// Everything that does not depend on friction.
  [[gnu::always_inline]] bool prepare(const Motions& motions, const PanelLimits<Scalar>& limits,
                                      const State<Scalar>& state) {
    path_ = motions.sum(share_);
    const Scalar slid_beyond_rate = numeric::half(sliding_slope());
    path_[0] += sliding_[0] + slid_beyond_rate;
    path_[1] += sliding_rate_after(Scalar(1));
    path_[2] += slid_beyond_rate;
    for (std::size_t v = 0; v * width < cuts_.count; ++v) {
      const Lanes x = numeric::load(&cuts_.at[v * width]);
      prepare_turns(motions, x, turns_[v]);
    }
    linear_end_ = {Motions::sum_of(share_, [&](std::size_t m) { return motions.end[m].value; }),
                   Motions::sum_of(share_, [&](std::size_t m) { return motions.end[m].rate; })};
    pieces_ = cuts_.count + 1;
    Scalar begin = Scalar(-1);
    Scalar travel = side_ * state.displacement;
    Scalar direction = direction_;
    std::array<Scalar, padded> exponent{};
    for (std::size_t i = 0; i < pieces_; ++i) {
      const bool last = i + 1 == pieces_;
      const Scalar end = last ? Scalar(1) : cuts_.at[i];
      const Scalar end_travel =
          last ? linear_end_.value + slid_over(Scalar(2)) : turns_[i / width].travel[i % width];
      Piece& piece = piece_[i];
      piece.begin = begin;
      piece.length = end - begin;
      piece.direction = direction;
      piece.begin_travel = travel;
      piece.travelled = direction * (end_travel - travel);
      exponent[i] = contact_.contact_stiffness * piece.travelled;
      if (!(exponent[i] <= longest_exponent)) {
        return false;
      }
      prepare(piece, motions, piece.length < short_length && exponent[i] < limits.short_exponent);
      begin = end;
      travel = end_travel;
      direction = cuts_.reverses[i] ? -direction : direction;
    }
    for (std::size_t i = 0; i < pieces_; i += width) {
      const Lanes e = numeric::moderate_decay<Scalar>(numeric::load(&exponent[i]));
      for (std::size_t lane = 0; lane < width; ++lane) {
        piece_[i + lane].end_decay = e[lane];
      }
    }
    return true;
  }

  // ---- Friction, piece by piece ----

  [[gnu::always_inline]] bool follow(const Motions& motions, const PanelLimits<Scalar>& limits,
                                     Scalar friction) {
    Reaction<Scalar> reaction;
    Scalar turned = Scalar(0);
    bool is_good = true;
    for (std::size_t i = 0; i < pieces_; ++i) {
      Piece& piece = piece_[i];
      piece.friction = friction;
      piece.turned = turned;
      piece.before = reaction;
      const Scalar square = piece.length * piece.length;
      const int sweeps = static_cast<int>(square > limits.sweep_length[0]) +
                         static_cast<int>(square > limits.sweep_length[1]);
      is_good = is_good && square <= limits.sweep_length[2];
      reaction = follow(piece, motions, sweeps);
      is_good = is_good && (piece.is_short ||
                            piece.highest * piece.highest * piece.length <= limits.unresolved);
      Scalar shift = reaction.c * motions.end[0].value + reaction.s * motions.end[1].value;
      if (i + 1 < pieces_) {
        const Turn turn = this->turn(motions, i, reaction);
        is_good = is_good && turn.error <= limits.turn_error;
        shift = turn.shift;
      }
      const Scalar added = shift - turned;
      piece.travelled = numeric::max(Scalar(0), piece.travelled + piece.direction * added);
      friction = piece.friction_after(contact_.contact_stiffness, piece.end_decay, added);
      turned = shift;
    }
    end_ = {side_ * (linear_end_.value +
                     (reaction.c * motions.end[0].value + reaction.s * motions.end[1].value)),
            side_ *
                (linear_end_.rate +
                 (reaction.c * motions.end[0].rate + reaction.s * motions.end[1].rate)) /
                motions.half_length,
            numeric::clamp(friction, Scalar(-1), Scalar(1))};
    return is_good && is_finite(end_);
  }

  [[gnu::always_inline]] void prepare_turns(const Motions& motions, Lanes x, Turns& turns) const {
    turns.travel = numeric::value_at(path_, x);
    turns.rate = numeric::rate_at<Scalar>(path_, x);
    turns.c = motions.slow_c(x);
    turns.s = motions.slow_s(x);
    // By the oscillator's own equation.
    const Lanes y = turns.travel - slid(x);
    const Lanes y_rate = turns.rate - sliding_rate_after(x + Scalar(1));
    Lanes y_slope = -motions.stiffness * y - motions.damping * y_rate;
    Lanes y_bend = -motions.stiffness * y_rate;
    if constexpr (Motions::is_driven) {
      const Lanes cosine = motions.half_length * motions.cosine(x);
      const Lanes sine = motions.half_length * motions.sine(x);
      const Scalar h = motions.half_length;
      y_slope += h * (share_[2] * cosine + share_[3] * sine);
      y_bend += h * h * (share_[3] * cosine - share_[2] * sine);
      if constexpr (Motions::is_ramped) {
        y_slope += h * (x * (share_[4] * cosine + share_[5] * sine) + h * share_[6]);
        y_bend += h * ((share_[4] * cosine + share_[5] * sine) +
                       h * x * (share_[5] * cosine - share_[4] * sine));
      }
    }
    turns.slope = y_slope + sliding_slope();
    turns.bend = y_bend - motions.damping * y_slope;
  }

  // ---- A reversal that friction has moved ----

  struct Turn {
    Scalar shift;  ///< of sigma y by friction, for the travel to the true reversal
    Scalar error;  ///< of the shift, and of the integral of kappa phi
  };

  /// At a reversal of the linear motion V with friction's share is not quite zero. The true
  /// reversal is earlier by e = V / V', and the travel to it shorter by V e / 2 + V" e^3 / 6. In
  /// between phi is followed as if the sliding had turned, with an error of kappa V' e^3 / 3 at
  /// most.
  [[gnu::always_inline]] Turn turn(const Motions& motions, std::size_t i,
                                   const Reaction<Scalar>& reaction) const {
    const Turns& turns = turns_[i / width];
    const std::size_t lane = i % width;
    const Scalar c = turns.c[lane];
    const Scalar s = turns.s[lane];
    const Scalar velocity = turns.rate[lane] + (reaction.s * (c - motions.damping * s) -
                                                reaction.c * (motions.stiffness * s));
    const Scalar slope = turns.slope[lane];
    const Scalar early = cuts_.reverses[i] ? velocity / slope : Scalar(0);
    const Scalar square = early * early;
    const Scalar cube = numeric::abs(square * early);
    constexpr Scalar sixth = numeric::from_real<Scalar>(1.0 / 6.0);
    const Scalar longer =
        -numeric::half(velocity * early) - sixth * turns.bend[lane] * (square * early);
    return {(reaction.c * c + reaction.s * s) + longer,
            square * square * fourth_ + cube * numeric::abs(slope)};
  }

  Scalar side_ = Scalar(1);
  Scalar fourth_ = Scalar(0);  ///< bound of |V"'|
  PanelContact<Scalar> contact_{};
  Each share_{};
  std::array<Scalar, 2> sliding_{};  ///< h r at the beginning, h^2 dr / d tau
  numeric::LanePolynomial<Scalar, Degree> path_{};
  Scalar direction_ = Scalar(0);  ///< sgn V at the beginning
  std::size_t reversals_ = 0;
  Cuts cuts_;
  std::array<Turns, cut_vectors> turns_{};
  typename Motions::End linear_end_{};
  std::array<Piece, padded> piece_{};
  std::size_t pieces_ = 0;
  State<Scalar> end_;
};

}  // namespace sonoglide::plant
