#include <fmt/format.h>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/checks.hpp"

// What controller and sensor owe to the tables before them.

namespace sonoglide::scene_file {
namespace {

/// The frequency of a resonant drive is told by its deviation from the start.
constexpr double largest_deviation = 0.06;

void check_frequency_range(const TableCursor& cursor, const scene::FrequencyRange& range,
                           double start_Hz) {
  if (!(range.lowest_Hz < start_Hz && start_Hz < range.highest_Hz)) {
    cursor.fail("frequency_range_Hz",
                fmt::format("drive.frequency_Hz, where the drive starts, is {:g} Hz; allowed: a "
                            "range that begins below and ends above it",
                            start_Hz));
  }
  const double lowest_Hz = (1.0 - largest_deviation) * start_Hz;
  const double highest_Hz = (1.0 + largest_deviation) * start_Hz;
  if (range.lowest_Hz < lowest_Hz || range.highest_Hz > highest_Hz) {
    cursor.fail("frequency_range_Hz",
                fmt::format("[{:g}, {:g}] leaves the range that the controller can follow; "
                            "allowed: {} to {} Hz, 6 % about drive.frequency_Hz",
                            range.lowest_Hz, range.highest_Hz, scene::at_least(lowest_Hz),
                            scene::at_most(highest_Hz)));
  }
}

void check_resonance(const TableCursor& cursor, const TableCursor& drive,
                     const scene::Controller& controller, const scene::Scene& so_far) {
  if (!so_far.transducer) {
    cursor.fail("vibration",
                "\"resonant\" needs a table [transducer], whose voltage drives the resonance");
  }
  // A word has 28 bits at the most.
  constexpr double finest = 0x1p-28;
  const double start_Hz = so_far.drive->frequency_Hz;
  const double finest_Hz = start_Hz * finest;
  const double coarsest_Hz = start_Hz / 64.0;
  const double resolution_Hz = so_far.drive->frequency_resolution_Hz;
  if (resolution_Hz > coarsest_Hz || (resolution_Hz > 0.0 && resolution_Hz < finest_Hz)) {
    // The start is a multiple of it, and another one of another resolution.
    drive.fail("frequency_resolution_Hz",
               fmt::format("{:g} Hz is too {} to follow a resonance; allowed: 0, or {} to {} Hz",
                           resolution_Hz, resolution_Hz < finest_Hz ? "fine" : "coarse",
                           scene::at_least((start_Hz + 0.5 * resolution_Hz) * finest, 3),
                           scene::at_most((start_Hz - 0.5 * resolution_Hz) / 64.5)));
  }
  if (controller.frequency_range_Hz) {
    check_frequency_range(cursor, *controller.frequency_range_Hz, so_far.drive->frequency_Hz);
  }
}

/// The observer foresees the vibration of a cosine whose amplitude changes at once.
void check_damping(const TableCursor& drive, const scene::Drive& values) {
  if (values.waveform != scene::Waveform::cosine) {
    drive.fail("waveform", fmt::format("\"{}\" is not for controller.vibration = \"damped\"; "
                                       "allowed: \"cosine\"",
                                       scene::name_of(scene::waveforms, values.waveform)));
  }
  if (values.interpolation != scene::Interpolation::step) {
    drive.fail("interpolation",
               "\"linear\" is not for controller.vibration = \"damped\", whose "
               "observer foresees amplitudes that change at once; allowed: "
               "\"step\", or no controller.vibration");
  }
}

/// What a loop that holds the vibration does not take.
void check_vibration_control(const TableCursor& cursor, const Variant& variant,
                             const scene::Scene& so_far) {
  const scene::Controller& controller = *so_far.controller;
  if (controller.arithmetic == scene::Arithmetic::q15) {
    cursor.fail("arithmetic",
                fmt::format("\"q15\" is too coarse for controller.vibration = \"{}\"; allowed: "
                            "\"float32\", \"q31\", \"float64\"",
                            scene::name_of(scene::vibration_controls, *controller.vibration)));
  }
  const TableCursor drive(variant, "drive");
  if (controller.vibration == scene::VibrationControl::resonant) {
    check_resonance(cursor, drive, controller, so_far);
  } else {
    check_damping(drive, *so_far.drive);
  }
}

/// The vibration must be seen or felt, and without a force sensor nothing tells of the friction.
void check_sensing(const TableCursor& cursor, const scene::Scene& so_far) {
  const scene::Sensor& sensor = so_far.sensor;
  if (!sensor.vibration && so_far.resonant()) {
    cursor.fail(
        "vibration",
        fmt::format("missing: controller.vibration = \"{}\" observes the vibration; "
                    "required: \"velocity\" or \"motional_current\"",
                    scene::name_of(scene::vibration_controls, *so_far.controller->vibration)));
  }
  if (sensor.vibration == scene::VibrationSensor::motional_current && !so_far.transducer) {
    cursor.fail("vibration",
                "\"motional_current\" needs a table [transducer], whose current it "
                "is; allowed: \"velocity\"");
  }
  if (!sensor.force && !sensor.vibration) {
    cursor.fail("force",
                "false, and without sensor.vibration nothing tells of the vibration; required: one "
                "of the two");
  }
}

/// No vibration raises the friction.
void check_target_force(const TableCursor& cursor, const scene::Scene& so_far) {
  const double most_N = so_far.friction.largest_limit_N();
  const scene::Controller& controller = *so_far.controller;
  for (const double force_N : controller.target_values()) {
    if (force_N > most_N) {
      cursor.fail(controller.target_key(),
                  fmt::format("{:g} N is more than the friction, which is {:g} N at most; allowed: "
                              "above 0, at most {} N",
                              force_N, most_N, scene::at_most(most_N)));
    }
  }
  if (controller.friction == scene::FrictionSource::tracked) {
    cursor.fail(
        "friction",
        fmt::format("\"tracked\" is not for {}, where feedback holds the force whatever the "
                    "friction; allowed: \"trusted\", \"calibrated\"",
                    controller.target_key()));
  }
}

/// The distance needs a sliding, and friction that is learnt while driving a target that stands still.
void check_texture(const TableCursor& cursor, const scene::Scene& so_far) {
  if (so_far.controller->friction == scene::FrictionSource::tracked) {
    cursor.fail(
        "friction",
        "\"tracked\" is not for target_texture, under which the loop never settles; allowed: "
        "\"trusted\", \"calibrated\"");
  }
  if (!so_far.load && so_far.sliding.fastest_m_per_s() == 0.0) {
    cursor.fail("target_texture",
                "runs along the sliding distance, and sliding.velocity_m_per_s is 0 all the time; "
                "allowed: a sliding that moves");
  }
}

void check_steps(const TableCursor& cursor, const scene::Controller& controller) {
  const double first_s = controller.targets().front().time_s;
  if (first_s != 0.0) {
    cursor.fail(controller.target_key(),
                fmt::format("begins at {} s; allowed: a first time of 0 s", first_s));
  }
}

}  // namespace

void check_controller(const TableCursor& cursor, const Variant& variant, scene::Scene& scene) {
  if (!(scene.friction.limit_N() > 0.0)) {
    cursor.fail(
        fmt::format("there is no friction to control; allowed: a friction.law other than \"none\", "
                    "with coefficient and normal_force_N above 0{}",
                    scene.friction.has_profile() ? " at 0 s" : ""));
  }
  scene::Controller& controller = *scene.controller;
  if (scene.drive->interpolation == scene::Interpolation::linear && !cursor.has("shaping")) {
    controller.shaping.reset();
  }
  if (!controller.texture) {
    check_steps(cursor, controller);
  }
  if (controller.holds_force()) {
    check_target_force(cursor, scene);
  }
  if (controller.texture) {
    check_texture(cursor, scene);
  }
  if (controller.vibration) {
    check_vibration_control(cursor, variant, scene);
  }
  if (controller.calibration_s && !(*controller.calibration_s < scene.run.duration_s)) {
    cursor.fail("calibration_s",
                fmt::format("{} s is not before the end of the run; allowed: less than {} s",
                            *controller.calibration_s, scene.run.duration_s));
  }
}

void check_sensor(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  if (scene.controller && scene.controller->holds_force() && !scene.sensor.force) {
    cursor.fail("force",
                fmt::format("false, but feedback on the force holds controller.{}; allowed: "
                            "true, or a target_friction_ratio",
                            scene.controller->target_key()));
  }
  if (scene.controller && scene.controller->vibration) {
    check_sensing(cursor, scene);
  }
}

}  // namespace sonoglide::scene_file
