#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "firmware/control/interface/names.hpp"
#include "host_sim/configure/control_design.hpp"

namespace sonoglide::configure {
namespace {

void add_notch_notes(const NotchDesign& notch, int every_periods, std::vector<std::string>& notes) {
  constexpr int longest_span = 16;  // carrier periods, in which a step is over at Table 1
  const int span = notch.span() * every_periods;
  const int spacing = notch.spacing * every_periods;
  if (notch.ripple > robust_ripple) {
    notes.push_back(fmt::format(
        "The robust notch leaves up to {:.2g} % of the ringing of each step where the natural "
        "frequency is off by up to {:.3g} %. A smaller controller.shaping_range leaves less.",
        100.0 * notch.ripple, 100.0 * notch.range));
  }
  if (span <= longest_span) {
    return;
  }
  if (notch.range > 0.0) {
    notes.push_back(
        fmt::format("The robust notch spans {} carrier periods. Targets, speeds and sensors that "
                    "change faster are not followed.",
                    span));
    return;
  }
  notes.push_back(fmt::format(
      "The natural mode is so near a multiple of {} that its notch spans {} "
      "carrier periods: for {} of them after each change the drive is at {:.0f} % of it, then for "
      "{} at {:.0f} %. Targets, speeds and sensors that change faster are not followed.",
      every_periods == 1 ? "the carrier frequency" : "the frequency of the controller's steps",
      span, spacing, 100.0 * notch.taps[0], spacing, 100.0 * (notch.taps[0] + notch.taps[1])));
}

/// How far the stiffness may be off, where that is less than usual and not in another note.
void add_stiffness_note(const SensorlessDesign& design, std::vector<std::string>& notes) {
  constexpr double usual_range = 0.05;
  const double least =
      std::min({design.stiffness_range, design.rotation_range, design.multiple_range});
  if (least >= usual_range || design.multiple_range <= 0.0) {
    return;
  }
  if (least == design.stiffness_range) {
    notes.push_back(fmt::format(
        "The controller searches for the natural mode only where the stiffness is within "
        "{:.2g} % of the nominal one, because the mode is close to the carrier frequency.",
        100.0 * least));
    return;
  }
  notes.push_back(fmt::format(
      "A stiffness that is off by more than {:.2g} % may keep the friction ratio from settling: "
      "the natural mode {}.",
      100.0 * least,
      least == design.rotation_range
          ? "then has a phase error of more than 0.3 rad per carrier period"
          : "may then be within 0.06 carrier frequencies of zero or of a multiple of the carrier"));
}

std::string left_text(const FeedforwardDesign& mode) {
  if (mode.left == 0.0) {
    return "A change of the amplitude leaves no free vibration.";
  }
  const std::string where =
      mode.frequency_range > 0.0
          ? fmt::format(" where the natural frequency is off by up to {:.2g} %",
                        100.0 * mode.frequency_range)
          : std::string();
  if (mode.left >= 2.0) {
    return fmt::format(
        "A change of the amplitude leaves a free vibration of up to {:.2g} times its forced one{}, "
        "and the friction ratio swings with it.",
        mode.left, where);
  }
  return fmt::format(
      "A change of the amplitude leaves a free vibration of up to {:.2g} % of its forced one{}; from "
      "rest to a target the friction ratio then swings by up to ±{:.2g}.",
      100.0 * mode.left, where, mode.ratio_swing);
}

/// What keeps the mode quiet where the amplitude passes linearly, and what is left.
void add_ramp_note(const FeedforwardDesign& mode, int every_periods,
                   std::vector<std::string>& notes) {
  if (!mode.ramped() || mode.quieting == Quieting::nothing) {
    return;
  }
  const std::string notch =
      mode.notch ? fmt::format("a notch of {} taps over {} carrier periods", mode.notch->tap_count,
                               mode.notch->span() * every_periods)
                 : std::string();
  if (mode.quieting == Quieting::notch) {
    notes.push_back(fmt::format(
        "The natural mode is kept quiet by {}. {} Here a linear change of the amplitude leaves more "
        "than half of what a jump does: drive.interpolation = \"step\" is as good.",
        notch, left_text(mode)));
    return;
  }
  notes.push_back(fmt::format("The natural mode is kept quiet by the ramp of the drive{}{}. {}",
                              mode.notch ? " and " : " alone", notch, left_text(mode)));
}

void add_notes(const FeedforwardDesign& mode, const ControlDesign& design,
               std::vector<std::string>& notes) {
  const int every_periods = design.scales.every_periods;
  add_ramp_note(mode, every_periods, notes);
  if (mode.free_mode) {
    notes.push_back(
        fmt::format("The natural mode has no notch: each change of the drive makes it ring. The "
                    "feedback gain is {:.3g} per {}.",
                    design.integral_gain, every_periods == 1 ? "carrier period" : "step"));
  }
  if (mode.free_mode && mode.shaping_range > 0.0) {
    notes.push_back(
        fmt::format("No robust notch suppresses a natural mode whose frequency may be off by "
                    "{:.3g} %. A smaller controller.shaping_range, or another carrier frequency, "
                    "may allow one.",
                    100.0 * mode.shaping_range));
  }
  if (mode.not_robust) {
    notes.push_back(fmt::format(
        "No robust notch leaves {:.2g} % or less of the ringing, however well the natural frequency "
        "is known. The notch for the nominal frequency takes its place.",
        100.0 * robust_ripple));
  }
  if (mode.notch) {
    add_notch_notes(*mode.notch, every_periods, notes);
  }
  if (mode.missing_damping_N_s_per_m > 0.0) {
    constexpr double never_rounded_down = 1.005;  // to three digits
    notes.push_back(fmt::format(
        "The natural mode hardly decays. Feedback may then amplify the ringing that is left by the {}, "
        "over thousands of carrier periods, even if the stiffness is known exactly. A plant.damping_N_s_per_m of {:.3g} or more prevents it.",
        mode.ramped() ? mode.notch ? "ramp and the notch" : "ramp" : "robust notch",
        never_rounded_down * mode.missing_damping_N_s_per_m));
  }
}

void add_notes(const DampedDesign& mode, const ControlDesign& design,
               std::vector<std::string>& notes) {
  if (!mode.quick && !design.bias) {
    notes.push_back(
        "The natural mode is so near 0 or a multiple of the carrier frequency that no change of "
        "the amplitude damps it quickly: the vibration velocity is controlled, and the friction "
        "ratio may swing about its target.");
  }
}

void add_notes(const ResonantDesign& mode, const ControlDesign& design,
               std::vector<std::string>& notes) {
  if (mode.natural == mode.nominal_natural) {
    return;
  }
  const auto frequency_Hz = [&](double deviation) {
    return (1.0 + deviation) / design.scales.carrier_period_s;
  };
  notes.push_back(fmt::format(
      "The nominal natural frequency of {:.6g} Hz is outside the frequency range of {:.6g} to "
      "{:.6g} Hz: the controller begins at the nearest end.",
      frequency_Hz(mode.nominal_natural), frequency_Hz(mode.lowest), frequency_Hz(mode.highest)));
}

void add_notes(const SensorlessDesign& mode, const ControlDesign& design,
               std::vector<std::string>& notes) {
  if (!design.calibrated) {
    notes.push_back(fmt::format(
        "The controller takes the friction force of the scene without calibration: an error in it "
        "is an error of the same size in the friction ratio. A controller.calibration_s of {:.3g} s "
        "measures it with the drive off; the first target must last twice as long. Without that "
        "key it is calibrated if the first target lasts so long.",
        design.usual_calibration_s));
  }
  if (!mode.apart) {
    notes.push_back(
        "The natural mode is beside zero or a multiple of the carrier frequency, within 0.5 % of "
        "that frequency: no reading separates it from the driven vibration. Feedback "
        "is of the friction ratio alone, which stays off its target if the stiffness is not the "
        "nominal one or if the ringing of the last target is too large.");
  } else {
    if (!mode.quick && !design.bias) {
      notes.push_back(
          "The natural mode is so near 0 or a multiple of the carrier frequency that no change of "
          "the amplitude damps it quickly: the friction ratio may swing about its target or stay "
          "off it, above all if the stiffness is not the nominal one. Use another carrier "
          "frequency.");
    }
    add_stiffness_note(mode, notes);
  }
  constexpr double usual_blur = 0.02;
  if (mode.blur > usual_blur) {
    notes.push_back(fmt::format(
        "The force sensor shows little of the natural mode: a lag-compensated reading is uncertain "
        "by {:.3g} % of the vibration velocity. A faster sensor, one with less noise, or a "
        "sensor.vibration shows more.",
        100.0 * mode.blur));
  }
}

void add_calibration_note(const ControlDesign& design, std::vector<std::string>& notes) {
  if (design.calibration_outlasts_target) {
    notes.push_back(
        "The calibration lasts longer than the first target, which is not followed. A shorter "
        "controller.calibration_s, or a later second target, leaves time for it.");
  }
}

void add_lead_note(const ControlDesign& design, std::vector<std::string>& notes) {
  constexpr const char* slow =
      "The contact follows the drive only as it slides through its presliding distance. ";
  if (design.contact_lead > 0.0) {
    notes.push_back(fmt::format(
        "{}Until it has followed, the commanded ratio leads the target by up to {:.3g} times the "
        "error.",
        slow, design.contact_lead));
  }
  if (design.contact_foresight) {
    notes.push_back(fmt::format(
        "{}By a model that takes {:.3g} periods for that distance, the drive overshoots until the "
        "contact has followed.",
        slow, design.contact_foresight->presliding_periods));
  }
}

/// Where the contact as believed does not settle in the time of a target, or rings while it is read.
void add_tracking_note(const ControlDesign& design, std::vector<std::string>& notes) {
  constexpr double audible = 0.05;
  const auto* mode = design.in_mode<FeedforwardDesign>();
  if (design.tracks && mode != nullptr && (mode->free_mode || mode->left > audible)) {
    notes.push_back(fmt::format(
        "While the drive dips to measure the friction force Fc, the natural mode rings, which lowers the "
        "mean force of a carrier period. {}",
        design.tracking_shows_ringing
            ? "The highest of them is then taken for Fc, whose interval reaches down to their mean."
            : "So near a multiple of the frequency of the controller's steps it lowers all of them "
              "alike: the controller takes too small a force for Fc, and no interval includes this error."));
  }
  if (design.tracks && design.tracking_unsettled > 0.0) {
    notes.push_back(fmt::format(
        "The contact slides too slowly through its presliding travel: after the {} carrier periods "
        "that a reading of the tracked friction waits, half of the shortest target's time, up to "
        "{:.2g} % of a change is left.",
        design.tracking_wait_periods * design.scales.every_periods,
        100.0 * design.tracking_unsettled));
  }
}

/// Of targets that no drive reaches.
void add_reach_note(const ControlDesign& design, std::vector<std::string>& notes) {
  if (design.unreachable_ratio) {
    notes.push_back(fmt::format(
        "No vibration brings the friction ratio of this contact to a target of {:.3g}: at the "
        "fastest sliding it falls no lower than {:.3g}.",
        *design.unreachable_ratio, *design.inverse->least_ratio));
  }
}

void add_texture_note(const TextureDesign& texture, std::vector<std::string>& notes) {
  if (texture.vibration_demand > 1.0) {
    notes.push_back(fmt::format(
        "At {:.4g} m/s the texture takes a vibration of up to {:.3g} times what the drive holds, and "
        "faster sliding takes more: there the limit {} cuts it.",
        texture.fastest_m_per_s, texture.vibration_demand, control::name(texture.limit)));
    return;
  }
  if (texture.overload <= 1.0) {
    return;
  }
  notes.push_back(fmt::format(
      "At {:.4g} m/s the texture asks for changes of the vibration that are up to {:.3g} times what the "
      "drive can: there the limit {} cuts them. Sliding below about {:.2g} m/s is followed.",
      texture.fastest_m_per_s, texture.overload, control::name(texture.limit),
      texture.fastest_m_per_s / texture.overload));
}

std::string bias_note(const BiasDesign& bias) {
  std::string note = fmt::format(
      "A bias force of up to {:.4g} N takes the friction from the natural mode, at {:.3g} of the "
      "carrier frequency",
      bias.limit_N, bias.natural);
  return bias.part > 0.0
             ? fmt::format(
                   "{}, and damps it: what acts in one carrier period takes {:.2g} of the "
                   "mean velocity away.",
                   note, bias.part)
             : note + ". Nothing damps it but friction and the plant's own damping.";
}

}  // namespace

std::vector<std::string> design_notes(const ControlDesign& design) {
  std::vector<std::string> notes;
  if (design.scales.every_periods > 1) {
    notes.push_back(fmt::format(
        "The controller steps once in {} carrier periods. It sees the last of them, and changes the "
        "drive once.",
        design.scales.every_periods));
  }
  std::visit([&](const auto& mode) { add_notes(mode, design, notes); }, design.vibration);
  if (design.bias) {
    notes.push_back(bias_note(*design.bias));
  }
  add_calibration_note(design, notes);
  add_lead_note(design, notes);
  add_tracking_note(design, notes);
  add_reach_note(design, notes);
  if (design.texture) {
    add_texture_note(*design.texture, notes);
  }
  return notes;
}

}  // namespace sonoglide::configure
