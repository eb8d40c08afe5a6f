/// Longitudinal vibration of a steel slider at low speed: L. Luo and others, Scientific Reports 14
/// (2024) 25847, 10.1038/s41598-024-73652-w.
#pragma once

#include <string>

#include "host_sim/studies/paper/range.hpp"

namespace sonoglide::paper {

/// Measured reductions: at rest, at 0.1 mm/s, and over all speeds up to the fastest.
inline constexpr double luo_static_reduction = 0.76;
inline constexpr double luo_slow_m_per_s = 1e-4;
inline constexpr double luo_slow_reduction = 0.85;
inline constexpr double luo_fastest_m_per_s = 1e-3;
inline constexpr Range luo_reductions = {0.76, 0.89};

/// 0.35 um at 26 kHz: 57 mm/s.
double luo_peak_m_per_s();

/// The slider of 1.1 kg at 0.1 mm/s: luo_2024.toml. Spring, coefficient and contact are not
/// published: a spring that hardly matters, and a Dahl contact with Kt X = Fc.
std::string luo_text();

/// Reductions under that vibration. Nothing is fitted: a range goes over what is not published.
/// @param velocity_m_per_s  >= 0; at 0 friction has no mean, and everything is reduced
Range luo_coulomb(double velocity_m_per_s);
Range luo_dahl(double velocity_m_per_s);      ///< every contact stiffness
Range luo_lugre(double velocity_m_per_s);     ///< simulated; see luo_lugre_range
Range luo_iwan(double velocity_m_per_s);      ///< simulated, but at rest; see luo_iwan_range
Range luo_stribeck(double velocity_m_per_s);  ///< see luo_stribeck_range

/// Friction at vanishing speed of an elastic stick, a spring Kt that lets go at Fc, under a
/// vibration of amplitude X: carried forward to Fc once in each period, the spring gives way by Kt
/// X in the mean.
/// @param dahl_number  Kt X/Fc
double elastic_stick_reduction(double dahl_number);

inline constexpr const char* luo_dahl_range = "any contact stiffness";
inline constexpr const char* luo_lugre_range =
    "Kt X/Fc 0.1 to 10; static friction Fc to 2 Fc; Stribeck velocity 1 to 100 mm/s";
inline constexpr const char* luo_iwan_range = "one spring; Kt X/Fc 0.1 to 10";
inline constexpr const char* luo_stribeck_range =
    "least friction at 57 to 570 mm/s; up to a half below the static one";

}  // namespace sonoglide::paper
