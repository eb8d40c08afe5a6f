/// Friction along the path of one step, arc by arc between its reversals.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/velocity_path.hpp"

namespace sonoglide::plant {

/// A law that is exact in the displacement, along a path of the sliding velocity that is cut at its
/// reversals. On every arc the sliding goes one way, so |phi| <= 1 for any path.
template <class Law>
class FrictionArcs {
 public:
  using Scalar = typename Law::Scalar;

  /// length: of the step. friction: at its beginning.
  FrictionArcs(const Law& law, const VelocityPath<Scalar>& path, Scalar length, Scalar friction)
      : law_(law), path_(path), length_(length) {
    nodes_[0] = {Scalar(0), Scalar(0), friction};
    if (path.may_reverse()) {
      const Reversals<Scalar> reversals = path.reversals();
      for (std::size_t i = 0; i < reversals.count; ++i) {
        append(reversals.at[i], path.displacement(reversals.at[i]));
      }
    }
    append(Scalar(1), path.displacement());
  }

  Scalar end_friction() const { return nodes_[arcs_].friction; }
  std::size_t reversals() const { return arcs_ - 1; }

  /// phi at the fraction x of the step.
  Scalar friction(Scalar x) const {
    std::size_t i = 0;
    while (i + 1 < arcs_ && x >= nodes_[i + 1].x) {
      ++i;
    }
    return friction(i, x);
  }

  /// Integral of phi V d tau, exact along the path.
  Scalar work() const {
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < arcs_; ++i) {
      sum += arc(i).work(numeric::abs(travel(i)));
    }
    return sum;
  }

  /// Integral of phi (weight + slope t) d tau, t since the beginning of the step.
  ///
  /// Hermite's rule of fourth order, over parts in which 1 - |phi| falls by less than a factor of
  /// e^(1/2). So an arc in which a stiff contact saturates at once needs more parts and loses no
  /// accuracy. Parts too short to matter are not divided: near a reversal the displacement has half
  /// of its digits only, and friction may not follow from it.
  Scalar integral(Scalar weight, Scalar slope) const {
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < arcs_; ++i) {
      sum += integral_of_arc(i, weight, slope);
    }
    return sum;
  }

 private:
  using Arc = typename Law::Arc;

  /// An end of an arc.
  struct Node {
    Scalar x;             ///< fraction of the step
    Scalar displacement;  ///< since the beginning of the step
    Scalar friction;
  };

  /// What the integral needs at one instant.
  struct Sample {
    Scalar time;
    Scalar speed;
    Scalar friction;
    Scalar rate;  ///< d phi / d tau
  };

  void append(Scalar x, Scalar displacement) {
    Node& node = nodes_[++arcs_];
    node.x = x;
    node.displacement = displacement;
    node.friction = arc(arcs_ - 1).friction_after(numeric::abs(travel(arcs_ - 1)));
  }

  Scalar travel(std::size_t i) const { return nodes_[i + 1].displacement - nodes_[i].displacement; }
  Scalar direction(std::size_t i) const {
    const Scalar change = travel(i);
    return static_cast<Scalar>(static_cast<int>(change > Scalar(0)) -
                               static_cast<int>(change < Scalar(0)));
  }
  Arc arc(std::size_t i) const { return Arc(law_, direction(i), nodes_[i].friction); }

  Scalar friction(std::size_t i, Scalar x) const {
    const Scalar travelled = direction(i) * (path_.displacement(x) - nodes_[i].displacement);
    return arc(i).friction_after(numeric::clamp(travelled, Scalar(0), numeric::abs(travel(i))));
  }

  Sample sample(std::size_t i, Scalar x, Scalar velocity, Scalar friction) const {
    const Scalar speed = numeric::abs(velocity);
    return {x * length_, speed, friction, speed * law_.rate(direction(i), friction)};
  }

  Scalar integral_of_arc(std::size_t i, Scalar weight, Scalar slope) const {
    const Node& begin = nodes_[i];
    const Node& end = nodes_[i + 1];
    const Scalar begin_velocity = i == 0 ? path_.begin_velocity() : Scalar(0);
    const Scalar end_velocity = i + 1 == arcs_ ? path_.end_velocity() : Scalar(0);
    const Sample from = sample(i, begin.x, begin_velocity, begin.friction);
    const Sample to = sample(i, end.x, end_velocity, end.friction);
    // Between two reversals in one step the contact slides, though it rests at both.
    const bool gentle = is_gentle(from, to) && is_gentle(numeric::twice(numeric::abs(travel(i))));
    return gentle ? hermite(from, to, weight, slope)
                  : integral_in_parts(i, from, to, weight, slope);
  }

  Scalar integral_in_parts(std::size_t i, Sample from, const Sample& last, Scalar weight,
                           Scalar slope) const {
    const Scalar end = nodes_[i + 1].x;
    Scalar x = nodes_[i].x;
    Scalar width = numeric::half(end - x);
    Scalar sum = Scalar(0);
    while (x < end) {
      const bool to_end = x + width >= end;
      const Scalar next = to_end ? end : x + width;
      const Sample to = to_end ? last : sample(i, next, path_.velocity(next), friction(i, next));
      const bool gentle = is_gentle(from, to);
      if (gentle || is_saturated(direction(i), from.friction) || width <= negligible) {
        sum += gentle ? hermite(from, to, weight, slope) : trapezium(from, to, weight, slope);
        x = next;
        from = to;
        width = numeric::twice(width);
      } else {
        width = numeric::half(width);
      }
    }
    return sum;
  }

  bool is_gentle(const Sample& from, const Sample& to) const {
    return is_gentle((to.time - from.time) * (from.speed + to.speed));
  }
  /// doubled_travel: twice the displacement of a part, or a bound of it.
  bool is_gentle(Scalar doubled_travel) const {
    // Not <=: a travel that is not a number is not divided.
    return !(law_.rate(Scalar(1), Scalar(0)) * doubled_travel > Scalar(1));
  }
  static bool is_saturated(Scalar direction, Scalar friction) {
    return Scalar(1) - direction * friction <= negligible;
  }

  /// A number below this is nothing beside 1, with a margin.
  static constexpr Scalar negligible =
      numeric::power_of_two<Scalar>(-2 * std::numeric_limits<Scalar>::digits / 3);

  static Scalar trapezium(const Sample& from, const Sample& to, Scalar weight, Scalar slope) {
    const Scalar ends =
        from.friction * (weight + slope * from.time) + to.friction * (weight + slope * to.time);
    return numeric::half(to.time - from.time) * ends;
  }

  static Scalar hermite(const Sample& from, const Sample& to, Scalar weight, Scalar slope) {
    const Scalar time = to.time - from.time;
    const Scalar from_weight = weight + slope * from.time;
    const Scalar to_weight = weight + slope * to.time;
    const Scalar ends = from.friction * from_weight + to.friction * to_weight;
    const Scalar turn = (from.rate * from_weight + from.friction * slope) -
                        (to.rate * to_weight + to.friction * slope);
    constexpr Scalar sixth = numeric::from_real<Scalar>(1.0 / 6.0);
    return numeric::half(time) * (ends + sixth * time * turn);
  }

  const Law& law_;
  const VelocityPath<Scalar>& path_;
  Scalar length_;
  std::array<Node, 6> nodes_{};
  std::size_t arcs_ = 0;
};

}  // namespace sonoglide::plant
