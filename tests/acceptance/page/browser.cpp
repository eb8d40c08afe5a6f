#include "tests/acceptance/page/browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host_sim/process/regular_expression.hpp"

extern char** environ;

namespace sonoglide::browser {
namespace {

namespace fs = std::filesystem;

/// A fresh folder that goes away with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "sonoglide-page-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no scratch folder " + name);
    }
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Runs a program with its output in a file; its complaints go nowhere.
void run(std::vector<std::string> arguments, const fs::path& output) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int spawned = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (spawned != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) ||
      WEXITSTATUS(status) != 0) {
    throw std::runtime_error("the browser failed or did not end: " + arguments.back());
  }
}

std::vector<std::string> requests_in(const fs::path& net_log) {
  const nlohmann::json log = nlohmann::json::parse(text_of(net_log));
  const int start = log.at("constants").at("logEventTypes").at("URL_REQUEST_START_JOB").get<int>();
  std::vector<std::string> requests;
  for (const nlohmann::json& event : log.at("events")) {
    const nlohmann::json params = event.value("params", nlohmann::json::object());
    const bool is_start =
        event.at("type") == start && params.contains("url");  // else it is the end
    if (is_start && params.value("initiator", "") != "not an origin") {
      requests.push_back(params.at("url").get<std::string>());
    }
  }
  return requests;
}

}  // namespace

Visit load(const fs::path& html, const std::string& script, const Screen& screen) {
  const ScratchFolder scratch;
  fs::path page = fs::absolute(html);
  if (!script.empty()) {
    const std::string text = text_of(page) + "<script>\n" + script + "\n</script>\n";
    page = scratch.path() / "page.html";
    std::ofstream(page, std::ios::binary) << text;
  }
  const fs::path dom = scratch.path() / "dom.html";
  const fs::path net_log = scratch.path() / "net_log.json";
  run({"timeout", "120", SONOGLIDE_CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu",
       "--disable-quic", "--no-first-run", "--disable-background-networking",
       "--disable-component-update", "--disable-sync",
       "--window-size=" + std::to_string(screen.width_px) + ",1000",
       std::string("--blink-settings=preferredColorScheme=") + (screen.dark ? "0" : "1"),
       "--user-data-dir=" + (scratch.path() / "profile").string(), "--virtual-time-budget=5000",
       "--log-net-log=" + net_log.string(), "--dump-dom", "file://" + page.string()},
      dom);
  return {text_of(dom), requests_in(net_log)};
}

std::string body_attribute(const std::string& dom, const std::string& name) {
  const process::Match body = process::RegularExpression("<body[^>]*>").search(dom);
  if (body.empty()) {
    return "";
  }
  const process::RegularExpression attribute("\\s" + name + "=\"([^\"]*)\"");
  const process::Match found = attribute.search(body[0]);
  return found.empty() ? "" : found[1];
}

}  // namespace sonoglide::browser
