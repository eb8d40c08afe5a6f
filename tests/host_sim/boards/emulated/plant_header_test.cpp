#include "host_sim/boards/emulated/controller_header.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/read/experiment.hpp"

namespace sonoglide::emulated::plant_header_test {
namespace {

using Texts = std::vector<std::string>;

/// `KEY: MESSAGE`, or nothing where the header is written.
std::string refusal(const std::string& name, const Texts& overrides,
                    scene::Arithmetic arithmetic = scene::Arithmetic::float32) {
  try {
    plant_header(experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml", overrides),
                 arithmetic);
  } catch (const configure::ConfigurationError& error) {
    return error.key() + ": " + error.what();
  }
  return "";
}

TEST(PlantHeader, NamesWhatIsAllowed) {
  EXPECT_EQ(refusal("target_step", {}), "");
  EXPECT_EQ(refusal("target_step", {}, scene::Arithmetic::float64),
            "plant: float64 is not for the plant of an image; allowed: float32, q31");
  EXPECT_EQ(refusal("table_1_open_loop", {}),
            "controller: missing; required: a table [controller], of which an image is made");
  EXPECT_EQ(refusal("speed_ramp", {}),
            "sliding.profile: changes, but the plant of an image slides at one velocity; allowed: "
            "velocity_m_per_s");
  EXPECT_EQ(refusal("target_step", {"friction.normal_force_profile_N=[[0,0.2],[1e-3,0.3]]"}),
            "friction.normal_force_profile_N: changes, but the plant of an image does not; "
            "allowed: a constant value in place of a profile");
  for (const char* observing : {"wire_bonder", "damped_step"}) {
    EXPECT_EQ(
        refusal(observing, {}),
        "controller.vibration: the plant of an image shows no vibration, and its drive has one "
        "frequency; allowed: a scene without this key");
  }
  const std::string ideal = ": the sensor of a plant in an image is ideal; ";
  EXPECT_EQ(refusal("target_step", {"sensor.adc_bits=12"}),
            "sensor.adc_bits" + ideal + "remove it");
  EXPECT_EQ(refusal("target_step", {"sensor.force_noise_N=1e-4"}),
            "sensor.force_noise_N" + ideal + "allowed: 0");
  EXPECT_EQ(refusal("target_step", {"sensor.force_bandwidth_Hz=5e3"}),
            "sensor.force_bandwidth_Hz" + ideal + "remove it");
  EXPECT_EQ(refusal("target_step", {"sensor.delay_periods=1"}),
            "sensor.delay_periods" + ideal + "allowed: 0");
  EXPECT_EQ(refusal("target_step", {"sensor.force_offset_N=1e-3"}),
            "sensor.force_offset_N" + ideal + "allowed: 0");
  EXPECT_EQ(refusal("target_step", {"sensor.force_gain=-1"}),
            "sensor.force_gain" + ideal + "allowed: 1");
  EXPECT_EQ(refusal("target_step", {"sensor.velocity_offset_m_per_s=1e-3"}),
            "sensor.velocity_offset_m_per_s" + ideal + "allowed: 0");
  EXPECT_EQ(refusal("target_step", {"sensor.velocity_bits=12"}),
            "sensor.velocity_bits" + ideal + "remove it");
  EXPECT_EQ(refusal("target_step", {"sensor.samples_per_period=8"}),
            "sensor.samples_per_period" + ideal + "remove it");
  EXPECT_EQ(refusal("target_step", {"drive.bits=12"}),
            "drive.bits: the plant of an image takes the amplitude as it is; remove it");
  EXPECT_EQ(refusal("target_step", {"sensor.velocity_gain=1.1"}),
            "sensor.velocity_gain" + ideal + "allowed: 1");
  EXPECT_EQ(refusal("target_step", {"run.duration_s=1e5", "run.record=[]"}),
            "run.duration_s: has more carrier periods than an image counts; allowed: at most "
            "4294967295 of them, 71582.7 s");
  EXPECT_EQ(
      refusal("target_step", {"sensor.force_full_scale_N=0.015", "model_error.coefficient=0.5"},
              scene::Arithmetic::q31),
      "sensor.force_full_scale_N: is not above the friction force; allowed: above 0.0196201 N");
}

}  // namespace
}  // namespace sonoglide::emulated::plant_header_test
