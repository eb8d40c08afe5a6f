/// The numbers of a drive that is fed forward, and where its notch on the natural mode puts the taps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/tolerance.hpp"

namespace sonoglide::configure {

/// From the first tap of a designed notch to its last, in periods of the controller.
inline constexpr int max_notch_span = 64;
/// From tap to tap: of three taps, and of five.
inline constexpr int max_notch_spacing = max_notch_span / 2;
inline constexpr int max_robust_spacing = max_notch_span / 4;
inline constexpr std::size_t max_notch_taps = 5;

/// The free motion of the plant over a period T, −σ ± iωd its natural mode.
struct NaturalMode {
  double decay;     ///< exp(−σT)
  double rotation;  ///< ωd T; 0 where overdamped
};

NaturalMode natural_mode(const NominalPlant& plant, double period_s);

using NotchTaps = std::array<double, max_notch_taps>;

struct NotchDesign {
  NotchTaps taps{};  ///< 0 from tap_count on
  std::size_t tap_count = 0;
  std::uint8_t spacing = 0;  ///< periods of the controller from one tap to the next
  double range = 0.0;   ///< by which the natural frequency may be off, relative; 0: known exactly
  double ripple = 0.0;  ///< the largest within that range, see notch_ripple()

  int span() const { return static_cast<int>(tap_count - 1) * spacing; }
};

/// What keeps the natural mode quiet while a drive that is fed forward changes its amplitude.
enum class Quieting {
  nothing,
  notch,  ///< alone: a ramp of the drive, where there is one, leaves half of a jump's kick or more
  ramp,   ///< the amplitude's way from one period to the next
  ramp_and_notch,
};

struct FeedforwardDesign {
  std::optional<NotchDesign> notch;
  Quieting quieting = Quieting::nothing;
  /// Of the controller, one carrier period, over which the amplitude passes linearly; 0: at once.
  double ramp_periods = 0.0;
  /// How far the natural frequency may be off, relative, of a ramped drive: by the tolerances of
  /// stiffness and mass, or else 0.01.
  double frequency_range = 0.0;
  /// Of a ramped drive: the largest free vibration within that range that a change of the amplitude
  /// leaves behind, over its forced vibration, in displacement; and half the swing of the friction
  /// ratio that follows where the amplitude rises from 0 to that of a target, of the worst one.
  double left = 0.0;
  double ratio_swing = 0.0;
  double shaping_range = 0.0;  ///< by which the natural frequency may be off; 0: known exactly
  bool not_robust = false;     ///< a robust notch was asked for, and the one of three taps is taken
  bool free_mode = false;      ///< the plant has a natural mode that no notch takes care of
  /// With which feedback cannot build up what the notch leaves; 0: the mode has as much.
  double missing_damping_N_s_per_m = 0.0;

  bool ramped() const { return ramp_periods > 0.0; }
  double changing_periods() const { return (notch ? notch->span() : 0) + ramp_periods; }
  static constexpr double building_up_periods() { return 0.0; }
  static constexpr bool tells_mismatch() { return true; }
};

/// Three taps with zeros on the mode, at the smallest spacing for which every tap is within ±1.
/// Then no partial sum of the taps leaves [0, 1] either: the drive changes without overshoot.
/// @return nothing where no spacing serves, or where there is no mode
std::optional<NotchDesign> design_notch(const NaturalMode& mode);

/// A ripple that is small enough to look no further for a better notch.
inline constexpr double robust_ripple = 0.05;

/// Five taps, for a mode whose frequency is off by up to `range`, relative. The two pairs of zeros
/// are at the nodes of the Chebyshev polynomial on that range of cos(ωd M T). Without damping no
/// other pairs leave less of the largest ripple. The spacing M is the smallest with which that is
/// at most `robust_ripple`, and else the one of the least ripple. No partial sum of the taps leaves
/// [0, 1], and their magnitudes add up to at most 2.9 (see control::NotchRounding).
/// @param range  above 0, below 1
/// @return nothing where every spacing leaves half of the ringing or more, or where there is no mode
std::optional<NotchDesign> design_robust_notch(const NaturalMode& mode, double range);

/// Of a robust notch whose scene says nothing of how far the mode may be off: for a stiffness that is
/// off by a fifth.
inline constexpr double default_shaping_range = 0.1;

/// The robust notch of the widest range, up to default_shaping_range, that leaves at most
/// `robust_ripple`.
/// @return nothing where a mode known to scene::least_shaping_range leaves more, or where there is
///         none
std::optional<NotchDesign> design_widest_notch(const NaturalMode& mode);

/// The largest part of the free motion of a step that is left at the end of the notch, where the
/// frequency of the mode is off by up to `range`, relative; seen at 65 frequencies.
double notch_ripple(const NotchDesign& notch, const NaturalMode& mode, double range);

/// The part of the free motion of a step that is left at the end of the notch where the natural
/// frequency is this factor of that of the mode.
double notch_ripple_at(const NotchDesign& notch, const NaturalMode& mode, double factor);

/// The taps in units of 2^-fraction_digits, each of them below 1. Their sum is 1 exactly, and no
/// partial sum leaves [0, 1]. Error: at most one and a half units.
NotchTaps rounded_taps(const NotchDesign& notch, int fraction_digits);

/// How far the natural frequency √(Ks/m) may be off, relative, within the tolerances of stiffness
/// and mass: to the ends of a half width or a range, to three standard deviations of a normal; 0
/// where neither has a tolerance.
double natural_frequency_range(const std::vector<scene::Tolerance>& tolerances);

/// Of a robust notch whose scene does not give one: the same, limited to what the key allows.
/// @return nothing where neither has a tolerance
std::optional<double> tolerated_shaping_range(const std::vector<scene::Tolerance>& tolerances);

}  // namespace sonoglide::configure
