/// Friction of a weakly coupled contact along one piece of its path, at Gauss-Legendre nodes.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/gauss_nodes.hpp"
#include "firmware/numeric/lane_group.hpp"
#include "firmware/numeric/lane_polynomial.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// What friction adds to sigma y: c C + s S, C and S the free motions of the panel.
template <class Scalar>
struct Reaction {
  Scalar c = Scalar(0);
  Scalar s = Scalar(0);
};

/// A contact whose friction moves the oscillator little, in x from -1 to 1 over a panel.
template <class Scalar>
struct PanelContact {
  Scalar contact_stiffness;  ///< kappa
  Scalar force;              ///< -sigma beta h^2: what phi adds to sigma y"
};

/// A piece of a panel in which the sliding velocity has one sign s. There
///   phi = s + (phi0 - s) exp(-kappa |u|),
///   u   = (travel of the linear motion) + c C + s S - (their sum at the beginning),
///   c'  = -S f / W,  s' = C f / W,  f = -sigma beta h^2 phi,  W = C S' - C' S = exp(-D x),
/// ' = d / dx. A sweep (a Picard iteration, Hairer 1993, I.8) takes phi at the nodes and gives u
/// there, by the integrals of the polynomials through c' and s'. Each sweep reduces the error by a
/// factor of about kappa beta h^2 length^2 / 4.
template <class Scalar, std::size_t Nodes>
struct GaussPiece {
  /// Enough nodes for a short piece.
  static constexpr std::size_t fewer_nodes =
      Nodes > 4 && (Nodes - 4) % (2 * numeric::lane_count<Scalar>) == 0 ? Nodes - 4 : Nodes;
  using Lanes = numeric::Lanes<Scalar>;
  static constexpr std::size_t width = numeric::lane_count<Scalar>;
  using Values = std::array<Lanes, Nodes / width>;

  Scalar begin = Scalar(0);  ///< x
  Scalar length = Scalar(0);
  Scalar direction = Scalar(0);     ///< s
  Scalar begin_travel = Scalar(0);  ///< of the linear motion, sliding included
  Scalar end_decay = Scalar(0);     ///< exp(-kappa |travel|) over the piece, of the linear motion
  bool is_short = false;            ///< with fewer nodes
  Values place{};                   ///< x at the nodes
  Values travel{};                  ///< of the linear motion there
  Values c{};                       ///< C there
  Values s{};                       ///< S there
  Values decay{};                   ///< exp(-kappa |travel since the beginning|), likewise

  // What the sweeps find.
  Scalar friction = Scalar(0);  ///< phi at the beginning
  Scalar turned = Scalar(0);    ///< c C + s S at the beginning, where V = 0 if it is a turn
  Reaction<Scalar> before;
  Values shift{};                        ///< c C + s S at the nodes
  Values phi{};                          ///< at the nodes
  Scalar friction_integral = Scalar(0);  ///< over x
  Scalar travelled = Scalar(0);          ///< |u| over the piece
  Scalar highest =
      Scalar(0);  ///< of the Legendre coefficients of phi, the last or the last but one

  /// Everything that does not depend on friction, at `Count` nodes.
  template <std::size_t Count, class Motions, class Path>
  [[gnu::always_inline]] void prepare(const Motions& motions, const Path& path,
                                      Scalar contact_stiffness) {
    constexpr auto& gauss = numeric::gauss_nodes<Scalar, Count>;
    const Scalar rate = contact_stiffness * direction;
    is_short = Count < Nodes;
    constexpr std::size_t vectors = Count / width;
    const auto x = begin + length * numeric::load_group<vectors>(gauss.node.data());
    const auto path_there = numeric::value_at(path, x);
    set<Count>(place, x);
    set<Count>(travel, path_there);
    set<Count>(c, motions.slow_c(x));
    set<Count>(s, motions.slow_s(x));
    set<Count>(decay, numeric::moderate_decay<Scalar>(rate * (path_there - begin_travel)));
  }

