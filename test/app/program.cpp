#include "app/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "dataset/lint/lint.h"

namespace tera {
namespace fs = std::filesystem;

const char* const kTera = TERA_PROGRAM;
const char* const kCamera =
    "{name: camera, preset: tera:config/sensors/rgb_640.yaml, link: chassis, xyz_m: [0.8, 0, 1], "
    "width_px: 96, height_px: 72, rate_hz: 10}";
const char* const kLidar =
    "{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: chassis, xyz_m: [0, 0, 1.2], "
    "columns: 128}";

namespace {

constexpr int kCannotStart = 126;

/// In the child process: becomes the program, or ends with kCannotStart.
[[noreturn]] void Become(const std::string& program, const Arguments& arguments,
                         const Surroundings& surroundings) {
  for (const auto& [name, value] : surroundings.environment) {
    setenv(name.c_str(), value.c_str(), 1);
  }
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  if (chdir(surroundings.directory.c_str()) == 0) execv(program.c_str(), argv.data());
  _exit(kCannotStart);
}

Outcome Ended(int wait_status) {
  Outcome outcome;
  if (WIFEXITED(wait_status)) outcome.status = WEXITSTATUS(wait_status);
  if (WIFSIGNALED(wait_status)) outcome.signal = WTERMSIG(wait_status);
  return outcome;
}

/// Every dataset of the program passes lint.
void ExpectSoundDataset(const Arguments& arguments, const fs::path& directory) {
  static const std::set<std::string> kWriters = {"generate", "replay", "resense", "import"};
  const auto out = std::find(arguments.begin(), arguments.end(), "--out");
  if (arguments.empty() || !kWriters.count(arguments[0]) || arguments.end() - out < 2) return;
  const fs::path dataset = directory / *(out + 1);
  if (!fs::exists(dataset / "dataset.yaml")) return;
  for (const LintFinding& finding : Lint(dataset).findings) {
    if (finding.rule->severity != Severity::kError) continue;
    ADD_FAILURE() << dataset << ": " << finding.rule->id << " " << finding.channel << ": "
                  << finding.places.front().message;
  }
}

}  // namespace

TeraProcess::TeraProcess(const Arguments& arguments, const Surroundings& surroundings,
                         const std::string& program) {
  const std::string out = output_.path() / "out", err = output_.path() / "err";
  pid_ = fork();
  if (pid_ == 0) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    Become(program, arguments, surroundings);
  }
  EXPECT_GT(pid_, 0) << "fork failed";
}

TeraProcess::~TeraProcess() {
  if (Running()) {
    Signal(SIGKILL);
    Wait();
  }
}

bool TeraProcess::Running() {
  if (!ended_) ended_ = waitpid(pid_, &wait_status_, WNOHANG) != 0;
  return !ended_;
}

void TeraProcess::Signal(int signal) { kill(pid_, signal); }

Outcome TeraProcess::Wait() {
  if (!ended_) ended_ = waitpid(pid_, &wait_status_, 0) == pid_;
  Outcome outcome = Ended(wait_status_);
  outcome.out = ReadWholeFile(output_.path() / "out");
  outcome.err = ReadWholeFile(output_.path() / "err");
  return outcome;
}

Outcome RunTera(const Arguments& arguments, const Surroundings& surroundings) {
  const Outcome outcome = TeraProcess(arguments, surroundings).Wait();
  if (outcome.status == 0) ExpectSoundDataset(arguments, surroundings.directory);
  return outcome;
}

Outcome RunTeraOnTerminal(const Arguments& arguments, const fs::path& directory, int columns) {
  winsize size = {};
  size.ws_row = 24;
  size.ws_col = static_cast<unsigned short>(columns);
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, &size);
  if (pid == 0) Become(kTera, arguments, {directory});
  EXPECT_GT(pid, 0) << "forkpty failed";
  std::string text;
  char block[4096];
  // The terminal of an ended program gives an error, not an end of file.
  for (ssize_t count; (count = read(terminal, block, sizeof block)) > 0;) text.append(block, count);
  close(terminal);
  int wait_status = 0;
  waitpid(pid, &wait_status, 0);
  Outcome outcome = Ended(wait_status);
  outcome.out = text;
  return outcome;
}

std::set<std::string> Entries(const fs::path& root) {
  std::set<std::string> entries;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    entries.insert(entry.path().lexically_relative(root).generic_string());
  }
  return entries;
}

std::string SmallScenario(const std::string& more_sensors) {
  std::string text = R"(name: small
seed: 5
duration_s: 0.4
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: rover1
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis, rate_hz: 100}MORE]}
)";
  return Edited(text, "MORE", more_sensors.empty() ? "" : ",\n      " + more_sensors);
}

std::string Edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "'" << from << "' is not in\n" << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string LineAndColumn(const std::string& text, const std::string& needle) {
  const std::size_t at = text.find(needle);
  EXPECT_NE(at, std::string::npos) << needle;
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t begin = line == 0 ? 0 : text.rfind('\n', at) + 1;
  return std::to_string(line + 1) + ":" + std::to_string(at - begin + 1);
}

}  // namespace tera
