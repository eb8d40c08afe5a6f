/// One panel as observers and accounts see it.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// The motion over a whole interval; integrals are computed when asked for.
template <class Model, class Panel>
class GaussStep {
 public:
  using Scalar = typename Model::Scalar;
  using Motions = typename Panel::Motions;

  GaussStep(const Model& model, const Motions& motions, const Panel& panel,
            const IntervalOf<Model>& interval, const State<Scalar>& start)
      : model_(model), motions_(motions), panel_(panel), interval_(interval), start_(start) {}

  Scalar begin() const { return Scalar(0); }
  Scalar length() const { return interval_.duration; }
  State<Scalar> end() const { return panel_.end(); }

  State<Scalar> at(Scalar offset) const {
    if (!(offset > Scalar(0))) {
      return start_;  // to the last digit
    }
    const Scalar x =
        numeric::clamp(offset / motions_.half_length - Scalar(1), Scalar(-1), Scalar(1));
    const auto& piece = piece_at(x);
    const auto reaction = piece.reaction(motions_, panel_.contact(), x);
    const Scalar c = motions_.slow_c(numeric::broadcast(x))[0];
    const Scalar s = motions_.slow_s(numeric::broadcast(x))[0];
    const Scalar shift = reaction.c * c + reaction.s * s;
    const Scalar shift_rate =
        reaction.s * (c - motions_.damping * s) - reaction.c * (motions_.stiffness * s);
    const Scalar travel = panel_.travel(x);
    const Scalar rate = panel_.travel_rate(x) - panel_.sliding_rate(x) + shift_rate;
    const Scalar side = model_.side();
    return {side * (travel - panel_.slid(x) + shift), side * rate / motions_.half_length,
            friction(piece, travel, shift)};
  }

