#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/design/natural_mode_words.hpp"

namespace sonoglide::design {
namespace {

/// What there is to choose from, as sentences have it.
struct Choices {
  std::size_t plants;
  std::string drive;  ///< the best that is fed forward
  std::string here;   ///< the scene's carrier
  std::string there;  ///< the best other carrier
  Tally driven;       ///< with the drive here
  Tally elsewhere;    ///< with the drive there
  Tally looped;       ///< with the recommended loop here
  bool has_loop;
};

Choices choices_of(const NaturalModeStudy& mode) {
  const QuietDrive& drive = mode.drives[mode.best_drive];
  const CarrierPoint& other = best_other_carrier(mode);
  return {mode.plants,
          fmt::format("{} ({})", word(drive), means(drive)),
          output::quantity(mode.carriers[mode.own].frequency_Hz, "Hz"),
          output::quantity(other.frequency_Hz, "Hz"),
          drive.plants,
          other.plants,
          mode.recommended_loop.plants,
          mode.recommended_loop.refused.empty()};
}

constexpr const char* no_loop = "This scene cannot have the recommended loop.";

std::string all_with_drive(const Choices& choices, bool loop_is_for_more) {
  return fmt::format(
      "All {} plants settle {} with {} at {}: a scene that has this may keep it.{}", choices.plants,
      promptly(), choices.drive, choices.here,
      loop_is_for_more ? " The recommended loop is for a stiffness that may be farther off." : "");
}

std::string all_with_loop(const Choices& choices) {
  return fmt::format(
      "All {} plants settle {} with the recommended loop at {}, {} of them without it. {}",
      choices.plants, promptly(), choices.here, choices.driven.settled,
      choices.elsewhere.settled == choices.plants
          ? fmt::format("Or keep {} and change the carrier to {}: one of the two is enough.",
                        choices.drive, choices.there)
          : "The carrier may stay as it is.");
}

std::string all_elsewhere(const Choices& choices) {
  return fmt::format(
      "All {} plants settle {} with {} at {}, so the carrier is enough. At {} {} do{}",
      choices.plants, promptly(), choices.drive, choices.there, choices.here,
      choices.driven.settled,
      choices.has_loop ? fmt::format(", with the recommended loop {}.", choices.looped.settled)
                       : fmt::format(". {}", no_loop));
}

std::string begin_with(const Choices& choices, bool loop_is_best) {
  const std::string begin =
      fmt::format("Begin with the {}, by which {} settle, and run design again",
                  loop_is_best ? std::string("recommended loop") : "carrier " + choices.there,
                  loop_is_best ? choices.looped.settled : choices.elsewhere.settled);
  return choices.has_loop
             ? fmt::format(
                   "Neither the recommended loop nor another carrier settles all {} plants {}. {}: "
                   "the loop was tried at {} alone, the carriers with {}.",
                   choices.plants, promptly(), begin, choices.here, choices.drive)
             : fmt::format("No other carrier settles all {} plants {}. {} there. {}",
                           choices.plants, promptly(), begin, no_loop);
}

std::string nothing_gained(const Choices& choices, bool some_gain) {
  return fmt::format(
      "{} settles {} than {} at {}: of {}, {}.{}",
      choices.has_loop ? "Neither the recommended loop nor another carrier" : "No other carrier",
      some_gain ? "two plants more" : "more plants", choices.drive, choices.here, choices.plants,
      tally_text(choices.driven), choices.has_loop ? std::string() : fmt::format(" {}", no_loop));
}

}  // namespace

Advice choice_advice(const NaturalModeStudy& mode) {
  const Choices found = choices_of(mode);
  const auto is_enough = [&](const Tally& tally) { return tally.settled == found.plants; };
  if (is_enough(found.driven)) {
    return {"Choice",
            all_with_drive(found, found.has_loop && mode.recommended_loop.means.sensorless)};
  }
  if (is_enough(found.looped)) {
    return {"Choice", all_with_loop(found)};
  }
  if (is_enough(found.elsewhere)) {
    return {"Choice", all_elsewhere(found)};
  }
  const std::size_t most = std::max(found.looped.settled, found.elsewhere.settled);
  return {"Choice", most >= found.driven.settled + worth_a_change
                        ? begin_with(found, found.looped.settled == most)
                        : nothing_gained(found, most > found.driven.settled)};
}

}  // namespace sonoglide::design