  /// Finds phi with `sweeps` sweeps and returns the reaction at the end. Set friction, turned and
  /// `before` first.
  template <std::size_t Count, class Motions>
  [[gnu::always_inline]] Reaction<Scalar> follow(const Motions& motions,
                                                 const PanelContact<Scalar>& contact, int sweeps) {
    constexpr auto& gauss = numeric::gauss_nodes<Scalar, Count>;
    constexpr std::size_t vectors = Count / width;
    constexpr std::size_t half = vectors / 2;
    const Scalar gap = friction - direction;
    const Scalar rate = contact.contact_stiffness * direction;
    const Scalar scale = contact.force * length;
    const Lanes held = numeric::broadcast(numeric::half(scale * length * friction));
    std::array<Lanes, vectors> base{};
    std::array<Lanes, vectors> left{};
    for (std::size_t v = 0; v < vectors; ++v) {
      left[v] = gap * decay[v];
      const Lanes t = numeric::load(&gauss.node[v * width]);
      base[v] = before.c * c[v] + before.s * s[v];
      shift[v] = base[v] + held * (t * t);
    }
    const auto find_friction = [&](std::size_t v) {
      const Lanes z = rate * (shift[v] - turned);
      phi[v] = direction + left[v] * small_decay<Lanes>(z);
    };
    for (std::size_t v = 0; v < vectors; ++v) {
      find_friction(v);
    }
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      std::array<Lanes, vectors> to_c{};
      std::array<Lanes, vectors> to_s{};
      for (std::size_t v = 0; v < vectors; ++v) {
        const Lanes f = motions.unwound(scale * phi[v], c[v], s[v]);
        to_s[v] = f * c[v];
        to_c[v] = f * s[v];
      }
      integrate<Count>(to_s);
      integrate<Count>(to_c);
      for (std::size_t v = 0; v < vectors; ++v) {
        shift[v] = base[v] + (to_s[v] * s[v] - to_c[v] * c[v]);
        find_friction(v);
      }
    }
    Lanes whole{};
    Lanes whole_c{};
    Lanes whole_s{};
    Lanes last{};
    Lanes last_but_one{};
    for (std::size_t v = 0; v < half; ++v) {
      const Lanes own = phi[v];
      const Lanes image = phi[half + v];
      const Lanes own_force = motions.unwound(own, c[v], s[v]);
      const Lanes image_force = motions.unwound(image, c[half + v], s[half + v]);
      const Lanes weight = numeric::load(&gauss.weight[v * width]);
      whole += weight * (own + image);
      whole_c += weight * (own_force * s[v] + image_force * s[half + v]);
      whole_s += weight * (own_force * c[v] + image_force * c[half + v]);
      last += numeric::load(&gauss.last_of_differences[v * width]) * (own - image);
      last_but_one += numeric::load(&gauss.last_but_one_of_sums[v * width]) * (own + image);
    }
    friction_integral = length * numeric::sum_of_lanes<Scalar>(whole);
    highest = numeric::max(numeric::abs(numeric::sum_of_lanes<Scalar>(last)),
                           numeric::abs(numeric::sum_of_lanes<Scalar>(last_but_one)));
    return {before.c - scale * numeric::sum_of_lanes<Scalar>(whole_c),
            before.s + scale * numeric::sum_of_lanes<Scalar>(whole_s)};
  }

  /// exp(-z), |z| << 1: relative error z^4 / 24.
  template <class Number>
  [[gnu::always_inline]] static Number small_decay(Number z) {
    constexpr Scalar sixth = numeric::from_real<Scalar>(1.0 / 6.0);
    const Number square = z * z;
    return (Scalar(1) - z) + square * (numeric::from_real<Scalar>(0.5) - z * sixth);
  }

  /// phi from the decay over the travel of the linear motion, and the shift added to it, since the
  /// beginning.
  Scalar friction_after(Scalar contact_stiffness, Scalar linear_decay, Scalar added) const {
    const Scalar z = contact_stiffness * direction * added;
    return direction +
           (friction - direction) * numeric::min(Scalar(1), linear_decay * small_decay(z));
  }

  /// Shows each vector of nodes with its weights in an integral over x.
  template <class Show>
  [[gnu::always_inline]] void for_each(const Show& show) const {
    if constexpr (Nodes > fewer_nodes) {
      if (!is_short) {
        for_each_of<Nodes>(show);
        return;
      }
    }
    for_each_of<fewer_nodes>(show);
  }

  /// The reaction at any x of the piece, by the same polynomials, written in Legendre's:
  /// the integral of P_n from -1 is (P_(n+1) - P_(n-1)) / (2 n + 1).
  template <class Motions>
  Reaction<Scalar> reaction(const Motions& motions, const PanelContact<Scalar>& contact,
                            Scalar x) const {
    const Scalar end = numeric::twice((x - begin) / length) - Scalar(1);
    const std::size_t count = is_short ? fewer_nodes : Nodes;
    Values earlier{};
    Values legendre{};
    legendre.fill(numeric::broadcast(Scalar(1)));
    Scalar end_earlier = Scalar(-1);
    Scalar end_legendre = Scalar(1);
    Reaction<Scalar> sum = before;
    for (std::size_t n = 0; n < count; ++n) {
      const Scalar rise = static_cast<Scalar>(2 * n + 1) * numeric::reciprocal<Scalar>(n + 1);
      const Scalar fall = static_cast<Scalar>(n) * numeric::reciprocal<Scalar>(n + 1);
      Lanes to_c{};
      Lanes to_s{};
      for_each([&](std::size_t v, Lanes weight) {
        const Lanes f = weight * legendre[v] * motions.unwound(phi[v], c[v], s[v]);
        to_c += f * s[v];
        to_s += f * c[v];
        const Lanes argument = numeric::twice((place[v] - begin) / length) - Scalar(1);
        const Lanes next = rise * argument * legendre[v] - fall * earlier[v];
        earlier[v] = legendre[v];
        legendre[v] = next;
      });
      const Scalar end_next = rise * end * end_legendre - fall * end_earlier;
      const Scalar reached = numeric::half(contact.force * (end_next - end_earlier));
      sum.c -= reached * numeric::sum_of_lanes<Scalar>(to_c);
      sum.s += reached * numeric::sum_of_lanes<Scalar>(to_s);
      end_earlier = end_legendre;
      end_legendre = end_next;
    }
    return sum;
  }

 private:
  template <std::size_t Count>
  [[gnu::always_inline]] static void set(Values& values,
                                         const numeric::LaneGroup<Scalar, Count / width>& group) {
    for (std::size_t v = 0; v < Count / width; ++v) {
      values[v] = group.part[v];
    }
  }

  template <std::size_t Count, class Show>
  [[gnu::always_inline]] void for_each_of(const Show& show) const {
    constexpr std::size_t half = Count / width / 2;
    for (std::size_t v = 0; v < 2 * half; ++v) {
      show(v,
           length * numeric::load(&numeric::gauss_nodes<Scalar, Count>.weight[v % half * width]));
    }
  }

  /// Values at the nodes become integrals from the beginning to the nodes, the length being 1.
  template <std::size_t Count>
  [[gnu::always_inline]] static void integrate(std::array<Lanes, Count / width>& values) {
    constexpr auto& gauss = numeric::gauss_nodes<Scalar, Count>;
    constexpr std::size_t half = Count / width / 2;
    std::array<Lanes, half> sums{};
    std::array<Lanes, half> differences{};
    Lanes whole{};
    for (std::size_t v = 0; v < half; ++v) {
      sums[v] = values[v] + values[half + v];
      differences[v] = values[v] - values[half + v];
      whole += numeric::load(&gauss.weight[v * width]) * sums[v];
    }
    const Scalar middle = numeric::half(numeric::sum_of_lanes<Scalar>(whole));
    std::array<Lanes, half> alike{};
    std::array<Lanes, half> mirrored{};
    for (std::size_t j = 0; j < Count / 2; ++j) {
      const Scalar difference = differences[j / width][j % width];
      const Scalar sum = sums[j / width][j % width];
      for (std::size_t v = 0; v < half; ++v) {
        alike[v] += difference * numeric::load(&gauss.of_differences[j][v * width]);
        mirrored[v] += sum * numeric::load(&gauss.of_sums[j][v * width]);
      }
    }
    for (std::size_t v = 0; v < half; ++v) {
      values[v] = middle + (alike[v] + mirrored[v]);
      values[half + v] = middle + (alike[v] - mirrored[v]);
    }
  }
};

}  // namespace sonoglide::plant
