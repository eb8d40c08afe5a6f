#include "host_sim/long_work/slurm.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::slurm_test {
namespace {

TEST(SlurmScriptTest, TheShellHandsEveryWordOnAsItIs) {
  for (const std::string word : {"plain/word-1.2:3=a,b", "a b", "don't", "$(touch pwned)", "`x`",
                                 "a\nb", "*?", "\\", "", "-dash", "\xff\xfe"}) {
    const ShardFolder folder;
    const std::string script = slurm_script({"printf", "%s.", word}, 3, folder.path());
    folder.write("job", script);
    const std::string command = "SLURM_ARRAY_TASK_ID=2 SLURM_CPUS_PER_TASK=5 bash '" +
                                (folder.path() / "job").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(folder.read("slurm_2.log"), word + ".--threads.5.--shard.2/3.");
  }
}

TEST(SlurmTest, MissingOnesAreTextForSbatch) {
  EXPECT_EQ(array_text({3, 7, 8, 9}), "--array=3,7-9");
  EXPECT_EQ(array_text({1}), "--array=1");
  EXPECT_EQ(array_text({1, 2}), "--array=1-2");
  EXPECT_EQ(array_text({1, 3, 5, 6}), "--array=1,3,5-6");
}

}  // namespace
}  // namespace sonoglide::long_work::slurm_test
