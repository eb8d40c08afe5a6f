/// Command shaping that leaves the plant's natural mode unexcited.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// What a notch keeps of the last Delays * M periods, M up to MaxSpacing. Its past begins with the newest entry.
template <class Entry, std::uint32_t MaxSpacing, std::uint32_t Delays>
class DelayLine {
 public:
  using Past = std::array<Entry, Delays>;

  void restart() {
    for (Entry& entry : entries_) {
      entry = {};
    }
    oldest_ = 0;
  }

  /// Entries of M, 2M, ... periods ago.
  Past past(std::uint32_t spacing) const {
    return past(spacing, std::make_index_sequence<Delays>{});
  }

  /// In place of the oldest one.
  void push(const Entry& entry, std::uint32_t spacing) {
    entries_[oldest_] = entry;
    oldest_ = oldest_ + 1 < Delays * spacing ? oldest_ + 1 : 0;
  }

 private:
  template <std::size_t... I>
  Past past(std::uint32_t spacing, std::index_sequence<I...> /*delays*/) const {
    const std::uint32_t depth = Delays * spacing;
    const std::array<std::uint32_t, Delays> ahead{
        oldest_ + static_cast<std::uint32_t>(Delays - 1 - I) * spacing...};
    return {entries_[I + 1 == Delays || ahead[I] < depth ? ahead[I] : ahead[I] - depth]...};
  }

  // No std::array: with it a compiler forgets the parameters at each store to a place that varies.
  Entry entries_[std::size_t{Delays} * MaxSpacing]{};
  std::uint32_t oldest_ = 0;
};

/// The same where M is 1: the entries move, which takes fewer instructions than an index.
template <class Entry, std::uint32_t Delays>
class DelayLine<Entry, 1, Delays> {
 public:
  using Past = std::array<Entry, Delays>;

  void restart() { past_ = {}; }
  const Past& past(std::uint32_t /*spacing*/) const { return past_; }
  void push(const Entry& entry, std::uint32_t /*spacing*/) {
    for (std::size_t i = Delays - 1; i > 0; --i) {
      past_[i] = past_[i - 1];
    }
    past_[0] = entry;
  }

 private:
  Past past_{};
};

/// Rounds the notch's sum to the scalar, as the arithmetic does. That is far too little to be seen in the
/// natural mode.
template <class Scalar, std::size_t TapCount>
class NotchRounding {
 public:
  using Taps = std::array<Scalar, TapCount>;
  struct Entry {
    Scalar amplitude{};
  };
  using Past = std::array<Entry, TapCount - 1>;

  explicit NotchRounding(const Taps&) {}

  /// @param taps  h0, h1, …
  /// @param now   what h0 takes
  /// @param past  what the others take
  static Scalar sum(const Taps& taps, const Entry& now, const Past& past) {
    return sum(taps, now, past, std::make_index_sequence<TapCount - 1>{});
  }

 private:
  template <std::size_t... I>
  static Scalar sum(const Taps& taps, const Entry& now, const Past& past,
                    std::index_sequence<I...> /*delays*/) {
    return numeric::dot(taps, Taps{now.amplitude, past[I].amplitude...});
  }
};

/// In 16 bits the rounding errors e are steps of the drive like any other, and would excite an
/// undamped mode without end. So each error is followed by its own echoes (error feedback, Spang
/// 1962, ../README.md):
///   y = N(z) x + (1 + h1/h0 z^-M + h2/h0 z^-2M + ...) e.
/// Like N this has its zeros on the mode. The drive then moves by a code now and then, about an
/// amplitude that is finer than 16 bits.
///
/// Inputs in [0, 1), and taps whose magnitudes add up to at most 2.9: the sum then fits 32 bits.
template <class Overflow, std::size_t TapCount>
class NotchRounding<numeric::Q15<Overflow>, TapCount> {
 public:
  using Scalar = numeric::Q15<Overflow>;
  using Taps = std::array<Scalar, TapCount>;
  struct Entry {
    Scalar amplitude{};
    std::int16_t error = 0;  ///< in 2^-30
  };
  using Past = std::array<Entry, TapCount - 1>;

  explicit NotchRounding(const Taps& taps) : NotchRounding(taps, Delays{}) {}

