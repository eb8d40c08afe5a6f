/// A sweep in shards: the bytes of one in a piece, whatever happens on the way.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/acceptance/program/odd_names.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"
#include "tests/acceptance/sweep/scenes/base_scenes.hpp"

namespace sonoglide::acceptance::shards_test {
namespace {

using Entries = std::vector<std::string>;

class ShardsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("open.toml", open_loop_scene);
    folder_.write("closed.toml", closed_loop_scene);
  }

  Outcome run(const std::string& arguments, int exit_code) const {
    Outcome outcome = folder_.run("sweep " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << '\n' << outcome.err;
    return outcome;
  }
  void compute(const std::string& arguments, const std::string& shard) const {
    run(arguments + " --quiet --shard " + shard, 0);
  }
  void expect_same_files(const std::string& a, const std::string& b) const {
    for (const char* file : {"/sweep.csv", "/sweep.svg", "/report.html"}) {
      EXPECT_EQ(without_command_line(folder_.read(a + file)),
                without_command_line(folder_.read(b + file)))
          << file;
    }
    EXPECT_NE(folder_.read(a + "/sweep.csv"), "");
  }

  ScratchFolder folder_;
};

/// Of both solvers: the lanes take the points with friction.
const std::string map =
    "open.toml --vary friction.coefficient=0:0.2:5 "
    "--vary friction.contact_stiffness_N_per_m=1e4:1e6:9:log --set solver.tolerance=1e-8 ";

TEST_F(ShardsTest, MergedTheyAreTheSweepInOnePiece) {
  for (const std::string& sweep :
       {map, std::string("closed.toml --vary sensor.seed=1:5:5 "),
        std::string("open.toml --vary friction.law=dahl,coulomb --vary velocity_ratio=0.1:1:4 ")}) {
    const ScratchFolder out;
    const auto into = [&](const char* name) { return "--out " + (out.path() / name).string(); };
    run(sweep + into("whole") + " --quiet", 0);
    for (const char* shard : {"2/3", "3/3", "1/3"}) {
      compute(sweep + into("shards"), shard);
    }
    run("--quiet --merge " + (out.path() / "shards").string(), 0);
    for (const char* file : {"/sweep.csv", "/sweep.svg", "/report.html"}) {
      EXPECT_EQ(without_command_line(out.read(std::string("shards") + file)),
                without_command_line(out.read(std::string("whole") + file)))
          << sweep << file;
    }
  }
}

TEST_F(ShardsTest, MoreShardsThanPointsLeaveSomeEmpty) {
  const std::string sweep = "open.toml --vary friction.coefficient=0.1:0.2:2 ";
  run(sweep + "--out whole --quiet", 0);
  for (const char* shard : {"1/5", "2/5", "3/5", "4/5", "5/5"}) {
    compute(sweep + "--out o", shard);
  }
  run("--merge o --out merged --quiet", 0);
  expect_same_files("merged", "whole");
}

TEST_F(ShardsTest, WhatIsMissingIsNamedForSbatch) {
  for (const char* shard : {"1/9", "2/9", "4/9", "5/9", "6/9"}) {
    compute(map + "--out o", shard);
  }
  const Entries before = folder_.entries();
  const Outcome outcome = run("--merge o", 3);
  EXPECT_EQ(outcome.out, "--array=3,7-9\n");
  EXPECT_EQ(outcome.err, "o: 4 of 9 shards are missing; run them again: --array=3,7-9\n");
  EXPECT_EQ(folder_.entries(), before);
  EXPECT_EQ(run("--status o", 0).out,
            "5 of 9 shards are there, 0 begun; 25 of 45 points, 55.6 %\nmissing: --array=3,7-9\n");
}

/// The two lines of the document that submit what is missing, with a sbatch that says what it is given.
TEST_F(ShardsTest, OnlyWhatIsMissingIsSubmittedAgain) {
  std::ifstream document(SONOGLIDE_SWEEP_DOCUMENT);
  std::string script =
      "sonoglide() { " SONOGLIDE_PROGRAM " \"$@\"; }\nsbatch() { echo \"sbatch $*\"; }\n";
  for (std::string line; std::getline(document, line);) {
    if (line.find("missing=$(") == 0 || line.find("[ $? -ne 3 ]") == 0) {
      script += line + '\n';
    }
  }
  folder_.write("resubmit", script);
  EXPECT_EQ(folder_.run_program("bash", "resubmit").out, "") << "there is no folder: exit code 1";
  compute(map + "--out shards", "2/3");
  EXPECT_EQ(folder_.run_program("bash", "resubmit").out, "sbatch --array=1,3 shards/sweep.slurm\n");
  compute(map + "--out shards", "1/3");
  compute(map + "--out shards", "3/3");
  EXPECT_EQ(folder_.run_program("bash", "resubmit").out, "");
  EXPECT_NE(folder_.read("shards/sweep.csv"), "");
}

TEST_F(ShardsTest, ADamagedOneIsNamedAndComputedAgain) {
  run(map + "--out whole --quiet", 0);
  compute(map + "--out o", "1/2");
  compute(map + "--out o", "2/2");
  const std::string rows = folder_.read("o/shard_2_of_2.rows");
  folder_.write("o/shard_2_of_2.rows", rows.substr(0, rows.size() / 2));
  EXPECT_NE(run("--merge o", 3).err.find("o/shard_2_of_2.rows is damaged in line "),
            std::string::npos);
  compute(map + "--out o", "2/2");
  EXPECT_EQ(folder_.read("o/shard_2_of_2.rows"), rows);
  run("--merge o --quiet", 0);
  expect_same_files("o", "whole");
}

TEST_F(ShardsTest, OneThatIsThereIsNotComputedAgain) {
  compute(map + "--out o", "1/2");
  EXPECT_EQ(run(map + "--out o --shard 1/2", 0).out, "o/shard_1_of_2.rows: is there\n");
  EXPECT_NE(run(map + "--set friction.normal_force_N=0.2 --out o --shard 1/2", 2)
                .err.find("--out: o/shard_1_of_2.rows: has --set \"solver.tolerance=1e-8\", not "),
            std::string::npos);
}

TEST_F(ShardsTest, OneOfOtherWorkIsRefusedWhenItComes) {
  compute(map + "--out o", "1/2");
  const Entries before = folder_.entries();
  EXPECT_NE(run(map + "--set friction.normal_force_N=0.2 --out o --shard 2/2", 2)
                .err.find("--out: o/shard_1_of_2.rows: has --set \"solver.tolerance=1e-8\", not "
                          "--set \"solver.tolerance=1e-8 friction.normal_force_N=0.2\"; allowed: "
                          "that sweep or another folder"),
            std::string::npos);
  EXPECT_NE(run(map + "--out o --shard 2/3", 2)
                .err.find("--out: o/shard_1_of_2.rows: has number of shards 2, not number of "
                          "shards 3"),
            std::string::npos);
  EXPECT_EQ(folder_.entries(), before);
}

TEST_F(ShardsTest, StatusBeforeTheFirstIsNoError) {
  run("open.toml --vary friction.coefficient=0.1:0.2:2 --out o --slurm 2 --quiet", 0);
  EXPECT_EQ(run("--status o", 0).out, "no shard is begun\n");
  folder_.write("o/shard_1_of_2.rows", "damaged");
  EXPECT_NE(run("--status o", 2).err.find("--status: o holds no shard"), std::string::npos);
}

TEST_F(ShardsTest, AMixtureIsRefusedByName) {
  compute(map + "--out o", "1/2");
  compute(map + "--set friction.normal_force_N=0.2 --out other", "2/2");
  std::filesystem::rename(folder_.path() / "other/shard_2_of_2.rows",
                          folder_.path() / "o/shard_2_of_2.rows");
  const Outcome outcome = run("--merge o", 2);
  EXPECT_NE(outcome.err.find("--merge: o/shard_1_of_2.rows has --set \"solver.tolerance=1e-8\" "
                             "and o/shard_2_of_2.rows has --set \"solver.tolerance=1e-8 "
                             "friction.normal_force_N=0.2\""),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(folder_.read("o/sweep.csv"), "");
}

TEST_F(ShardsTest, AShardChecksItsOwnPointsBeforeItWrites) {
  const std::string sweep = "open.toml --vary friction.coefficient=99:101:4 --out o --shard ";
  run(sweep + "1/2 --quiet", 0);
  const Entries before = folder_.entries();
  EXPECT_EQ(run(sweep + "2/2", 2).err,
            "--vary:1:1: friction.coefficient: 100.33333333333333 is out of range; allowed: 0 to "
            "100 (at friction.coefficient=100.33333333333333)\n");
  EXPECT_EQ(folder_.entries(), before);
}

TEST_F(ShardsTest, BadOptionsAreErrorsOfUsage) {
  for (const std::string arguments :
       {"open.toml --vary velocity_ratio=0.1:1:3 --shard 4/3",
        "open.toml --vary velocity_ratio=0.1:1:3 --shard 1", "--merge o open.toml",
        "--merge o --vary velocity_ratio=0.1:1:3", "--merge ''", "--status nowhere --merge o",
        "open.toml --vary velocity_ratio=0.1:1:3 --slurm 0",
        "open.toml --vary velocity_ratio=0.1:1:3 --slurm 4", "--merge ."}) {
    EXPECT_EQ(folder_.run("sweep " + arguments).exit_code, 2) << arguments;
  }
  EXPECT_EQ(folder_.run("sweep --merge nowhere").exit_code, 1);
  EXPECT_EQ(folder_.entries(), (Entries{"closed.toml", "open.toml"}));
}

TEST_F(ShardsTest, AFileOfSomebodyElseStays) {
  std::filesystem::create_directory(folder_.path() / "o");
  folder_.write("o/shard_1_of_2.rows", "mine");
  EXPECT_EQ(folder_.run("sweep " + map + "--out o --shard 1/2").exit_code, 1);
  EXPECT_EQ(folder_.read("o/shard_1_of_2.rows"), "mine");
}

TEST_F(ShardsTest, AnyFolderAndSceneNameWillDo) {
  for (const std::string& name : odd_names) {
    const ScratchFolder place;
    const std::string scene = "./" + name + ".toml";
    if (name.size() > 200) {
      continue;
    }
    place.write(scene, open_loop_scene);
    const std::string sweep = "sweep " + shell_word(scene) +
                              " --vary friction.coefficient=0.1:0.2:3 --quiet --out " +
                              shell_word("./" + name + "_o");
    EXPECT_EQ(place.run(sweep + " --shard 1/2").exit_code, 0) << name;
    EXPECT_EQ(place.run(sweep + " --slurm 2").exit_code, 0) << name;
    const std::string job = shell_word((place.path() / (name + "_o/sweep.slurm")).string());
    // The copy for the array cannot have the name of every scene: then the second shard is foreign.
    const bool is_done = std::system(("SLURM_ARRAY_TASK_ID=2 bash " + job).c_str()) == 0;
    const std::string log = place.read(name + "_o/slurm_2.log");
    EXPECT_TRUE(is_done || log.find("has scene") != std::string::npos) << name << log;
    const Outcome outcome = place.run("sweep --merge " + shell_word("./" + name + "_o"));
    EXPECT_EQ(outcome.exit_code == 0, is_done) << name << outcome.err;
    EXPECT_TRUE(is_printable(outcome.out + outcome.err + log)) << name;
    EXPECT_FALSE(std::filesystem::exists(place.path() / "pwned"));
  }
}

TEST_F(ShardsTest, AFullDiskIsAnErrorAndTheShardGoesOnLater) {
  compute(map + "--out whole", "1/1");
  const std::string limited = "cd " + shell_word(folder_.path().string()) +
                              " && trap '' XFSZ && ulimit -f 4 && " SONOGLIDE_PROGRAM " sweep " +
                              map + "--out o --shard 1/1 >/dev/null 2>err";
  const int status = std::system(("bash -c " + shell_word(limited)).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(folder_.read("err").find("File too large"), std::string::npos) << folder_.read("err");
  EXPECT_EQ(folder_.read("o/shard_1_of_1.rows"), "");
  compute(map + "--out o", "1/1");
  EXPECT_EQ(folder_.read("o/shard_1_of_1.rows"), folder_.read("whole/shard_1_of_1.rows"));
}

class LongShardTest : public ShardsTest {
 protected:
  static std::vector<std::string> words(const std::string& out) {
    return {"sweep",     "open.toml",
            "--vary",    "friction.coefficient=0.1:0.2:120",
            "--set",     "run.duration_periods=300",
            "--threads", "1",
            "--quiet",   "--shard",
            "2/3",       "--out",
            out};
  }
  std::string text(const std::string& out) const {
    std::string all;
    for (const std::string& word : words(out)) {
      all += word + ' ';
    }
    return all;
  }
  std::string rows(const std::string& out) const {
    return folder_.read(out + "/shard_2_of_3.rows");
  }
  /// Points in all journals.
  std::ptrdiff_t finished(const std::string& out) const {
    std::ptrdiff_t lines = 0;
    for (const std::string& name : folder_.entries()) {
      if (name.find(out + "/") == 0 && name.find(".journal") != std::string::npos) {
        const std::string journal = folder_.read(name);
        lines += std::max<std::ptrdiff_t>(0, std::count(journal.begin(), journal.end(), '\n') - 1);
      }
    }
    return lines;
  }
  void expect_ended(StartedProgram& program) const {
    const int status = program.end();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }

  ScratchFolder temporary_;
};

TEST_F(LongShardTest, KilledAtAnyMomentItEndsInTheSameBytes) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(folder_.run(text("whole")).exit_code, 0);
  const std::chrono::duration<double> undisturbed = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 0.7);
  for (int kills = 0; kills < 8; ++kills) {
    StartedProgram program(folder_, words("o"), temporary_);
    std::this_thread::sleep_for(part(random) * undisturbed);
    program.send(SIGKILL);
    program.end();
  }
  EXPECT_EQ(folder_.run(text("o")).exit_code, 0);
  EXPECT_EQ(rows("o"), rows("whole"));
  EXPECT_EQ(folder_.entries(), (Entries{"closed.toml", "o", "o/shard_2_of_3.rows", "open.toml",
                                        "whole", "whole/shard_2_of_3.rows"}));
}

TEST_F(LongShardTest, ANodeThatDiesHandsItsJournalOn) {
  EXPECT_EQ(folder_.run(text("whole")).exit_code, 0);
  {
    StartedProgram program(folder_, words("o"), temporary_);
    ASSERT_TRUE(comes_true([&] { return finished("o") >= 5; }));
    program.send(SIGKILL);
    program.end();
  }
  for (const std::string& name : folder_.entries()) {
    if (name.find(".journal") != std::string::npos) {
      std::filesystem::rename(folder_.path() / name,
                              folder_.path() / "o/shard_2_of_3.elsewhere.journal");
    }
  }
  const std::ptrdiff_t before = finished("o");
  EXPECT_EQ(folder_.run("sweep --status o")
                .out.find("0 of 3 shards are there, 1 begun; " + std::to_string(before) +
                          " of 120 points"),
            0U);
  std::string arguments = text("o");
  arguments.erase(arguments.find("--quiet "), 8);
  const Outcome outcome = folder_.run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("40 points, " + std::to_string(before) + " of them finished before"),
            0U)
      << outcome.out;
  EXPECT_EQ(rows("o"), rows("whole"));
}

