// A unit that the program builds and runs in an emulator by itself, from end to end.
#include <gtest/gtest.h>

#include <string>

#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::connect_emulated_test {
namespace {

class ConnectEmulatedTest : public testing::Test {
 protected:
  ConnectEmulatedTest() { use_image_cache(); }

  /// @param lines  of the standard input
  Outcome talk(const std::string& arguments, const std::string& lines) const {
    folder_.write("lines", lines);
    return folder_.run("connect " + arguments + " < lines");
  }
  void expect_refused(const std::string& arguments, const std::string& error) const {
    const Outcome outcome = talk(arguments, "");
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
  }

  ScratchFolder folder_;
};

TEST_F(ConnectEmulatedTest, TalksToTheUnitOfAScene) {
  const Outcome outcome = talk("'" SONOGLIDE_SCENES
                               "/target_step.toml' --emulated mps2-an386 "
                               "--set 'controller.target_friction_ratio=[[0.0,0.3]]'",
                               "identity\nrestart\ntarget 0.7\nstop\nstatus\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("mps2-an386, firmware "), 0U) << outcome.out;
  EXPECT_NE(
      outcome.out.find("\nthe samples are those of a stand-in for the contact, not of a plant\n"),
      std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find(", target 0.3, drive "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(", target 0.7, drive "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("state off, target 0.7, drive 0 N,"), std::string::npos)
      << outcome.out;
}

TEST_F(ConnectEmulatedTest, AForceIsOrderedAndToldInNewtons) {
  const Outcome outcome =
      talk("'" SONOGLIDE_SCENES
           "/target_step.toml' --emulated mps2-an386 --set controller.target_friction_ratio= "
           "--set 'controller.target_friction_force_N=[[0.0,0.01]]'",
           "identity\nstatus\ntarget 0.012\nstatus\ntarget 0.05\n");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(
      outcome.out.find("\ntarget: friction force, 0 to 0.03924 N; full scale of force 0.03924 "
                       "N, velocity "),
      std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("state off, target 0.01 N, drive 0 N,"), std::string::npos);
  EXPECT_NE(outcome.out.find("state off, target 0.012 N, drive 0 N,"), std::string::npos);
  EXPECT_NE(outcome.out.find("\ntarget: allowed is 0 to 0.03924 N\n"), std::string::npos);
}

TEST_F(ConnectEmulatedTest, WithoutASceneItIsTheExample) {
  const Outcome outcome = talk("--emulated mps2-an386", "status\nnonsense\n");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out.find("state off, target 0.4, drive 0 N,"), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\"nonsense\": unknown; "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find(": commands that were not carried out: 1"), std::string::npos);
}

TEST_F(ConnectEmulatedTest, WhatItCannotRunIsNamed) {
  expect_refused("", "DEVICE or --emulated is required");
  expect_refused("--emulated pico", "\"pico\" is no board of this command; allowed: microbit, ");
  expect_refused("- --emulated mps2-an386", "- is the input that has the commands");
  expect_refused("/dev/null --set run.duration_s=1", "--set requires --emulated");
  expect_refused("'" SONOGLIDE_SCENES "/fingertip.toml' --emulated mps2-an386",
                 ": sensor.vibration: ");
  expect_refused("nothing.toml --emulated mps2-an386", "nothing.toml");
}

}  // namespace
}  // namespace sonoglide::acceptance::connect_emulated_test