  /// As above; the error becomes that of `now`.
  Scalar sum(const Taps& taps, Entry& now, const Past& past) const {
    const std::int32_t exact = exact_sum(taps, now, past, Delays{});
    const std::int32_t rounded = numeric::shift_right_rounded(exact, Scalar::fraction_bits);
    now.error = static_cast<std::int16_t>(rounded * unit - exact);
    return Scalar::from_wide(rounded);
  }

 private:
  using Delays = std::make_index_sequence<TapCount - 1>;

  /// The magnitudes of all h/h0 add up to at most 4 for three taps and 16 for five; an error is at
  /// most 2^14 units.
  static constexpr int echo_bits = TapCount == 3 ? 14 : 13;
  static constexpr std::int32_t unit = std::int32_t{1} << Scalar::fraction_bits;

  template <std::size_t... I>
  NotchRounding(const Taps& taps, std::index_sequence<I...> /*delays*/)
      : echoes_{echo(taps[I + 1], taps[0])...} {}

  template <std::size_t... I>
  std::int32_t exact_sum(const Taps& taps, const Entry& now, const Past& past,
                         std::index_sequence<I...> /*delays*/) const {
    const std::int32_t echoes =
        numeric::shift_right_rounded((... + (echoes_[I] * past[I].error)), echo_bits);
    return (product(taps[0], now.amplitude) + ... + product(taps[I + 1], past[I].amplitude)) +
           echoes;
  }

  static std::int32_t echo(Scalar tap, Scalar first) {
    return tap.raw() * (std::int32_t{1} << echo_bits) / first.raw();
  }
  static std::int32_t product(Scalar a, Scalar b) { return std::int32_t{a.raw()} * b.raw(); }

  std::array<std::int32_t, TapCount - 1> echoes_;  ///< h1/h0, h2/h0, ...
};

/// No command shaping: for plants without a natural mode, and to show the effect of the notch.
template <class ScalarT>
class NoShaping {
 public:
  static constexpr PartName part_name{"limits/notch_shaper", "NoShaping"};
  using Scalar = ScalarT;
  struct Parameters {};

  explicit NoShaping(const Parameters&) {}
  void restart() {}
  Scalar shape(Scalar amplitude) { return amplitude; }
};

/// Taps on the drive amplitude, with zeros on the natural mode or about it:
///   N(z) = h0 + h1 z^-M + h2 z^-2M + ...
/// Three taps have one pair of zeros, on the mode:
///   h = (1, −2 e^(−σMT) cos(ωd M T), e^(−2σMT)) / sum,
/// −σ ± iωd the natural mode, T the carrier period. Five taps are two such filters in a row, each
/// with zeros of its own: for a mode that is not known exactly.
///
/// The amplitude changes at drive phase 0 only. So the free response is linear in the steps of the
/// amplitude, and vanishes (TapCount − 1) M periods after the last one where the mode is on a zero.
/// No partial sum of the taps leaves [0, 1]: the shaped step does not overshoot.
/// Source: Singer 1990 (input shaping), Tuttle 1994 (zeros placed on the mode), see ../README.md.
///
/// @tparam MaxSpacing  largest M; the delay line holds (TapCount − 1)·MaxSpacing amplitudes. With 1
///                     `spacing` is not read.
/// @tparam TapCount    3 or 5
template <class ScalarT, int MaxSpacing, std::size_t TapCount = 3>
class NotchShaper {
 public:
  static constexpr PartName part_name{"limits/notch_shaper", "NotchShaper"};
  using Scalar = ScalarT;
  static constexpr std::size_t tap_count = TapCount;

  struct Parameters {
    std::array<Scalar, TapCount> taps;
    std::uint8_t spacing;  ///< M, 1 … MaxSpacing

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("taps", self.taps);
      visit("spacing", self.spacing);
    }
  };

  explicit NotchShaper(const Parameters& parameters)
      : parameters_(parameters), rounding_(parameters.taps) {}

  void restart() { line_.restart(); }

  /// Shaped amplitude; may leave [0, 1] where the input varies within (TapCount − 1) M periods.
  Scalar shape(Scalar amplitude) {
    typename Rounding::Entry now{amplitude};
    const Scalar shaped = rounding_.sum(parameters_.taps, now, line_.past(parameters_.spacing));
    line_.push(now, parameters_.spacing);
    return shaped;
  }

 private:
  using Rounding = NotchRounding<Scalar, TapCount>;

  Parameters parameters_;
  [[no_unique_address]] Rounding rounding_;
  DelayLine<typename Rounding::Entry, MaxSpacing, TapCount - 1> line_;
};

}  // namespace sonoglide::control