  Scalar friction_integral() const {
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < panel_.pieces(); ++i) {
      sum += panel_.piece(i).friction_integral;
    }
    return motions_.half_length * sum;
  }

  Scalar friction_work() const {
    using Arc = typename Model::FrictionLaw::Arc;
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < panel_.pieces(); ++i) {
      const auto& piece = panel_.piece(i);
      sum += Arc(model_.law, piece.direction, piece.friction).work(piece.travelled);
    }
    return sum;
  }

  Scalar sliding_work() const {
    const Scalar steady = interval_.sliding_velocity * friction_integral();
    if constexpr (!Model::Sliding::varies) {
      return steady;
    }
    Lanes moment{};
    for (std::size_t i = 0; i < panel_.pieces(); ++i) {
      const auto& piece = panel_.piece(i);
      piece.for_each([&](std::size_t v, Lanes weight) {
        moment += weight * (piece.place[v] + Scalar(1)) * piece.phi[v];
      });
    }
    const Scalar h = motions_.half_length;
    return steady +
           interval_.sliding_acceleration * (h * h) * numeric::sum_of_lanes<Scalar>(moment);
  }

  /// Integrals of the linear motion's squares from a table, those of friction's share at the nodes.
  /// With
  /// y" = drive - d v - k y - beta phi,
  ///   integral of drive v = [drive y] - integral of drive' y,
  ///   integral of v^2     = [y v] - integral of y y".
  MotionIntegrals<Scalar> motion_integrals() const {
    const Products p = products();
    const Scalar h = motions_.half_length;
    const State<Scalar>& first = start_;
    const State<Scalar>& last = panel_.end();
    const Scalar square = h * p.square;
    const Scalar ends =
        last.displacement * last.displacement - first.displacement * first.displacement;
    Scalar inertia = -model_.damping_force(numeric::half(ends)) - model_.stiffness * square -
                     model_.contact_work(h * p.friction);
    MotionIntegrals<Scalar> sum;
    if constexpr (Motions::is_driven) {
      const Scalar side = model_.side();
      const Scalar in_phase = panel_.share()[2];
      const Scalar quadrature = panel_.share()[3];
      const Scalar even = side * in_phase * motions_.harmonic_end[0];
      const Scalar odd = side * quadrature * motions_.harmonic_end[1];
      inertia += h * (in_phase * p.cosine + quadrature * p.sine);
      sum.drive_work = ((even + odd) * last.displacement - (even - odd) * first.displacement) -
                       h * (quadrature * p.cosine - in_phase * p.sine);
    }
    if constexpr (Motions::is_ramped) {
      const auto& share = panel_.share();
      const Scalar side = model_.side();
      const Scalar even = side * (share[5] * motions_.harmonic_end[1] + share[6]);
      const Scalar odd = side * share[4] * motions_.harmonic_end[0];
      const auto [cosine_moment, sine_moment, mean] = ramped_products();
      inertia += h * (share[4] * cosine_moment + share[5] * sine_moment + share[6] * mean);
      sum.drive_work += ((even + odd) * last.displacement - (even - odd) * first.displacement) -
                        (share[4] * p.cosine + share[5] * p.sine +
                         h * (share[5] * cosine_moment - share[4] * sine_moment));
    }
    sum.velocity_square =
        (last.displacement * last.velocity - first.displacement * first.velocity) - inertia;
    sum.displacement_square = square;
    sum.damping_work = model_.damping_force(sum.velocity_square);
    return sum;
  }

 private:
  using Lanes = numeric::Lanes<Scalar>;
  using Piece = typename Panel::Piece;

  /// Integrals over x of sigma y with itself, phi, cos(h x) and sin(h x).
  struct Products {
    Scalar square = Scalar(0);
    Scalar friction = Scalar(0);
    Scalar cosine = Scalar(0);
    Scalar sine = Scalar(0);
  };

  Products products() const {
    Lanes square{};
    Lanes friction{};
    Lanes cosine{};
    Lanes sine{};
    for (std::size_t i = 0; i < panel_.pieces(); ++i) {
      const Piece& piece = panel_.piece(i);
      piece.for_each([&](std::size_t v, Lanes weight) {
        const Lanes x = piece.place[v];
        const Lanes linear = piece.travel[v] - panel_.slid(x);
        const Lanes shift = weight * piece.shift[v];
        square += shift * (numeric::twice(linear) + piece.shift[v]);
        friction += weight * piece.phi[v] * (linear + piece.shift[v]);
        if constexpr (Motions::is_driven) {
          cosine += shift * motions_.cosine(x);
          sine += shift * motions_.sine(x);
        }
      });
    }
    const auto& share = panel_.share();
    Products sum = {numeric::sum_of_lanes<Scalar>(square), numeric::sum_of_lanes<Scalar>(friction),
                    numeric::sum_of_lanes<Scalar>(cosine), numeric::sum_of_lanes<Scalar>(sine)};
    for (std::size_t m = 0; m < Motions::count; ++m) {
      sum.square += share[m] * Motions::sum_of(share, [&](std::size_t n) {
                      return motions_.products().motion[m][n];
                    });
    }
    sum.cosine +=
        Motions::sum_of(share, [&](std::size_t m) { return motions_.products().wave[0][m]; });
    sum.sine +=
        Motions::sum_of(share, [&](std::size_t m) { return motions_.products().wave[1][m]; });
    return sum;
  }

  /// With x cos(h x), x sin(h x) and 1.
  std::array<Scalar, 3> ramped_products() const {
    Lanes cosine{};
    Lanes sine{};
    Lanes mean{};
    for (std::size_t i = 0; i < panel_.pieces(); ++i) {
      const Piece& piece = panel_.piece(i);
      piece.for_each([&](std::size_t v, Lanes weight) {
        const Lanes x = piece.place[v];
        const Lanes shift = weight * piece.shift[v];
        cosine += x * shift * motions_.cosine(x);
        sine += x * shift * motions_.sine(x);
        mean += shift;
      });
    }
    std::array<Scalar, 3> sum = {numeric::sum_of_lanes<Scalar>(cosine),
                                 numeric::sum_of_lanes<Scalar>(sine),
                                 numeric::sum_of_lanes<Scalar>(mean)};
    for (std::size_t n = 0; n < sum.size(); ++n) {
      sum[n] += Motions::sum_of(panel_.share(),
                                [&](std::size_t m) { return motions_.products().wave[2 + n][m]; });
    }
    return sum;
  }

  const Piece& piece_at(Scalar x) const {
    std::size_t i = panel_.pieces() - 1;
    while (i > 0 && x < panel_.piece(i).begin) {
      --i;
    }
    return panel_.piece(i);
  }

  Scalar friction(const Piece& piece, Scalar travel, Scalar shift) const {
    const Scalar stiffness = panel_.contact().contact_stiffness;
    const Scalar exponent =
        stiffness * numeric::max(Scalar(0), piece.direction * (travel - piece.begin_travel));
    const Scalar decay = numeric::moderate_decay<Scalar>(numeric::broadcast(exponent))[0];
    return numeric::clamp(piece.friction_after(stiffness, decay, shift - piece.turned), Scalar(-1),
                          Scalar(1));
  }

  const Model& model_;
  const Motions& motions_;
  const Panel& panel_;
  const IntervalOf<Model>& interval_;
  State<Scalar> start_;
};

}  // namespace sonoglide::plant