TEST_F(LongShardTest, TwoCopiesThatLiveEndInTheSameBytes) {
  EXPECT_EQ(folder_.run(text("whole")).exit_code, 0);
  StartedProgram one(folder_, words("o"), temporary_);
  ASSERT_TRUE(comes_true([&] { return finished("o") >= 2; }));
  StartedProgram other(folder_, words("o"), temporary_);
  expect_ended(one);
  expect_ended(other);
  EXPECT_EQ(rows("o"), rows("whole"));
  EXPECT_EQ(finished("o"), 0);
}

/// Largest resident memory of one run, in kB.
long memory_kB(const ScratchFolder& folder, const std::string& arguments) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string command =
        "cd " + shell_word(folder.path().string()) + " && exec " SONOGLIDE_PROGRAM " " + arguments;
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return usage.ru_maxrss;
}

TEST_F(ShardsTest, ABillionPointsTakeTheMemoryOfAHundredThousand) {
  const std::string scene =
      "sweep open.toml --quiet --threads 1 --set solver.tolerance=1e-4 "
      "--set run.duration_periods=1 --set run.window_start_periods=0 ";
  const long few =
      memory_kB(folder_, scene +
                             "--out few --shard 1/1 --vary friction.coefficient=0.1:0.2:100 "
                             "--vary friction.contact_stiffness_N_per_m=1e4:1e6:1000:log");
  const long many = memory_kB(
      folder_, scene +
                   "--out many --shard 6170/10000 --vary friction.coefficient=0.1:0.2:1000000 "
                   "--vary friction.contact_stiffness_N_per_m=1e4:1e6:1000:log");
  EXPECT_LT(static_cast<double>(many), 1.1 * static_cast<double>(few));
}

}  // namespace
}  // namespace sonoglide::acceptance::shards_test
