/// Files of measured friction, good and bad.

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "host_sim/studies/identify/friction/readings.hpp"

namespace sonoglide::identify::friction::readings_test {
namespace {

const std::string heading = "sliding_velocity_m_per_s,vibration_velocity_m_per_s,friction_ratio\n";

/// The message that a text is refused with.
std::string refusal(const std::string& text) {
  const scene_file::Source source{"f.csv", text};
  try {
    read_readings(source);
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& place, const std::string& part) {
  const std::string message = refusal(text);
  EXPECT_EQ(message.rfind("f.csv:" + place + ":", 0), 0U) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NE(message.find("allowed"), std::string::npos) << message;
}

TEST(Readings, AreSortedByVelocityRatio) {
  const scene_file::Source source{
      "f.csv",
      "# from a bench\n" + heading + "0.05,0.1,0.6\n0.01,0.1,0.2\n0.2,0,1\n0.01,0.1,0.21\n"};
  const Readings readings = read_readings(source);
  ASSERT_EQ(readings.rows.size(), 4U);
  EXPECT_EQ(readings.rows[0].friction, 0.2);
  EXPECT_EQ(readings.rows[1].friction, 0.21);
  EXPECT_EQ(readings.rows[2].friction, 0.6);
  EXPECT_EQ(readings.rows[3].velocity_ratio(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(readings.are_forces);
  EXPECT_TRUE(readings.warnings.empty());
}

TEST(Readings, ComeFromRatiosAndAmplitudesToo) {
  const scene_file::Source ratios{
      "f.csv",
      "velocity_ratio,sliding_velocity_m_per_s,friction_force_N\n0.5,0.05,2\n0.25,0.05,1\n"};
  EXPECT_DOUBLE_EQ(read_readings(ratios).rows[1].vibration_m_per_s, 0.1);
  EXPECT_TRUE(read_readings(ratios).are_forces);
  const scene_file::Source amplitudes{
      "f.csv",
      "sliding_velocity_m_per_s,vibration_amplitude_m,frequency_Hz,friction_ratio\n"
      "0.01,0.35e-6,26e3,0.2\n0.02,0.35e-6,26e3,0.3\n"};
  EXPECT_NEAR(read_readings(amplitudes).rows[0].vibration_m_per_s, 0.0571770, 1e-7);
}

/// In the unit of the column that says it, and of a value that is then taken.
TEST(Readings, AVibrationThatIsNoneIsToldWithWhatIsOne) {
  expect_refused(heading + "0.01,1e-16,0.5\n", "2:6", "allowed: 0, or at least 1e-15");
  const std::string ratios = "velocity_ratio,sliding_velocity_m_per_s,friction_ratio\n";
  expect_refused(ratios + "1e9,3e-12,0.5\n", "2:1", "allowed: at most 3000");
  EXPECT_EQ(refusal(ratios + "3000,3e-12,0.5\n").find("is a vibration"), std::string::npos);
  const std::string amplitudes =
      "sliding_velocity_m_per_s,vibration_amplitude_m,frequency_Hz,friction_ratio\n";
  expect_refused(amplitudes + "0.01,1e-22,26e3,0.5\n", "2:6",
                 "allowed: 0, or at least 6.12135e-21");
  EXPECT_EQ(refusal(amplitudes + "0.01,6.12135e-21,26e3,0.5\n").find("is a vibration"),
            std::string::npos);
}

TEST(Readings, OutsideOfZeroToOneAreSaid) {
  const scene_file::Source source{"f.csv", heading + "0.01,0.1,0.1\n0.2,0.1,1.02\n"};
  EXPECT_EQ(read_readings(source).warnings.size(), 1U);
}

TEST(Readings, AreRefusedWithTheirPlace) {
  expect_refused(heading + "0.01,0.1,0.2\n0.02,0.1,76\n", "3:10", "neither percent nor reduction");
  expect_refused(heading + "0.01,0.1,0.2\n0.02,0.1,-0.7\n", "3:10", "out of range");
  expect_refused(heading + "0.01,0.1,0.2\n0.02,0.1,nan\n", "3:10", "no number");
  expect_refused(heading + "0.01,0.1,0.2\n0.02,0.1,inf\n", "3:10", "no number");
  expect_refused(heading + "0.01,0.1,0.2\n0.02,0.1\n", "3:9", "on this line: 2");
  expect_refused(heading + "0.01,0.1,0.2\n0,0.1,0.1\n", "3:1", "at rest");
  expect_refused(heading + "0.01,0.1,0.2\n-0.02,0.1,0.1\n", "3:1", "out of range");
  expect_refused(heading + "20.3,0.1,0.2\n870,0.1,0.1\n", "3:1", "m/s");
  expect_refused(heading + "0.01,-0.1,0.2\n0.02,0.1,0.1\n", "2:6", "out of range");
  expect_refused(heading + "0.01,0.1,0.2\n", "1:1", "one row");
  expect_refused(heading, "1:1", "no row");
  expect_refused(heading + "0.01,0,1\n0.02,0,1\n", "1:1", "no row has a vibration");
  expect_refused(heading + "0.01,0.1,-0.2\n0.02,0.1,-0.3\n", "1:1", "not above 0");
}

TEST(Readings, HeadingsAreRefusedWithWhatIsAllowed) {
  expect_refused("sliding_velocity_m_per_s,friction_ratio\n0.01,0.2\n", "1:1",
                 "vibration_velocity_m_per_s");
  expect_refused("sliding_velocity_m_per_s,vibration_velocity_m_per_s\n0.01,0.2\n", "1:1",
                 "friction_ratio");
  expect_refused("vibration_velocity_m_per_s,friction_ratio\n0.01,0.2\n", "1:1",
                 "sliding_velocity_m_per_s");
  expect_refused("sliding_velocity_m_per_s,vibration_amplitude_m,friction_ratio\n0.01,1e-6,0.2\n",
                 "1:1", "frequency_Hz");
  expect_refused(
      "sliding_velocity_m_per_s,vibration_velocity_m_per_s,friction_ratio,"
      "friction_force_N\n0.01,0.1,0.2,1\n",
      "1:1", "both");
  expect_refused(
      "sliding_velocity_m_per_s,vibration_velocity_m_per_s,friction_ratio,"
      "friction_force_standard_error_N\n0.01,0.1,0.2,1\n",
      "1:1", "does not belong");
  expect_refused("sliding_velocity_m_per_s,sliding_velocity_m_per_s,friction_ratio\n0.01,0.1,0.2\n",
                 "1:26", "twice");
  EXPECT_NE(refusal("sliding_velocity_mm_per_s,vibration_velocity_m_per_s,friction_ratio\n"
                    "10,0.1,0.2\n")
                .find("did you mean sliding_velocity_m_per_s? It is in m/s."),
            std::string::npos);
}

TEST(Readings, WarnOfAVibrationThatNoMetalBears) {
  const auto warnings = [](const std::string& rows) {
    const std::string names =
        "sliding_velocity_m_per_s,vibration_velocity_m_per_s,friction_force_N\n";
    return read_readings({"f.csv", names + rows}).warnings;
  };
  EXPECT_TRUE(warnings("0.01,0.1,0.2\n0.02,10,0.3\n").empty());
  ASSERT_EQ(warnings("10,100,0.2\n20,100,0.3\n").size(), 1U);
  EXPECT_NE(warnings("10,100,0.2\n20,100,0.3\n")[0].find("100 m/s is faster"), std::string::npos);
}

TEST(Readings, MayHaveTheirUnitsInBracketsOrOnALineBelow) {
  const std::string rows = "0.01;0.1;0.2\n0.02;0.1;0.3\n";
  const std::string names = "sliding_velocity_m_per_s;vibration_velocity_m_per_s;friction_ratio\n";
  for (const std::string& text :
       {names + "m/s;m/s;-\n" + rows, names + "(m/s);;\n" + rows,
        "sliding_velocity_m_per_s [m/s];vibration_velocity_m_per_s (m/s);friction_ratio\n" +
            rows}) {
    const scene_file::Source source{"f.csv", text};
    EXPECT_EQ(read_readings(source).rows.at(1).sliding_m_per_s, 0.02) << text;
  }
  expect_refused(
      "sliding_velocity_m_per_s;vibration_velocity_m_per_s;friction_ratio (-) percent\n" + rows,
      "1:53", "unknown column \"friction_ratio (-) percent\"");
  expect_refused(names + "mm/s;m/s;-\n" + rows, "1:1",
                 "\"mm/s\" is no unit of sliding_velocity_m_per_s; allowed: m/s");
  expect_refused(names + "m/s;m/s;%\n" + rows, "1:53", "\"%\" is no unit of friction_ratio");
}

TEST(Readings, OfAFileThatMayBeCutAreWarnedOf) {
  const scene_file::Source source{"f.csv", heading + "0.01,0.1,0.2\n0.02,0.1,0.3"};
  EXPECT_NE(read_readings(source).warnings.at(0).find("has no line end"), std::string::npos);
}

TEST(Readings, AreNotEndless) {
  std::string text = heading;
  for (int i = 0; i < 501; ++i) {
    text += "0.01,0.1,0.2\n";
  }
  expect_refused(text, "1:1", "501 rows");
}

}  // namespace
}  // namespace sonoglide::identify::friction::readings_test
